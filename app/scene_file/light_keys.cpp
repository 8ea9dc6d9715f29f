// `sky:`, `sun:` and `exposure:`.

#include <algorithm>

#include "app/options/words.h"
#include "app/scene_file/scene_keys.h"
#include "ar/photometry/exposure.h"
#include "render/base/angles.h"
#include "render/sky/clouds.h"
#include "render/sky/sky_models.h"

namespace app {
namespace {

constexpr double kBrightest = 1e9;  // lux and cd/m2: some thousand suns

ValueShape sky_model_shape() {
  ValueShape shape = shapes::one_word_of({});
  for (const render::SkyModelInfo& model : render::sky_models()) {
    shape.words.insert(shape.words.end(), model.words.begin(), model.words.end());
    if (!model.words.empty()) continue;
    shape.pattern += (shape.pattern.empty() ? "^(" : "|") + model.prefix;
  }
  if (!shape.pattern.empty()) shape.pattern += ").+";
  shape.form = render::known_sky_models();
  return shape;
}

void read_sky_model(const YamlValue& value, SceneSky& sky) {
  const ValueShape& shape = sky_keys().shape().key("model").value;
  const std::string word = value.text(accepted(shape));
  const render::SkyModelInfo* model = render::find_sky_model(word);
  if (model == nullptr) {
    const std::string meant = closest(word, shape.words);
    value.fail(accepted(shape), meant.empty() ? "" : "did you mean '" + meant + "'?");
  }
  // What cannot be listed names a file.
  sky.options.model =
      model->words.empty() ? model->prefix + value.resolve(word.substr(model->prefix.size())).string() : word;
  sky.where = value.where();
}

KeyTable<render::CloudOptions> make_cloud_keys() {
  using render::CloudOptions;
  std::vector<std::pair<std::string, std::string>> presets;
  std::string meaning = "The weather:";
  for (const render::CloudPreset& preset : render::cloud_presets()) {
    presets.emplace_back(preset.name, preset.name);
    meaning += (presets.size() == 1 ? " `" : "; `") + preset.name + "` " + preset.summary;
  }
  KeyTable<CloudOptions> table;
  table.word("preset", presets, &CloudOptions::preset, {meaning + ".", "light"})
      .required()
      .integer("seed", shapes::integer_from_to(0, 1000000), &CloudOptions::seed,
               {"Random seed of the clouds' shapes.", "7"})
      .example("{ preset: light, seed: 7 }");
  return table;
}

const KeyTable<render::CloudOptions>& cloud_keys() {
  static const KeyTable<render::CloudOptions> table = make_cloud_keys();
  return table;
}

KeyTable<SceneSky> make_sky_keys() {
  KeyTable<SceneSky> table;
  table
      .add("model", sky_model_shape(), read_sky_model,
           {"The sky model, see [below](#sky-models). An image's path is relative to the scene file's folder.",
            "preetham:rescaled"})
      .or_else(SceneSky{}.options.model)
      .number("turbidity", shapes::number_from_to(1.0, 64.0, "", "1 is pure air, 64 thick haze"),
              [](SceneSky& sky) -> double& { return sky.options.turbidity; },
              {"Haziness (Linke's): 2 very clear, 4 hazy, 6 thick haze.", "3"})
      .number("ground_albedo", shapes::share(), &SceneSky::ground_albedo,
              {"Share of the light that the ground around sends back up.", "0.3"})
      .map("clouds", cloud_keys(), [](SceneSky& sky) -> render::CloudOptions& { return sky.options.clouds; },
           {"Clouds in front of the sky.", cloud_keys().shape().example})
      .or_else(render::CloudOptions{}.preset)
      .bare("model")
      .example("{ model: perez, turbidity: 2.5, clouds: { preset: light } }")
      .finish([](const YamlMap& map, SceneSky& sky) {
        if (sky.where.empty()) sky.where = map.value().where();
      });
  return table;
}

void read_color(const YamlValue& value, render::GivenSun& sun) {
  const ValueShape& shape = sun_keys().shape().key("color").value;
  sun.color_rgb = read_vector(value, shape);
  // What is scaled to a luminance must have one to be scaled by.
  if (std::max({sun.color_rgb->r, sun.color_rgb->g, sun.color_rgb->b}) < 1e-6) value.fail(accepted(shape));
}

KeyTable<render::GivenSun> make_sun_keys() {
  const std::string natural = "by place, time and turbidity";
  KeyTable<render::GivenSun> table;
  table
      .number("azimuth_deg", shapes::heading(), &render::GivenSun::azimuth_rad,
              {"Where the sun stands, not where its light goes.", "135"}, render::kRadPerDeg)
      .only_with({"elevation_deg"})
      .or_else("by place and time")
      .number("elevation_deg", shapes::number_from_to(-90.0, 90.0, "degrees", "above the horizon"),
              &render::GivenSun::elevation_rad, {"How high the sun stands.", "32"}, render::kRadPerDeg)
      .only_with({"azimuth_deg"})
      .or_else("by place and time")
      .number("illuminance_lux", shapes::number_from_to(0.0, kBrightest, "lux", "on a plane that faces the sun"),
              &render::GivenSun::illuminance_lux, {"The sun's direct illuminance.", "90000"})
      .or_else(natural)
      .add("color",
           shapes::numbers(3, "[red, green, blue]", "", {.least = 0.0, .most = 1e6}, "linear, not all below 1e-6"),
           read_color, {"The sunlight's relative linear RGB (Rec. 709); its luminance stays.", "[1, 0.86, 0.68]"})
      .or_else("white with `illuminance_lux`, else " + natural)
      .number("angular_radius_deg", shapes::number_from_to(0.0, 10.0, "degrees"), &render::GivenSun::angular_radius_rad,
              {"Angular radius of the disc that casts penumbrae; 0 casts hard shadows.", "0.267"}, render::kRadPerDeg)
      .or_else("the sun's own, for its limb-darkened disc")
      .example("{ azimuth_deg: 135, elevation_deg: 32, illuminance_lux: 90000 }");
  return table;
}

void read_ev100(const YamlValue& value, double& exposure) {
  exposure = ar::exposure_from_ev100(read_number(value, exposure_keys().shape().key("ev100").value));
}

void read_white_luminance(const YamlValue& value, double& exposure) {
  exposure = 1.0 / read_number(value, exposure_keys().shape().key("white_luminance").value);
}

KeyTable<double> make_exposure_keys() {
  KeyTable<double> table;
  table.exactly_one_of({"ev100", "white_luminance"})
      .add("ev100", shapes::number_from_to(-20.0, 30.0, "exposure value at ISO 100"), read_ev100,
           {"A camera set to that exposure value saturates at 1.2 · 2^EV cd/m² (ISO 12232).", "13.5"})
      .add("white_luminance", shapes::number_from_to(1e-6, kBrightest, "cd/m2"), read_white_luminance,
           {"Luminance that is shown as white.", "13500"})
      .example("{ white_luminance: 13500 }");
  return table;
}

}  // namespace

const KeyTable<SceneSky>& sky_keys() {
  static const KeyTable<SceneSky> table = make_sky_keys();
  return table;
}

const KeyTable<render::GivenSun>& sun_keys() {
  static const KeyTable<render::GivenSun> table = make_sun_keys();
  return table;
}

const KeyTable<double>& exposure_keys() {
  static const KeyTable<double> table = make_exposure_keys();
  return table;
}

}  // namespace app
