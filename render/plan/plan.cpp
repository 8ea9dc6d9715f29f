#include "render/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/shadow/shadow_fit.h"

namespace render {
namespace {

// What a scene has that passes may be needed for.
struct Needs {
  int virtual_instances = 0;
  int real_instances = 0;
  bool sun = false;
  bool occluders = false;
  bool medium = false;
  bool shafts = false;       // occluders that can shadow the medium
  bool translucent = false;  // and among them some that tint it
};

bool can_shadow_medium(const SceneState& scene, const std::vector<const Instance*>& occluders) {
  const std::optional<Box>& extent = scene.medium->extent;
  return std::ranges::any_of(
      occluders, [&](const Instance* occluder) { return !extent || can_shadow(*occluder, *extent, sun_of(scene)); });
}

Needs needs_of(const SceneState& scene) {
  Needs needs;
  for (const Instance& instance : scene.instances) ++(instance.real ? needs.real_instances : needs.virtual_instances);
  needs.sun = std::max({sun_of(scene).illuminance_rgb.r, sun_of(scene).illuminance_rgb.g,
                        sun_of(scene).illuminance_rgb.b}) > 0.0;
  const std::vector<const Instance*> virtual_occluders = occluders(scene, Occluders::Virtual);
  const std::vector<const Instance*> real_occluders = occluders(scene, Occluders::Real);
  needs.occluders = !virtual_occluders.empty() || !real_occluders.empty();
  needs.medium = scene.medium && scene.medium->extinction_per_m > 0.0;
  needs.shafts = needs.medium && needs.sun &&
                 (can_shadow_medium(scene, virtual_occluders) || can_shadow_medium(scene, real_occluders));
  needs.translucent = needs.shafts && !translucent_occluders(scene).empty();
  return needs;
}

std::string count(int n, const char* kind) {
  return fmt::format("{} {} thing{}", n, kind, n == 1 ? "" : "s");
}

// "interleaved: steps 64, divisor 2"
std::string described(const ShaftSettings& shafts) {
  std::string text = shafts.technique;
  const ShaftTechniqueInfo* info = find_shaft_technique(shafts.technique);
  if (info == nullptr) return text;
  const char* separator = ": ";
  for (const ShaftParameter& parameter : info->parameters) {
    const double value = shafts.number(parameter.name);
    text += parameter.choices.empty() ? fmt::format("{}{} {:g}", separator, parameter.name, value)
                                      : fmt::format("{}{} {}", separator, parameter.name,
                                                    parameter.choices.at(static_cast<std::size_t>(value)));
    separator = ", ";
  }
  return text;
}

// Whether shafts soften with the way from what casts them: texels are not seen then.
bool by_disc(const ShaftSettings& shafts) {
  const ShaftTechniqueInfo* info = find_shaft_technique(shafts.technique);
  return info != nullptr && info->find("sun") != nullptr && shafts.integer("sun") == 1;
}

class Planner {
 public:
  Planner(const SceneState& scene, const Quality& quality) : scene_(scene), quality_(quality), needs_(needs_of(scene)) {
    plan_.shadow_map_size = quality.shadow_map_size;
    plan_.anti_alias = quality.anti_alias;
    plan_.quick_shadows = quality.quick_shadows;
    plan_.render_scale = quality.render_scale;
    plan_.shafts = quality.shafts;
    resolve_technique();
  }

  Plan take() {
    if (!scene_.draw_virtual) {
      omit_all("the camera's pose is not known: the picture passes through");
    } else if (!objects_needed() && !needs_.medium) {
      omit_all(needs_.real_instances > 0
                   ? "nothing virtual casts a shadow on the real things, and there is no medium: the "
                     "picture passes through"
                   : "the scene has no objects and no medium: the picture passes through");
    } else {
      add(PassKind::Upload, "upload", "the part of the picture that changes", "the real picture is composited");
      plan_shadow();
      plan_objects();
      plan_cascades();
      plan_shafts();
      plan_translucency();
      add(PassKind::Composite, "composite", "linear light, the source's own encoding",
          "virtual light is laid over the real picture");
      add(PassKind::Read, "read", "the part of the picture that changes; the rest is copied",
          "the result leaves the GL");
    }
    return std::move(plan_);
  }

 private:
  bool objects_needed() const { return needs_.virtual_instances > 0 || (needs_.real_instances > 0 && needs_.medium); }

