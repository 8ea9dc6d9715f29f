// skyshaft sky: the sky's light in directions, on level ground, in pictures.

#include "app/options/sky.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>

#include "app/cmd/commands.h"
#include "app/error.h"
#include "app/process/output_files.h"
#include "app/tables/sky_picture.h"
#include "app/tables/sky_table.h"
#include "ar/error.h"
#include "ar/place/place.h"
#include "render/base/angles.h"
#include "render/sky/patches.h"

namespace app {
namespace {

struct SkyArguments {
  PlaceTimeArguments where;
  std::vector<double> sun_deg;
  std::vector<std::string> directions;
  std::string batch;
  std::string format = "text";
  std::string patches;
  std::string out;
  bool overwrite = false;
  double max_error = 0.005;
  ColorSpace space = ColorSpace::Xyz;
  SkyModelArguments model;
  SkyPictureOptions picture;
};

SunRequest sun_request(const SkyArguments& arguments) {
  SunRequest request;
  if (!arguments.where.at.empty()) request.place = place_of(arguments.where.at);
  if (!arguments.where.time.empty()) request.time = ar::parse_time(arguments.where.time);
  if (!arguments.sun_deg.empty()) {
    request.azimuth_rad = arguments.sun_deg[0] * render::kRadPerDeg;
    request.elevation_rad = arguments.sun_deg[1] * render::kRadPerDeg;
  }
  return request;
}

std::vector<ViewRequest> views_of(const SkyArguments& arguments) {
  std::vector<ViewRequest> views;
  for (const std::string& text : arguments.directions) {
    double azimuth_deg = 0.0;
    double elevation_deg = 0.0;
    char comma = 0;
    std::istringstream stream(text);
    stream >> azimuth_deg >> comma >> elevation_deg;
    if (!stream || comma != ',' || !stream.eof() || !(std::abs(elevation_deg) <= 90.0)) {
      throw UsageError("--direction " + text + ": expected AZIMUTH,ELEVATION in degrees, as 180,45");
    }
    views.push_back({azimuth_deg * render::kRadPerDeg, elevation_deg * render::kRadPerDeg});
  }
  return views;
}

void print_patches(std::ostream& out, const render::Daylight& answer, const SkyArguments& arguments) {
  render::PatchOptions options;
  options.tessellation = arguments.patches;
  options.max_error = arguments.max_error;
  const render::SkyPatches patches = render::make_patches(*answer.sky, options);
  out << "azimuth_deg,elevation_deg,solid_angle_sr,r,g,b,projected_sr\n";
  for (const render::SkyPatch& patch : patches.patches()) {
    const glm::dvec3& d = patch.direction_in_world;
    const double azimuth = std::atan2(d.x, d.y);
    out << fmt::format("{:.5f},{:.5f},{:.8g},{:.6g},{:.6g},{:.6g},{:.8g}\n",
                       (azimuth < 0.0 ? azimuth + 2.0 * std::numbers::pi : azimuth) / render::kRadPerDeg,
                       std::asin(d.z) / render::kRadPerDeg, patch.solid_angle_sr, patch.luminance_rgb.r,
                       patch.luminance_rgb.g, patch.luminance_rgb.b, patch.moment_sr.z);
  }
}

int run(const SkyArguments& arguments) try {
  const render::SkyOptions options = options_of(arguments.model);
  if (!arguments.batch.empty()) {
    std::ifstream in(arguments.batch);
    if (!in) throw ar::InputError(arguments.batch + ": cannot be opened");
    run_sky_batch(in, arguments.batch, std::cout, options);
    return 0;
  }
  const render::Daylight sky = answer(sun_request(arguments), options);
  if (!arguments.out.empty()) {
    check_may_write(arguments.out, arguments.overwrite);
    write_sky_picture(arguments.out, sky, arguments.picture);
    return 0;
  }
  if (!arguments.patches.empty()) {
    print_patches(std::cout, sky, arguments);
    return 0;
  }
  const std::vector<ViewRequest> views = views_of(arguments);
  if (arguments.format == "csv") write_sky_csv(std::cout, sky, views, arguments.space);
  if (arguments.format == "json") write_sky_json(std::cout, sky, views, arguments.space);
  if (arguments.format == "text") write_sky_text(std::cout, sky, views, arguments.space);
  return 0;
} catch (const std::invalid_argument& error) {
  throw UsageError(error.what());
}

void add_picture_options(CLI::App& sky, SkyArguments& arguments) {
  sky.add_option("-o,--output", arguments.out, "Write the whole sky as .exr or .hdr (cd/m2) or .png instead");
  sky.add_flag("--overwrite", arguments.overwrite, "Replace an existing file");
  sky.add_option(
         "--projection", arguments.picture.projection,
         "fisheye, latlong, or cube: a cube map filtered for mirrors from smooth (top) to rough, a row of faces "
         "+x -x +y -y +z -z for each roughness")
      ->transform(CLI::CheckedTransformer(std::map<std::string, SkyProjection>{
          {"fisheye", SkyProjection::Fisheye}, {"latlong", SkyProjection::LatLong}, {"cube", SkyProjection::Cube}}))
      ->default_str("fisheye");
  sky.add_option("--size", arguments.picture.height_px,
                 "Height of the picture in pixels (512), or of the largest face of a cube (64, a power of two)")
      ->check(CLI::Range(8, 8192));
  sky.add_flag("!--no-sun", arguments.picture.sun_disc, "Leave the sun's disc out");
  sky.add_option("--exposure", arguments.picture.exposure, "PNG: display white per cd/m2; fitted when absent");
}

}  // namespace

void add_sky_command(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<SkyArguments>();
  CLI::App& sky = *app.add_subcommand("sky", "The sky's light: in directions, on level ground, as a picture");
  add_place_time_options(sky, arguments->where);
  sky.add_option("--sun", arguments->sun_deg, "The sun's AZIMUTH,ELEVATION in degrees instead of place and time")
      ->delimiter(',')
      ->expected(2);
  sky.add_option("--direction", arguments->directions, "AZIMUTH,ELEVATION in degrees; may be given often");
  sky.add_option("--space", arguments->space, "xyz, yxy or rgb (linear Rec. 709), in cd/m2")
      ->transform(CLI::CheckedTransformer(std::map<std::string, ColorSpace>{
          {"xyz", ColorSpace::Xyz}, {"yxy", ColorSpace::Yxy}, {"rgb", ColorSpace::Rgb}}))
      ->default_str("xyz");
  sky.add_option("--format", arguments->format, "text, csv or json")
      ->check(CLI::IsMember({"text", "csv", "json"}))
      ->capture_default_str();
  sky.add_option(
      "--batch", arguments->batch,
      "CSV with columns utc,lat_deg,lon_deg,view_azimuth_deg,view_elevation_deg and any of turbidity,dni_wm2,"
      "dhi_wm2,epsilon,delta,sun_elevation_deg,sun_azimuth_deg; prints them with X,Y,Z,sun_angle_deg");
  sky.add_option("--patches", arguments->patches,
                 "Print the sky's patches as CSV, projected_sr for level ground: dome5728, dome144 or geodesic");
  sky.add_option("--max-error", arguments->max_error, "geodesic: error of the horizontal illuminance, relative")
      ->check(CLI::Range(1e-5, 1.0))
      ->capture_default_str();
  add_turbidity_option(sky, arguments->model.sky.turbidity);
  add_model_options(sky, arguments->model);
  add_picture_options(sky, *arguments);
  sky.footer(
      "Azimuth is from true north, clockwise. Luminance is in cd/m2, without the sun's disc.\n\n"
      "Examples:\n  skyshaft sky --at 48.8584,2.2945,35 --time 2024-06-21T07:30:00Z --direction 180,45\n"
      "  skyshaft sky --sun 135,32 --clouds light -o sky.png");
  sky.callback([&program, arguments] { program.action = [arguments] { return run(*arguments); }; });
}

}  // namespace app
