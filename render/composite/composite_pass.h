#pragma once

#include <memory>

#include "render/base/picture.h"
#include "render/composite/layers.h"

namespace render {

// Lays A, M, T and L over a real picture, in linear light, between the planes of video pictures. Three steps, so that
// each can be timed; call them in this order with the same region.
class CompositePass {
 public:
  CompositePass();
  ~CompositePass();
  CompositePass(const CompositePass&) = delete;
  CompositePass& operator=(const CompositePass&) = delete;

  // The part of the picture that must be encoded anew when the pixels of `changed` change: whole blocks, and the
  // neighbours whose chroma samples reach into it. Empty when `changed` is.
  static PixelRect region(const PictureFormat& format, const PixelRect& changed);

  // Throws std::runtime_error for Pq and Hlg and for bit depths other than 8 and 10.
  void upload(const PictureView& in, const PixelRect& region);
  void draw(const CompositeLayers& layers, const PixelRect& region);
  // Writes the region's samples to `out` and copies everything else from `in`. Waits for the GL.
  void read(const PictureView& in, const MutablePictureView& out, const PixelRect& region);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Copies every sample; the formats must be equal.
void copy_picture(const PictureView& in, const MutablePictureView& out);

}  // namespace render
