// Writes the variants that the renderer compiles its shaders in, for the validation of all of them when they are built:
// a line each of "path NAME=VALUE ...". What has few variants says so itself, in lines `// variant:`.

#include <fmt/format.h>

#include <cstdio>
#include <initializer_list>
#include <string>

#include "render/composite/encode_variant.h"
#include "render/composite/layers_variant.h"
#include "render/shafts/medium_variant.h"
#include "render/surface/surface_variant.h"

namespace {

using render::gl::Define;
using render::gl::Defines;

void write(const std::string& shader, const Defines& defines) {
  fmt::print("{}", shader);
  for (const Define& define : defines) fmt::print(" {}={}", define.name, define.value);
  fmt::print("\n");
}

void write_all(const std::string& shader, const std::initializer_list<Defines>& specialised,
               const render::MediumVariantLimits& limits) {
  for (const Defines& own : specialised) {
    for (const render::MediumVariant& variant : medium_variants(limits)) {
      Defines defines = own;
      for (const Define& define : variant.defines()) defines.push_back(define);
      write(shader, defines);
    }
  }
}

void write_medium() {
  const Defines none;
  const Defines by_depth{{"SPACING", "1"}};
  const Defines growing{{"SPACING", "2"}};
  const Defines line_march{{"LINE_MARCH"}};
  const Defines alone{{"ALONE"}};
  write_all("shafts/march.frag", {none}, {.sun_disc = true});
  write_all("shafts/march.frag", {by_depth, growing}, {.cascades = false});
  write_all("shafts/low_res_visibility.frag", {none}, {.sun_disc = true, .cascades = false});
  write_all("shafts/low_res_visibility.frag", {by_depth, growing}, {.cascades = false});
  write_all("shafts/interleaved.frag", {none}, {.cascades = false});
  write_all("shafts/bilateral.frag", {none}, {.sky_at_corners = true, .cascades = false});
  write_all("shafts/shading.frag", {none, {{"LIT"}}}, {.sky_at_corners = true, .cascades = false});
  write_all("shafts/translucent_tint.frag", {none, {{"OCCLUDERS"}}}, {.cascades = false});
  write_all("shafts/epipolar_samples.frag", {none, {{"BOTH_SLICES"}}}, {});
  write_all("shafts/epipolar_samples.frag", {line_march}, {.sun_disc = true});
  write_all("shafts/epipolar_picture.frag", {none}, {.sky_at_corners = true, .cascades = false});
  write_all("shafts/epipolar_picture.frag", {alone, {{"ALONE"}, {"BOTH_SLICES"}}}, {});
  write_all("shafts/epipolar_picture.frag", {{{"ALONE"}, {"LINE_MARCH"}}}, {.sun_disc = true});
}

void write_composite() {
  for (const render::LayersVariant& layers : render::layers_variants()) {
    Defines defines;
    layers.add_defines(defines);
    write("composite/still.frag", defines);
    write("composite/merge.frag", defines);
    Defines wide = defines;
    wide.push_back({"WIDE_GAMUT"});
    write("composite/merge.frag", wide);
    for (const render::PictureFormat& format : render::encoded_formats()) {
      Defines encode = encode_defines(format);
      layers.add_defines(encode);
      write("composite/encode.frag", encode);
    }
  }
}

}  // namespace

int main() {
  write_medium();
  write_composite();
  for (const render::SurfaceVariant& variant : render::object_variants())
    write("surface/object.frag", variant.defines());
  for (const render::SurfaceVariant& variant : render::real_shadow_variants()) {
    write("surface/real_shadow.frag", variant.defines());
  }
  return std::fflush(stdout) == 0 ? 0 : 1;
}
