// The registry of techniques. A new one is a header above and an entry below.
#include "render/shafts/epipolar/epipolar.h"
#include "render/shafts/march/bilateral.h"
#include "render/shafts/march/closed_form.h"
#include "render/shafts/march/interleaved.h"
#include "render/shafts/march/march.h"
#include "render/shafts/shaft_settings.h"

namespace render {
namespace {

ShaftParameter steps(int standard) {
  return {.name = "steps",
          .meaning = "steps of the march along a ray",
          .low = 1,
          .high = 8192,
          .default_value = static_cast<double>(standard),
          .integer = true};
}

ShaftParameter sun() {
  return {.name = "sun",
          .meaning = "a point: shafts have sharp edges; or a disc: they soften with the way from what casts them",
          .choices = {"point", "disc"}};
}

// For techniques with that parameter.
bool by_disc(const ShaftSettings& s) {
  return s.integer("sun") == 1;
}

ShaftParameter divisor(int standard) {
  return {.name = "divisor",
          .meaning = "shafts are computed at 1/divisor of the picture's width and height",
          .low = 1,
          .high = 8,
          .default_value = static_cast<double>(standard),
          .integer = true};
}

ShaftTechniqueInfo closed_form() {
  return {.name = "closed-form",
          .summary = "as if nothing stood in the light: analytic",
          .parameters = {divisor(2)},
          .presets = {"closed-form:divisor=2", "closed-form:divisor=1"},
          .make = [](const ShaftSettings& s) -> std::unique_ptr<ShaftTechnique> {
            return std::make_unique<ClosedForm>(s.integer("divisor"));
          },
          .handles_translucency = true};
}

ShaftTechniqueInfo march() {
  return {.name = "march",
          .summary = "every pixel marches its own ray: brute force",
          .parameters = {steps(256),
                         {.name = "spacing",
                          .meaning = "equal lengths, equal optical depths, or lengths that grow (Tan 2020)",
                          .choices = {"distance", "depth", "growing"}},
                         {.name = "near_share",
                          .meaning = "growing: share of the steps in the near layer, of equal lengths",
                          .low = 0,
                          .high = 0.95,
                          .default_value = 0.25},
                         {.name = "near_m",
                          .meaning = "growing: depth of the near layer, metres",
                          .low = 0.01,
                          .high = 1e4,
                          .default_value = 2},
                         sun(),
                         divisor(1)},
          .presets = {"march:steps=16", "march:steps=32", "march:steps=64", "march:steps=128", "march:steps=256",
                      "march:steps=512", "march:steps=1024", "march:steps=64,spacing=growing",
                      "march:steps=256,spacing=growing"},
          .make = [](const ShaftSettings& s) -> std::unique_ptr<ShaftTechnique> {
            return std::make_unique<March>(MarchSteps{.count = s.integer("steps"),
                                                      .spacing = s.integer("spacing"),
                                                      .near_share = s.number("near_share"),
                                                      .near_m = s.number("near_m"),
                                                      .sun_disc = by_disc(s)},
                                           s.integer("divisor"));
          },
          .limited_by_shadow_resolution = true,
          .soft_sun = by_disc};
}

ShaftTechniqueInfo interleaved() {
  return {.name = "interleaved",
          .summary = "step offsets interleaved over tiles of 4 x 4 pixels, then averaged (Toth & Umenhoffer 2009)",
          .parameters = {steps(64), divisor(2)},
          .presets = {"interleaved:steps=16,divisor=2", "interleaved:steps=32,divisor=2",
                      "interleaved:steps=64,divisor=2", "interleaved:steps=32,divisor=1",
                      "interleaved:steps=64,divisor=1", "interleaved:steps=256,divisor=1"},
          .make = [](const ShaftSettings& s) -> std::unique_ptr<ShaftTechnique> {
            return std::make_unique<Interleaved>(s.integer("steps"), s.integer("divisor"));
          }};
}

ShaftTechniqueInfo bilateral() {
  ShaftParameter low = divisor(4);
  low.low = 2;
  low.meaning = "the march runs at 1/divisor of the picture's width and height";
  return {.name = "bilateral",
          .summary = "marches a small picture, then scales it up with a depth-aware bilateral filter (Ali 2017)",
          .parameters = {steps(128),
                         low,
                         {.name = "radius",
                          .meaning = "how far the filter reaches, in pixels of the small picture",
                          .low = 1,
                          .high = 4,
                          .default_value = 1,
                          .integer = true},
                         sun()},
          .presets = {"bilateral:steps=32,divisor=8", "bilateral:steps=64,divisor=4", "bilateral:steps=128,divisor=4",
                      "bilateral:steps=128,divisor=2", "bilateral:steps=512,divisor=2"},
          .make = [](const ShaftSettings& s) -> std::unique_ptr<ShaftTechnique> {
            return std::make_unique<Bilateral>(MarchSteps{.count = s.integer("steps"), .sun_disc = by_disc(s)},
                                               s.integer("divisor"), s.integer("radius"));
          },
          .soft_sun = by_disc};
}

std::vector<ShaftParameter> line_parameters(double line_px, double sample_px, double tolerance) {
  return {{.name = "line_px",
           .meaning = "pixels between epipolar lines, where they leave the picture",
           .low = 0.25,
           .high = 64,
           .default_value = line_px},
          {.name = "sample_px",
           .meaning = "pixels between samples along a line",
           .low = 1,
           .high = 256,
           .default_value = sample_px},
          {.name = "tolerance",
           .meaning = "change of the lit part between samples above which each pixel is computed by itself",
           .low = 0,
           .high = 1,
           .default_value = tolerance},
          divisor(1)};
}

LineSettings line_settings(const ShaftSettings& s) {
  return {.line_px = s.number("line_px"),
          .sample_px = s.number("sample_px"),
          .tolerance = s.number("tolerance"),
          .divisor = s.integer("divisor")};
}

ShaftTechniqueInfo epipolar() {
  ShaftTechniqueInfo info{
      .name = "epipolar",
      .summary = "marches at samples along lines through the sun, interpolates between (Engelhardt & Dachsbacher 2010)",
      .parameters = line_parameters(2, 16, 0.05),
      .presets = {"epipolar:steps=64,line_px=4,sample_px=32,tolerance=0.1", "epipolar:steps=128,line_px=2",
                  "epipolar:steps=512,line_px=1,tolerance=0.01",
                  "epipolar:steps=1024,line_px=0.5,sample_px=8,tolerance=0.005"},
      .make = [](const ShaftSettings& s) -> std::unique_ptr<ShaftTechnique> {
        return std::make_unique<Epipolar>(line_settings(s),
                                          MarchSteps{.count = s.integer("steps"), .sun_disc = by_disc(s)});
      },
      .limited_by_shadow_resolution = true,
      .soft_sun = by_disc};
  info.parameters.push_back(steps(256));
  info.parameters.push_back(sun());
  return info;
}

ShaftTechniqueInfo minmax() {
  return {
      .name = "minmax",
      .summary = "epipolar lines with exact min-max trees over the shadow map (Chen 2011, Tan 2020)",
      .parameters = line_parameters(3, 24, 0.1),
      .presets = {"minmax:line_px=8,sample_px=32,tolerance=0.2,divisor=2",
                  "minmax:line_px=6,sample_px=32,tolerance=0.2", "minmax:line_px=4,sample_px=32", "minmax",
                  "minmax:line_px=4,sample_px=8,tolerance=0.15", "minmax:line_px=2,sample_px=16,tolerance=0.05",
                  "minmax:line_px=2.5,sample_px=10,tolerance=0.08", "minmax:line_px=2.5,sample_px=12,tolerance=0.03",
                  "minmax:line_px=1,sample_px=16,tolerance=0.02", "minmax:line_px=0.5,sample_px=8,tolerance=0.005"},
      .make = [](const ShaftSettings& s) -> std::unique_ptr<ShaftTechnique> {
        return std::make_unique<Epipolar>(line_settings(s));
      },
      .limited_by_shadow_resolution = true};
}

// Those of this library, and what add_shaft_technique() adds.
std::vector<ShaftTechniqueInfo>& registry() {
  static std::vector<ShaftTechniqueInfo> all{closed_form(), march(), interleaved(), bilateral(), epipolar(), minmax()};
  return all;
}

}  // namespace

const std::vector<ShaftTechniqueInfo>& shaft_techniques() {
  return registry();
}

void add_shaft_technique(ShaftTechniqueInfo info) {
  registry().push_back(std::move(info));
}

}  // namespace render
