// `sky:`, `medium:`, `sun:` and `exposure:`.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/options/words.h"
#include "app/scene_file/sections.h"
#include "ar/photometry/exposure.h"
#include "render/base/angles.h"

namespace app {
namespace {

const std::vector<std::string>& sky_models() {
  static const std::vector<std::string> models{"perez",      "preetham",  "preetham:rescaled", "cie:1 ... cie:15",
                                               "scattering", "reference", "image:FILE",        "none"};
  return models;
}

// Whether the word can name a model at all; make_sky() knows which of them this version has.
bool is_sky_model(const std::string& word) {
  if (word.starts_with("cie:") || word.starts_with("image:")) return true;
  const auto& known = sky_models();
  return std::find(known.begin(), known.end(), word) != known.end();
}

std::string read_sky_model(const YamlValue& value) {
  const std::string word = value.text(join_or(sky_models()));
  if (!is_sky_model(word)) {
    const std::string meant =
        closest(word, {"perez", "preetham", "preetham:rescaled", "scattering", "reference", "none"});
    value.fail(join_or(sky_models()), meant.empty() ? "" : "did you mean '" + meant + "'?");
  }
  const std::string image = "image:";
  return word.starts_with(image) ? image + value.resolve(word.substr(image.size())).string() : word;
}

render::Box read_extent(const YamlValue& value) {
  const std::string accepted = "two opposite corners [[west, south, low], [east, north, high]] in metres";
  const YamlValue corners = value.map({"box"}).require("box", accepted);
  const auto items = corners.list();
  if (items.size() != 2) corners.fail(accepted);
  const render::Box box{read_position(items[0]), read_position(items[1])};
  for (int i = 0; i < 3; ++i) {
    if (box.min_in_world[i] >= box.max_in_world[i]) {
      corners.fail_found("a first corner that is not below the second in every coordinate", accepted);
    }
  }
  return box;
}

render::PhaseFunction read_phase(const YamlValue& value) {
  const std::string word = value.one_of({"hg", "cornette-shanks", "rayleigh"});
  if (word == "hg") return render::PhaseFunction::HenyeyGreenstein;
  return word == "rayleigh" ? render::PhaseFunction::Rayleigh : render::PhaseFunction::CornetteShanks;
}

double read_extinction(const YamlMap& map) {
  if (map.exactly_one_of({"visibility", "extinction"}) == "visibility") {
    return render::extinction_from_visibility(read_positive(*map.find("visibility"), "metres"));
  }
  return map.find("extinction")->number("1/m, 0 or above", [](double x) { return x >= 0.0; });
}

render::HeightFalloff read_height_falloff(const YamlValue& value) {
  const YamlMap map = value.map({"base", "scale_height"});
  render::HeightFalloff falloff;
  if (const auto base = map.find("base")) {
    falloff.base_m = base->number("metres, z in the world", [](double) { return true; });
  }
  falloff.scale_height_m = read_positive(map.require("scale_height", "metres, above 0"), "metres");
  return falloff;
}

render::CloudOptions read_clouds(const YamlValue& value) {
  const YamlMap map = value.map({"preset", "seed"});
  const std::vector<std::string> presets{"clear", "light", "cloudy", "overcast", "night"};
  const YamlValue preset = map.require("preset", join_or(presets));
  render::CloudOptions clouds;
  clouds.preset = preset.text(join_or(presets));
  if (std::find(presets.begin(), presets.end(), clouds.preset) == presets.end()) preset.fail(join_or(presets));
  clouds.seed = static_cast<std::uint32_t>(map.number_or("seed", 1.0, "a whole number from 0 to 1000000", [](double x) {
    return x >= 0.0 && x <= 1e6 && x == std::floor(x);
  }));
  return clouds;
}

glm::dvec3 read_color(const YamlValue& value) {
  const std::string accepted = "[red, green, blue], linear, none below 0 and not all 0";
  const glm::dvec3 color = value.vector3(accepted);
  if (color.x < 0.0 || color.y < 0.0 || color.z < 0.0 || color.x + color.y + color.z <= 0.0) value.fail(accepted);
  return color;
}

}  // namespace

SceneSky read_sky(const YamlValue& value) {
  SceneSky sky;
  sky.where = value.where();
  if (value.is_scalar()) {
    sky.options.model = read_sky_model(value);
    return sky;
  }
  const YamlMap map = value.map({"model", "turbidity", "ground_albedo", "clouds"});
  if (const auto clouds = map.find("clouds")) sky.options.clouds = read_clouds(*clouds);
  if (const auto model = map.find("model")) {
    sky.options.model = read_sky_model(*model);
    sky.where = model->where();
  }
  sky.options.turbidity = map.number_or("turbidity", sky.options.turbidity, "1 (pure air) to 64 (thick haze)",
                                        [](double x) { return x >= 1.0 && x <= 64.0; });
  sky.ground_albedo = map.number_or("ground_albedo", sky.ground_albedo, "a share from 0 to 1",
                                    [](double x) { return x >= 0.0 && x <= 1.0; });
  return sky;
}

render::Medium read_medium(const YamlValue& value) {
  const YamlMap map = value.map(
      {"visibility", "extinction", "albedo", "phase", "g", "extent", "height_falloff", "shaft_gain", "fog_gain"},
      {"blobs"});
  render::Medium medium;
  medium.extinction_per_m = read_extinction(map);
  medium.albedo =
      map.number_or("albedo", medium.albedo, "a share from 0 to 1", [](double x) { return x >= 0.0 && x <= 1.0; });
  if (const auto phase = map.find("phase")) medium.phase_function = read_phase(*phase);
  medium.g = map.number_or("g", medium.g, "a number above -1 and below 1", [](double x) { return std::abs(x) < 1.0; });
  if (const auto extent = map.find("extent")) medium.extent = read_extent(*extent);
  if (const auto falloff = map.find("height_falloff")) medium.falloff = read_height_falloff(*falloff);
  const auto gain = [](double x) { return x >= 0.0 && x <= 1000.0; };
  medium.shaft_gain = map.number_or("shaft_gain", 1.0, "a factor from 0 to 1000; 1 is physical", gain);
  medium.fog_gain = map.number_or("fog_gain", 1.0, "a factor from 0 to 1000; 1 is physical", gain);
  return medium;
}

SceneSun read_sun(const YamlValue& value) {
  const YamlMap map = value.map({"azimuth_deg", "elevation_deg", "illuminance_lux", "color", "angular_radius_deg"});
  SceneSun sun;
  if (map.find("azimuth_deg") || map.find("elevation_deg")) {
    sun.azimuth_rad = read_heading_rad(map.require("azimuth_deg", "degrees clockwise from north, -360 to 360"));
    const std::string accepted = "degrees above the horizon, -90 to 90";
    sun.elevation_rad = render::kRadPerDeg * map.require("elevation_deg", accepted).number(accepted, [](double x) {
      return std::abs(x) <= 90.0;
    });
  }
  if (const auto lux = map.find("illuminance_lux")) {
    sun.illuminance_lux =
        lux->number("lux on a plane that faces the sun, 0 or above", [](double x) { return x >= 0.0; });
  }
  if (const auto color = map.find("color")) {
    sun.color = read_color(*color);
    sun.has_color = true;
  }
  if (const auto radius = map.find("angular_radius_deg")) {
    sun.angular_radius_rad =
        render::kRadPerDeg * radius->number("degrees from 0 to 10", [](double x) { return x >= 0.0 && x <= 10.0; });
  }
  return sun;
}

double read_exposure(const YamlValue& value) {
  const YamlMap map = value.map({"ev100", "white_luminance"});
  if (map.exactly_one_of({"ev100", "white_luminance"}) == "ev100") {
    return ar::exposure_from_ev100(map.find("ev100")->number("exposure value at ISO 100, -20 to 30",
                                                             [](double x) { return x >= -20.0 && x <= 30.0; }));
  }
  return 1.0 / read_positive(*map.find("white_luminance"), "cd/m2");
}

}  // namespace app
