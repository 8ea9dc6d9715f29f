// The registry of techniques. A new one is a header above and an entry below.
#include "render/shafts/bilateral.h"
#include "render/shafts/closed_form.h"
#include "render/shafts/epipolar.h"
#include "render/shafts/interleaved.h"
#include "render/shafts/march.h"
#include "render/shafts/shaft_settings.h"

namespace render {
namespace {

ShaftKnob steps(int standard) {
  return {.name = "steps",
          .meaning = "steps of the march along a ray",
          .low = 1,
          .high = 8192,
          .standard = static_cast<double>(standard),
          .whole = true};
}

ShaftKnob sun() {
  return {.name = "sun",
          .meaning = "a point: shafts have sharp edges; or a disc: they soften with the way from what casts them",
          .choices = {"point", "disc"}};
}

ShaftKnob divisor(int standard) {
  return {.name = "divisor",
          .meaning = "shafts are computed at 1/divisor of the picture's width and height",
          .low = 1,
          .high = 8,
          .standard = static_cast<double>(standard),
          .whole = true};
}

ShaftTechniqueInfo closed_form() {
  return {.name = "closed-form",
          .summary = "as if nothing stood in the light: analytic",
          .knobs = {divisor(2)},
          .ladder = {"closed-form:divisor=2", "closed-form:divisor=1"},
          .make = [](const ShaftSettings& s) -> std::unique_ptr<ShaftTechnique> {
            return std::make_unique<ClosedForm>(s.whole("divisor"));
          },
          .knows_glass = true};
}

ShaftTechniqueInfo march() {
  return {.name = "march",
          .summary = "every pixel marches its own ray: brute force",
          .knobs = {steps(256),
                    {.name = "spacing",
                     .meaning = "equal lengths, equal optical depths, or lengths that grow (Tan 2020)",
                     .choices = {"distance", "depth", "growing"}},
                    {.name = "near_share",
                     .meaning = "growing: share of the steps in the near layer, of equal lengths",
                     .low = 0,
                     .high = 0.95,
                     .standard = 0.25},
                    {.name = "near_m",
                     .meaning = "growing: depth of the near layer, metres",
                     .low = 0.01,
                     .high = 1e4,
                     .standard = 2},
                    sun(),
                    divisor(1)},
          .ladder = {"march:steps=16", "march:steps=32", "march:steps=64", "march:steps=128", "march:steps=256",
                     "march:steps=512", "march:steps=1024", "march:steps=64,spacing=growing",
                     "march:steps=256,spacing=growing"},
          .make = [](const ShaftSettings& s) -> std::unique_ptr<ShaftTechnique> {
            return std::make_unique<March>(MarchSteps{.count = s.whole("steps"),
                                                      .spacing = s.whole("spacing"),
                                                      .near_share = s.number("near_share"),
                                                      .near_m = s.number("near_m"),
                                                      .sun_disc = s.whole("sun") == 1},
                                           s.whole("divisor"));
          },
          .shows_texels = true};
}

ShaftTechniqueInfo interleaved() {
  return {
      .name = "interleaved",
      .summary = "step offsets interleaved over tiles of 4 x 4 pixels, then averaged (Toth & Umenhoffer 2009)",
      .knobs = {steps(64), divisor(2)},
      .ladder = {"interleaved:steps=16,divisor=2", "interleaved:steps=32,divisor=2", "interleaved:steps=64,divisor=2",
                 "interleaved:steps=32,divisor=1", "interleaved:steps=64,divisor=1", "interleaved:steps=256,divisor=1"},
      .make = [](const ShaftSettings& s) -> std::unique_ptr<ShaftTechnique> {
        return std::make_unique<Interleaved>(s.whole("steps"), s.whole("divisor"));
      }};
}

ShaftTechniqueInfo bilateral() {
  ShaftKnob low = divisor(4);
  low.low = 2;
  low.meaning = "the march runs at 1/divisor of the picture's width and height";
  return {.name = "bilateral",
          .summary = "marches a small picture, then scales it up with a depth-aware bilateral filter (Ali 2017)",
          .knobs = {steps(128),
                    low,
                    {.name = "radius",
                     .meaning = "how far the filter reaches, in pixels of the small picture",
                     .low = 1,
                     .high = 4,
                     .standard = 1,
                     .whole = true},
                    sun()},
          .ladder = {"bilateral:steps=32,divisor=8", "bilateral:steps=64,divisor=4", "bilateral:steps=128,divisor=4",
                     "bilateral:steps=128,divisor=2", "bilateral:steps=512,divisor=2"},
          .make = [](const ShaftSettings& s) -> std::unique_ptr<ShaftTechnique> {
            return std::make_unique<Bilateral>(MarchSteps{.count = s.whole("steps"), .sun_disc = s.whole("sun") == 1},
                                               s.whole("divisor"), s.whole("radius"));
          }};
}

std::vector<ShaftKnob> line_knobs(double line_px, double sample_px, double tolerance) {
  return {{.name = "line_px",
           .meaning = "pixels between epipolar lines, where they leave the picture",
           .low = 0.25,
           .high = 64,
           .standard = line_px},
          {.name = "sample_px",
           .meaning = "pixels between samples along a line",
           .low = 1,
           .high = 256,
           .standard = sample_px},
          {.name = "tolerance",
           .meaning = "change of the lit part between samples above which each pixel is computed by itself",
           .low = 0,
           .high = 1,
           .standard = tolerance},
          divisor(1)};
}

LineSettings line_settings(const ShaftSettings& s) {
  return {.line_px = s.number("line_px"),
          .sample_px = s.number("sample_px"),
          .tolerance = s.number("tolerance"),
          .divisor = s.whole("divisor")};
}

ShaftTechniqueInfo epipolar() {
  ShaftTechniqueInfo info{
      .name = "epipolar",
      .summary = "marches at samples along lines through the sun, interpolates between (Engelhardt & Dachsbacher 2010)",
      .knobs = line_knobs(2, 16, 0.05),
      .ladder = {"epipolar:steps=64,line_px=4,sample_px=32,tolerance=0.1", "epipolar:steps=128,line_px=2",
                 "epipolar:steps=512,line_px=1,tolerance=0.01",
                 "epipolar:steps=1024,line_px=0.5,sample_px=8,tolerance=0.005"},
      .make = [](const ShaftSettings& s) -> std::unique_ptr<ShaftTechnique> {
        return std::make_unique<Epipolar>(line_settings(s),
                                          MarchSteps{.count = s.whole("steps"), .sun_disc = s.whole("sun") == 1});
      },
      .shows_texels = true};
  info.knobs.push_back(steps(256));
  info.knobs.push_back(sun());
  return info;
}

ShaftTechniqueInfo minmax() {
  return {.name = "minmax",
          .summary = "epipolar lines with exact min-max trees over the shadow map (Chen 2011, Tan 2020)",
          .knobs = line_knobs(3, 24, 0.1),
          .ladder = {"minmax:line_px=8,sample_px=32,tolerance=0.2,divisor=2",
                     "minmax:line_px=6,sample_px=32,tolerance=0.2", "minmax:line_px=4,sample_px=32", "minmax",
                     "minmax:line_px=4,sample_px=8,tolerance=0.15", "minmax:line_px=2,sample_px=16,tolerance=0.05",
                     "minmax:line_px=2.5,sample_px=10,tolerance=0.08", "minmax:line_px=2.5,sample_px=12,tolerance=0.03",
                     "minmax:line_px=1,sample_px=16,tolerance=0.02", "minmax:line_px=0.5,sample_px=8,tolerance=0.005"},
          .make = [](const ShaftSettings& s) -> std::unique_ptr<ShaftTechnique> {
            return std::make_unique<Epipolar>(line_settings(s));
          },
          .shows_texels = true};
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
