#pragma once

#include <optional>
#include <span>

#include "render/base/picture.h"
#include "render/composite/layers.h"
#include "render/gl/gpu_model.h"
#include "render/plan/medium_image.h"
#include "render/plan/plan.h"
#include "render/shafts/shaft_technique.h"

namespace render {

class CompositePass;
class MergePass;
class StillPass;
struct MergedPicture;

// One frame on its way through the passes of its plan: what they are given, and what each leaves for those after it.
struct Frame {
  // Given, and borrowed.
  const SceneState& scene;
  const Plan& plan;
  GpuModels& models;
  const View& view;                         // the ideal picture that all layers are drawn in
  const LensLookup* lens;                   // null: the ideal picture is the real one, pixel by pixel
  const SunShadow* shadow;                  // without a shadow until the shadow pass leaves its own
  const PictureView* in = nullptr;          // Target::Video: the real picture
  const MutablePictureView* out = nullptr;  // and where the result goes

  // Left by passes, which own what is pointed to until their next frame. Null or empty: not in the plan.
  StillPass* still = nullptr;                   // background: holds it
  const ObjectsPicture* objects = nullptr;      // objects
  std::span<const Cascade> cascades = {};       // cascades
  const ShaftPicture* shafts = nullptr;         // shafts; translucency: the same, tinted
  std::optional<ShaftError> shafts_error = {};  // shafts, of techniques that estimate it
  CompositePass* composite = nullptr;           // upload: holds the real picture
  PixelRect region = {};                        // upload: of the real picture, merge: of the ideal one, that changes
  MergePass* merge = nullptr;                   // merge: holds the merged layers
  const MergedPicture* merged = nullptr;        // read: the merged layers
  LinearImage linear = {};                      // read: the still
  MediumImage medium = {};                      // medium

  ShaftInputs shaft_inputs() const;  // scene.medium is present
  CompositeLayers layers() const;
  PixelRect drawn() const;  // the part of the ideal picture in which layers may hold anything
};

}  // namespace render