  void add(PassKind kind, std::string name, std::string settings, std::string reason) {
    plan_.passes.push_back({kind, std::move(name), std::move(settings), std::move(reason)});
  }
  void omit(std::string name, std::string reason) { plan_.omitted.push_back({std::move(name), std::move(reason)}); }
  void omit_all(const std::string& reason) {
    for (const char* name :
         {"upload", "shadow", "objects", "cascades", "shafts", "translucency", "composite", "read"}) {
      omit(name, reason);
    }
  }

  void resolve_technique() {
    if (plan_.shafts.technique != "auto") return;
    if (!needs_.shafts) {
      plan_.shafts.technique = "closed-form";
      return;
    }
    const double pixels = static_cast<double>(scene_.camera.width) * scene_.camera.height;
    const auto chosen = choose_shafts(shaft_table(), quality_.shaft_demand, pixels);
    plan_.shafts = chosen.value_or(ShaftSettings{.technique = "interleaved"});
  }

  void plan_shadow() {
    if (!needs_.sun) return omit("shadow", "no sunlight: the sun is down or has no illuminance");
    if (!needs_.occluders) return omit("shadow", "nothing in the scene casts a shadow");
    if (needs_.virtual_instances == 0 && !needs_.shafts) {
      return omit("shadow", "no shadow falls on virtual things or into the medium");
    }
    add(PassKind::SunShadow, "shadow",
        fmt::format("{0} x {0} texels, drawn again only when the sun, an occluder or the region they shade changes",
                    quality_.shadow_map_size),
        fmt::format("{} and things that cast shadows", sun_of(scene_).is_moon ? "moonlight" : "sunlight"));
  }

  void plan_objects() {
    if (!objects_needed()) return omit("objects", "the scene has no objects");
    std::string reason;
    if (needs_.virtual_instances > 0) reason = count(needs_.virtual_instances, "virtual") + " to draw";
    if (needs_.real_instances > 0) {
      reason +=
          (reason.empty() ? "" : ", ") + count(needs_.real_instances, "real") +
          (needs_.virtual_instances > 0 ? " to take shadows and to hide what is behind" : " at which the medium ends");
    }
    add(PassKind::Objects, "objects", quality_.anti_alias ? "4 samples a pixel" : "1 sample a pixel", reason);
  }

  void plan_cascades() {
    if (!needs_.shafts) return omit("cascades", why_no_shafts());
    const ShaftTechniqueInfo* info = find_shaft_technique(plan_.shafts.technique);
    if (info == nullptr || !info->limited_by_shadow_resolution) {
      return omit("cascades", plan_.shafts.technique + " does not show the shadow map's texels");
    }
    if (by_disc(plan_.shafts)) return omit("cascades", "shafts that soften by the sun's disc hide the texels");
    add(PassKind::CascadedShadow, "cascades",
        fmt::format(
            "{0} x {0} texels over the medium that is seen, where that is much less than all; parted by distance "
            "where they would look coarse near the eye",
            quality_.shadow_map_size),
        fmt::format("{} shows the shadow map's texels", plan_.shafts.technique));
  }

  std::string why_no_shafts() const {
    if (!scene_.medium) return "the scene has no medium";
    if (!needs_.medium) return "the medium's extinction is zero";
    if (!needs_.sun) return "no sunlight that occluders could carve shafts into";
    return needs_.occluders ? "what casts shadows does not shade the medium" : "nothing in the scene casts a shadow";
  }

  void plan_translucency() {
    if (needs_.translucent) return;
    omit("translucency", needs_.shafts ? "no occluder lets coloured light through" : why_no_shafts());
  }

  void plan_shafts() {
    if (!needs_.medium) return omit("shafts", why_no_shafts());
    add(PassKind::Shafts, "shafts", described(plan_.shafts) + (needs_.translucent ? ", then tinted by glass" : ""),
        needs_.translucent ? "a medium, occluders that carve shafts into the sunlight, and glass that colours it"
        : needs_.shafts    ? "a medium, and occluders that carve shafts into the sunlight"
        : !needs_.sun      ? "a medium lit by the sky alone"
                           : "a medium with nothing between it and the sun");
  }

  const SceneState& scene_;
  const Quality& quality_;
  Needs needs_;
  Plan plan_;
};

}  // namespace

bool Plan::has(PassKind kind) const {
  return std::any_of(passes.begin(), passes.end(), [kind](const Pass& pass) { return pass.kind == kind; });
}

Plan make_plan(const SceneState& scene, const Quality& quality) {
  return Planner(scene, quality).take();
}

}  // namespace render
