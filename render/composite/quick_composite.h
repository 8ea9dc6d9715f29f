#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "render/base/picture.h"
#include "render/composite/merge_pass.h"
#include "render/scene/view.h"

namespace render {

// Lays a small merged picture over a large real one on the CPU, in linear light: bilinear between the small picture's
// pixels, tables for the transfer functions, each of `threads` doing some rows. Without a GPU it takes a quarter of the
// processor time that the GL's CompositePass does, and neither the real picture nor the result has to pass through the
// GL. What nothing is laid over stays as it is, to the bit.
class QuickComposite {
 public:
  explicit QuickComposite(int threads);
  ~QuickComposite();
  QuickComposite(const QuickComposite&) = delete;
  QuickComposite& operator=(const QuickComposite&) = delete;

  // `view` is the merged picture's; `camera` the real picture's. Throws std::runtime_error for formats as
  // CompositePass::upload() does.
  void draw(const Camera& camera, const View& view, const MergedPicture& merged, const PictureView& in,
            const MutablePictureView& out);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace render
