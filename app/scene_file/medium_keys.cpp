// `medium:`.

#include "app/scene_file/scene_keys.h"

namespace app {
namespace {

void read_visibility(const YamlValue& value, render::Medium& medium) {
  const ValueShape& shape = medium_keys().shape().key("visibility").value;
  medium.extinction_per_m = render::extinction_from_visibility(read_number(value, shape));
}

void read_box(const YamlValue& value, render::Box& box) {
  const std::string words = accepted(shapes::corners());
  const std::vector<YamlValue> items = value.list();
  if (items.size() != 2) value.fail(words);
  box = {read_vector(items[0], shapes::world_position()), read_vector(items[1], shapes::world_position())};
  for (int i = 0; i < 3; ++i) {
    if (box.min_in_world[i] >= box.max_in_world[i]) {
      value.fail_found("a first corner that is not below the second in every coordinate", words);
    }
  }
}

const KeyTable<render::Box>& extent_keys() {
  static const KeyTable<render::Box> table = [] {
    KeyTable<render::Box> made;
    made.add("box", shapes::corners(), read_box, {"The medium fills this box.", "[[-3, -3, 0], [3, 3, 4]]"})
        .required()
        .example("{ box: [[-3, -3, 0], [3, 3, 4]] }");
    return made;
  }();
  return table;
}

const KeyTable<render::HeightFalloff>& height_falloff_keys() {
  using render::HeightFalloff;
  static const KeyTable<HeightFalloff> table = [] {
    KeyTable<HeightFalloff> made;
    made.number("base", shapes::any_number("metres", "z in the world"), &HeightFalloff::base_m,
                {"Height at which the medium has the extinction that is given.", "0.5"})
        .number("scale_height", shapes::number_above_0("metres"), &HeightFalloff::scale_height_m,
                {"Every so much higher, the extinction is 1/e of what it was.", "3"})
        .required()
        .example("{ base: 0, scale_height: 3 }");
    return made;
  }();
  return table;
}

KeyTable<render::Medium> make_medium_keys() {
  using render::Medium;
  using render::PhaseFunction;
  const ValueShape gain = shapes::number_from_to(0.0, 1000.0, "a factor", "1 is physical");
  const std::vector<std::pair<std::string, PhaseFunction>> phases{{"hg", PhaseFunction::HenyeyGreenstein},
                                                                  {"cornette-shanks", PhaseFunction::CornetteShanks},
                                                                  {"rayleigh", PhaseFunction::Rayleigh}};
  KeyTable<Medium> table;
  table.exactly_one_of({"visibility", "extinction"})
      .add("visibility", shapes::number_above_0("metres"), read_visibility,
           {"Distance at which 5 % of the contrast is left: extinction = 2.996 / visibility.", "30"})
      .number("extinction", shapes::number_from_0("1/m"), &Medium::extinction_per_m,
              {"Extinction coefficient, scattering and absorption together.", "0.1"})
      .number("albedo", shapes::share(), &Medium::albedo, {"Share of the extinction that scatters.", "0.9"})
      .word("phase", phases, &Medium::phase_function,
            {"Phase function: Henyey-Greenstein, Cornette-Shanks or Rayleigh.", "cornette-shanks"})
      .number("g", shapes::number_in({.least = -1.0, .most = 1.0, .least_excluded = true, .most_excluded = true}),
              &Medium::g, {"Anisotropy: above 0 it is bright when looking towards the light.", "0.6"})
      .map("extent", extent_keys(), &Medium::extent, {"Where the medium is.", extent_keys().shape().example})
      .or_else("unbounded")
      .map("height_falloff", height_falloff_keys(), &Medium::falloff,
           {"The medium thins out exponentially with height.", height_falloff_keys().shape().example})
      .or_else("homogeneous")
      .number("shaft_gain", gain, &Medium::shaft_gain,
              {"Multiplies the sunlight that the medium scatters; what shines through it stays.", "2"})
      .number("fog_gain", gain, &Medium::fog_gain, {"The same for the sky's light.", "0.5"})
      .example("{ visibility: 30, albedo: 0.95, phase: hg, g: 0.7, extent: { box: [[-3, -3, 0], [3, 3, 4]] } }");
  return table;
}

}  // namespace

const KeyTable<render::Medium>& medium_keys() {
  static const KeyTable<render::Medium> table = make_medium_keys();
  return table;
}

}  // namespace app
