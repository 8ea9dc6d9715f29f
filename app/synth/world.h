#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/synth/backdrop.h"
#include "app/synth/gaze.h"
#include "app/synth/light.h"
#include "app/synth/noise.h"
#include "app/synth/plants.h"
#include "app/synth/spec.h"
#include "app/synth/surfaces.h"
#include "ar/track/tag_face.h"

namespace app::synth {

// Which things a bundle of rays can hit; indices into the world's boxes, tags and cards.
struct Candidates {
  std::vector<std::uint16_t> boxes;
  std::vector<std::uint16_t> tags;
  std::vector<std::uint16_t> cards;
};

struct Radiance {
  glm::vec3 luminance_rgb{0.0F};  // cd/m2
  float sun_share = 0.0F;         // of the sun's disc seen from where the ray ended
  int thing = -1;                 // what it ended on; samples of one thing differ by its texture and its shadows alone
  bool tag = false;               // that is a printed tag
};

// How a ray sees textures.
struct RayFilter {
  float spread_rad = 0.0F;  // its share of a pixel
  float dither = 0.5F;      // rounds mip levels up or down, in [0, 1): to be spread evenly over a pixel's rays
};

// The real world of a clip: level ground, boxes, printed tags, plants, far things; one sun, one sky.
class World {
 public:
  // `focus`: the middle of what the camera sees on the ground; `eye`: about where it stands; `gaze`: what may be seen,
  // as detail is left out elsewhere.
  World(const Spec& spec, const glm::vec3& eye, const glm::vec3& focus, const Gaze& gaze = Gaze());

  const Light& light() const { return light_; }
  // Things within a cone: apex, unit axis and half angle (cosine and sine).
  void candidates(const glm::vec3& apex, const glm::vec3& axis, float half_angle_rad, Candidates& found) const;
  // Light along a ray.
  Radiance trace(const glm::vec3& origin, const glm::vec3& direction, const RayFilter& filter, const Candidates& among,
                 Random& random) const;
  // Share of the sun's disc seen from there, one point of the disc a call.
  float sun_seen(const glm::vec3& point, Random& random) const;

 private:
  struct Block {
    glm::vec3 centre, half;
    glm::mat3 world_from_local{1.0F};
    const Texture* surface = nullptr;  // none: bare board
  };
  struct PrintedTag {
    glm::vec3 centre;
    glm::mat3 world_from_tag{1.0F};
    ar::TagFace face;
    float half_side_m = 0.0F;
  };
  struct Card {
    glm::vec3 foot;
    glm::vec2 right;  // horizontal unit vector along the card
    float half_width_m = 0.0F, height_m = 0.0F;
    std::shared_ptr<const Painting> painting;
    float texels_per_m = 1.0F;
  };

  void add_boxes(const Spec& spec);
  void add_tags(const Spec& spec);
  void add_plants(const Spec& spec, const glm::vec3& eye);
  void build_shadow_grid();
  void bake_openness(const glm::vec2& centre);
  float openness(const glm::vec2& ground) const;
  static bool hit_block(const Block& block, const glm::vec3& origin, const glm::vec3& direction, float& t,
                        glm::vec3& normal_local);
  bool hit_card(const Card& card, const glm::vec3& origin, const glm::vec3& direction, float& t, glm::vec2& uv) const;
  Radiance shade(const SurfacePoint& surface, const glm::mat3& frame, const glm::vec3& point, const glm::vec3& to_eye,
                 float sky_open, Random& random) const;
  Radiance shade_ground(const glm::vec3& point, const glm::vec3& direction, float t, const RayFilter& filter,
                        Random& random) const;
  Radiance shade_block(const Block& block, const glm::vec3& point, const glm::vec3& normal_local,
                       const glm::vec3& direction, float t, const RayFilter& filter, Random& random) const;
  Radiance shade_tag(const PrintedTag& tag, const glm::vec3& point, Random& random) const;
  float sky_open_at(const glm::vec3& point, const glm::vec3& normal) const;
  struct Hit;  // where a ray ends
  Hit first_solid(const glm::vec3& origin, const glm::vec3& direction, const Candidates& among) const;
  glm::vec4 leaves_before(float t, const glm::vec3& origin, const glm::vec3& direction, const RayFilter& filter,
                          const Candidates& among) const;
  Radiance shade_hit(const Hit& hit, const glm::vec3& origin, const glm::vec3& direction, const RayFilter& filter,
                     Random& random) const;

  Light light_;
  GroundTextures ground_;
  std::uint32_t seed_;
  std::map<std::string, Texture> surfaces_;
  std::vector<Block> blocks_;
  std::vector<PrintedTag> tags_;
  std::vector<Card> cards_;         // as the camera sees the plants
  std::vector<Card> shadow_cards_;  // as the sun sees them
  Backdrop backdrop_;

  struct Caster {
    std::uint16_t index;
    bool card;
    float reach_m;  // highest point along the sun's direction
  };
  static constexpr int kGrid = 96;
  glm::vec3 across_sun_{0.0F}, above_sun_{0.0F};
  glm::vec2 grid_low_{0.0F}, grid_cell_{1.0F};
  std::vector<std::vector<Caster>> grid_;

  static constexpr int kOpenSide = 192;
  static constexpr float kOpenMetres = 24.0F;
  glm::vec2 open_low_{0.0F};
  std::vector<float> open_;
};

}  // namespace app::synth
