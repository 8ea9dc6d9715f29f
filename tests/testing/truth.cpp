#include "tests/testing/truth.h"

#include <vector>

#include "tests/testing/light_rig.h"

namespace render::test {

ReferencePicture truth_of(const SceneState& scene, ReferenceSky sky) {
  std::vector<float> axis_m;
  const LightPictures unshadowed = rig().render(scene, parse_shaft_settings("closed-form:divisor=1"));
  for (const glm::vec4& p : unshadowed.distance.rgba) axis_m.push_back(p.r);
  return ShaftReference(scene, {.sky = sky}).picture(pinhole_view(scene.camera), axis_m);
}

}  // namespace render::test
