// The whole scene file; `place:`, `view:` and `quality:`.

#include "app/scene_file/scene_keys.h"

#include <glm/geometric.hpp>
#include <stdexcept>

#include "app/error.h"
#include "app/options/shafts.h"
#include "ar/error.h"
#include "render/base/angles.h"

namespace app {
namespace {

void read_time(const YamlValue& value, SceneFile& scene) {
  const std::string& accepted = scene_keys().shape().key("time").value.form;
  const std::string text = value.text(accepted);
  try {
    scene.time = ar::parse_time(text);
  } catch (const std::invalid_argument&) {
    value.fail(accepted);
  }
}

void read_tag_block(const YamlValue& value, SceneFile& scene) {
  TagBlock tags;
  tags_keys().read(value, tags);
  scene.tags = std::move(tags.map);
}

void read_shafts(const YamlValue& value, render::Quality& quality) {
  try {
    quality.shafts = parse_shafts(value.where(), value.text("auto or a technique"));
  } catch (const UsageError& error) {
    throw ar::InputError(error.what());
  }
}

void check_view(const YamlMap& map, const SceneView& view) {
  const YamlValue target = *map.find("target");
  const glm::dvec3 forward = view.target_in_world - view.eye_in_world;
  if (glm::length(forward) <= 0.0) target.fail_found("the eye's own place", "a place to look at, other than the eye");
  const double sine = glm::length(glm::cross(forward, view.up_in_world));
  if (!(sine > 1e-9 * glm::length(forward) * glm::length(view.up_in_world))) {
    target.fail_found("a view along `up`", "`up` at an angle to the view, as up: [0, 1, 0]");
  }
}

void check_version(const YamlValue& value, SceneFile&) {
  read_number(value, scene_keys().shape().key("skyshaft").value);
}

KeyTable<SceneFile> make_scene_keys() {
  KeyTable<SceneFile> table;
  table.example("{ skyshaft: 1 }");
  table
      .add("skyshaft", shapes::number_from_to(1.0, 1.0, "", "the version of this format"), check_version,
           {"The version of this format.", "1"})
      .required()
      .map("place", place_keys(), &SceneFile::place, {"Where the scene is.", place_keys().shape().example})
      .or_else("`--at`, else the video's metadata")
      .add("time", shapes::text("UTC or a time with an offset, as 2024-06-21T07:30:00Z or 2024-06-21 09:30+02:00"),
           read_time, {"The instant of the first frame.", "2024-06-21T07:30:00Z"})
      .or_else("`--time`, else the video's metadata")
      .add("tags", shapes::map_of(tags_keys().shape()), read_tag_block,
           {"The AprilTags and where each is in the world.", tags_keys().shape().example})
      .or_else("no tracking")
      .map("sky", sky_keys(), &SceneFile::sky,
           {"The sky's light. A bare word is the model: `sky: none`.", sky_keys().shape().example})
      .map(
          "medium", medium_keys(), &SceneFile::medium,
          {"The participating medium: haze, mist or smoke, in which light shafts show.", medium_keys().shape().example})
      .or_else("clear air")
      .list("objects", object_keys(), &SceneFile::instances,
            {"Virtual objects: lit, drawn, casting shadows and shafts.", object_keys().shape().example})
      .or_else("none")
      .list("real", real_keys(), &SceneFile::instances,
            {"Real things as the camera sees them: they receive and cast shadows and hide what is behind them, but are "
             "not drawn.",
             real_keys().shape().example})
      .or_else("none")
      .map("view", view_keys(), &SceneFile::view,
           {"The camera of stills and benchmarks (`skyshaft render`).", view_keys().shape().example})
      .or_else("none; `process` and `live` track the camera")
      .map("sun", sun_keys(), &SceneFile::sun,
           {"What is given here replaces what place and time say of the sun.", sun_keys().shape().example})
      .map("exposure", exposure_keys(), &SceneFile::exposure,
           {"The camera's exposure.", exposure_keys().shape().example})
      .or_else("the video's metadata, else estimated from pictures and light")
      .map("quality", quality_keys(), &SceneFile::quality,
           {"Accuracy and speed of the rendering.", quality_keys().shape().example})
      .not_yet({"lights", "portals"});
  return table;
}

KeyTable<ar::GeoPosition> make_place_keys() {
  KeyTable<ar::GeoPosition> table;
  table
      .number("latitude", shapes::number_from_to(-90.0, 90.0, "degrees", "north positive"),
              &ar::GeoPosition::latitude_deg, {"Geographic latitude.", "43.5263"})
      .required()
      .number("longitude", shapes::number_from_to(-180.0, 180.0, "degrees", "east positive"),
              &ar::GeoPosition::longitude_deg, {"Geographic longitude.", "5.4454"})
      .required()
      .number("height", shapes::number_from_to(-500.0, 100000.0, "metres"), &ar::GeoPosition::height_m,
              {"Height above the sea: thinner air, a darker sky and a brighter sun.", "180"})
      .example("{ latitude: 43.5263, longitude: 5.4454, height: 180 }");
  return table;
}

KeyTable<SceneView> make_view_keys() {
  KeyTable<SceneView> table;
  table.vector("eye", shapes::world_position(), &SceneView::eye_in_world, {"Where the camera is.", "[4, -5, 1.6]"})
      .required()
      .vector("target", shapes::world_position(), &SceneView::target_in_world,
              {"What it looks at; not the eye itself, nor straight along `up`.", "[0, 0, 1.1]"})
      .required()
      .vector("up", shapes::numbers(3, "a direction [east, north, up]"), &SceneView::up_in_world,
              {"The direction that points up in the picture.", "[0, 1, 1]"})
      .number(
          "vertical_fov_deg",
          shapes::number_in({.least = 0.0, .most = 180.0, .least_excluded = true, .most_excluded = true}, "degrees"),
          &SceneView::vertical_fov_rad, {"Vertical field of view.", "45"}, render::kRadPerDeg)
      .required()
      .example("{ eye: [4, -5, 1.6], target: [0, 0, 1.1], vertical_fov_deg: 45 }")
      .finish(check_view);
  return table;
}

KeyTable<render::Quality> make_quality_keys() {
  using render::Quality;
  KeyTable<Quality> table;
  table
      .add("shafts", shapes::text("auto or a technique"), read_shafts,
           {"The light shafts' technique with its settings, as `--shafts` takes it: `skyshaft render --help` lists "
            "them. "
            "`auto` chooses by `max_error` and `target_ms`.",
            "\"march:steps=128,divisor=1\""})
      .or_else(Quality{}.shafts.technique)
      .number("max_error", shapes::number_in({.least = 0.0, .most = 1.0, .least_excluded = true}, "relative error"),
              [](Quality & quality) -> auto& { return quality.shaft_demand.max_error; },
              {"Relative RMS error of the shafts' light that has to hold.", "0.02"})
      .or_else("no demand")
      .number("target_ms", shapes::number_above_0("milliseconds"),
              [](Quality & quality) -> auto& { return quality.shaft_demand.target_ms; },
              {"Time that the shafts may take in each frame.", "30"})
      .or_else("no demand")
      .integer("shadow_map_size", shapes::integer_from_to(1, 8192), &Quality::shadow_map_size,
               {"Side of the shadow map, texels.", "1024"})
      .flag("anti_alias", &Quality::anti_alias, {"Smooth the edges of what is drawn.", "false"})
      .example("{ target_ms: 30, shadow_map_size: 1024, anti_alias: false }");
  return table;
}

}  // namespace

const KeyTable<SceneFile>& scene_keys() {
  static const KeyTable<SceneFile> table = make_scene_keys();
  return table;
}

const KeyTable<ar::GeoPosition>& place_keys() {
  static const KeyTable<ar::GeoPosition> table = make_place_keys();
  return table;
}

const KeyTable<SceneView>& view_keys() {
  static const KeyTable<SceneView> table = make_view_keys();
  return table;
}

const KeyTable<render::Quality>& quality_keys() {
  static const KeyTable<render::Quality> table = make_quality_keys();
  return table;
}

}  // namespace app
