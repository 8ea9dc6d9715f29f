#include "render/composite/background.h"

#include <memory>
#include <optional>

#include "render/composite/still_pass.h"
#include "render/plan/features/features.h"
#include "render/plan/frame.h"

namespace render::feature {
namespace {

// What decides the background of a still.
struct BackgroundKey {
  std::shared_ptr<const SkyModel> sky;
  Sun sun;
  Camera camera;

  bool operator==(const BackgroundKey& o) const {
    return sky == o.sky && sun.direction_in_world == o.sun.direction_in_world &&
           sun.illuminance_rgb == o.sun.illuminance_rgb && sun.angular_radius_rad == o.sun.angular_radius_rad &&
           camera.width == o.camera.width && camera.height == o.camera.height && camera.fx == o.camera.fx &&
           camera.fy == o.camera.fy && camera.cx == o.camera.cx && camera.cy == o.camera.cy &&
           camera.lens == o.camera.lens && camera.world_from_camera == o.camera.world_from_camera;
  }
};

class Background final : public FeaturePass {
 public:
  static Decision needed(const PlanRequest& request) {
    switch (request.target) {
      case Target::Video:
        return NotNeeded{"the real picture is behind everything"};
      case Target::Medium:
        return NotNeeded{"the medium alone is asked for"};
      case Target::Still:
        break;
    }
    return Needed{"computed again only when the sky, the sun or the camera changes",
                  request.scene.sky ? "a still shows the sky behind everything" : "a still without a sky is dark"};
  }

  void draw(Frame& frame) override {
    const BackgroundKey key{frame.scene.sky, sun_of(frame.scene), frame.scene.camera};
    if (key_ != key) {
      still_.set_background(sky_background(frame.scene));
      key_ = key;
    }
    frame.still = &still_;
  }

 private:
  StillPass still_;
  std::optional<BackgroundKey> key_;
};

}  // namespace

constinit const Feature kBackground = feature_of<Background>("background");

}  // namespace render::feature
