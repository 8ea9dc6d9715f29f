#include "app/tables/sky_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "app/error.h"
#include "render/base/median.h"
#include "render/sky/hemisphere.h"
#include "render/sky/sky_cube.h"
#include "render/sky/sky_image.h"
#include "render/sun/limb_darkening.h"
#include "render/sun/spectrum.h"

namespace app {
namespace {

int height_of(const SkyPictureOptions& options) {
  constexpr int kPicture = 512;
  constexpr int kCube = 64;
  return options.height_px.value_or(options.projection == SkyProjection::Cube ? kCube : kPicture);
}

// Direction of a point of the picture, pixels from its edge; nothing outside a fisheye's circle.
std::optional<glm::dvec3> direction_at(const SkyPictureOptions& options, double x_px, double y_px) {
  const int height = height_of(options);
  if (options.projection == SkyProjection::LatLong) {
    return render::lat_long_direction(x_px - 0.5, y_px - 0.5, 2 * height, height);
  }
  const double x = 2.0 * x_px / height - 1.0;
  const double y = 1.0 - 2.0 * y_px / height;
  const double radius = std::hypot(x, y);
  if (radius > 1.0) return std::nullopt;
  const double from_zenith = 0.5 * std::numbers::pi * radius;
  const double scale = radius > 0.0 ? std::sin(from_zenith) / radius : 0.0;
  return glm::dvec3(-x * scale, y * scale, std::cos(from_zenith));
}

// The sun's disc over its mean luminance in a pixel: its limb is dark, and the ground hides what is below.
glm::dvec3 disc_in_pixel(const SkyPictureOptions& options, int column, int row, const glm::dvec3& sun,
                         double radius_rad) {
  constexpr int kSamples = 5;
  glm::dvec3 sum(0.0);
  for (int j = 0; j < kSamples; ++j) {
    for (int i = 0; i < kSamples; ++i) {
      const auto direction = direction_at(options, column + (i + 0.5) / kSamples, row + (j + 0.5) / kSamples);
      if (!direction || direction->z < 0.0) continue;
      const double r = 2.0 * std::asin(std::min(0.5 * glm::length(*direction - sun), 1.0)) / radius_rad;
      if (r <= 1.0) sum += render::limb_darkening_rgb(r);
    }
  }
  return sum / static_cast<double>(kSamples * kSamples);
}

double median_luminance(const render::LinearImage& picture) {
  std::vector<double> levels;
  for (const glm::vec3& rgb : picture.rgb) {
    const double level = render::luminance(glm::dvec3(rgb));
    if (level > 0.0) levels.push_back(level);
  }
  if (levels.empty()) return 1.0;
  return render::upper_median(std::move(levels));
}

// Four samples a pixel, so that the edges of clouds do not step.
glm::dvec3 mean_luminance(const render::SkyModel& sky, const SkyPictureOptions& options, int column, int row) {
  glm::dvec3 sum(0.0);
  int count = 0;
  for (const double y : {0.25, 0.75}) {
    for (const double x : {0.25, 0.75}) {
      const auto direction = direction_at(options, column + x, row + y);
      if (!direction || direction->z < 0.0) continue;
      sum += sky.luminance_rgb(*direction);
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : sum;
}

// As the eye adapts: fully by day, less and less towards the night, which stays dark.
double fitted_exposure(const render::LinearImage& picture) {
  const double median = median_luminance(picture);
  const double brightness = std::clamp((std::log10(median) + 5.0) / 7.0, 0.12, 1.0);
  return 0.42 * brightness * brightness / median;
}

double srgb_from_linear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

// Luminance is bent towards white, colour kept; what still leaves the gamut fades to white.
glm::dvec3 display_color(const glm::dvec3& exposed_rgb) {
  const double level = render::luminance(exposed_rgb);
  if (!(level > 0.0)) return glm::dvec3(0.0);
  const double bent = 1.0 - std::exp(-level);
  glm::dvec3 rgb = exposed_rgb * (bent / level);
  const double highest = std::max({rgb.r, rgb.g, rgb.b});
  if (highest > 1.0) rgb = glm::dvec3(bent) + (rgb - bent) * ((1.0 - bent) / (highest - bent));
  return rgb;
}

render::Image tone_mapped(const render::LinearImage& picture, std::optional<double> exposure) {
  const double scale = exposure.value_or(fitted_exposure(picture));
  render::Image image{picture.width, picture.height, {}};
  image.rgba.reserve(picture.rgb.size() * 4);
  for (const glm::vec3& rgb : picture.rgb) {
    const glm::dvec3 shown = display_color(glm::dvec3(rgb) * scale);
    for (int c = 0; c < 3; ++c) {
      image.rgba.push_back(
          static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(srgb_from_linear(shown[c]), 0.0, 1.0))));
    }
    image.rgba.push_back(255);
  }
  return image;
}

}  // namespace

namespace {

// A level's faces side by side, the levels below each other from smooth to rough.
render::LinearImage cube_picture(const render::Daylight& answer, int size_px) {
  constexpr double kGroundAlbedo = 0.2;
  constexpr int kSmallestFace = 4;
  constexpr int kMostLevels = 5;
  render::SkyCubeOptions options{size_px, 1};
  while (options.levels < kMostLevels && size_px >> options.levels >= kSmallestFace) ++options.levels;
  const double sine = std::max(std::sin(answer.sun.apparent_elevation_rad), 0.0);
  const glm::dvec3 ground = (render::horizontal_illuminance(*answer.sky) + answer.sun_illuminance_rgb * sine) *
                            (kGroundAlbedo / std::numbers::pi);
  const std::vector<render::CubeLevel> levels = render::make_sky_cube(*answer.sky, ground, options);
  render::LinearImage picture{6 * size_px, 0, {}};
  for (const render::CubeLevel& level : levels) picture.height += level.size_px;
  const auto width = static_cast<std::size_t>(picture.width);
  picture.rgb.assign(width * static_cast<std::size_t>(picture.height), glm::vec3(0.0F));
  std::size_t top = 0;
  for (const render::CubeLevel& level : levels) {
    const auto size = static_cast<std::size_t>(level.size_px);
    for (std::size_t face = 0; face < 6; ++face) {
      for (std::size_t row = 0; row < size; ++row) {
        const auto from = level.face[face].begin() + static_cast<std::ptrdiff_t>(row * size);
        std::copy_n(from, size, picture.rgb.begin() + static_cast<std::ptrdiff_t>((top + row) * width + face * size));
      }
    }
    top += size;
  }
  return picture;
}

}  // namespace

render::LinearImage sky_picture(const render::Daylight& answer, const SkyPictureOptions& options) {
  const int height = height_of(options);
  if (options.projection == SkyProjection::Cube) return cube_picture(answer, height);
  const bool lat_long = options.projection == SkyProjection::LatLong;
  render::LinearImage picture{lat_long ? 2 * height : height, height, {}};
  picture.rgb.assign(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height),
                     glm::vec3(0.0F));
  const glm::dvec3 sun = answer.sun.apparent_direction_in_world();
  const double radius = answer.sun.angular_radius_rad;
  const double near_sun = std::cos(radius + 2.0 * std::numbers::pi / height);
  const double visible = render::visible_light_share(answer.sun.apparent_elevation_rad / radius, 555.0);
  const glm::dvec3 disc =
      visible > 0.0 ? answer.sun_illuminance_rgb / (visible * std::numbers::pi * radius * radius) : glm::dvec3(0.0);
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 0; column < picture.width; ++column) {
      const auto direction = direction_at(options, column + 0.5, row + 0.5);
      if (!direction || direction->z < 0.0) continue;
      glm::dvec3 rgb = mean_luminance(*answer.sky, options, column, row);
      if (options.sun_disc && glm::dot(*direction, sun) > near_sun) {
        rgb += disc * disc_in_pixel(options, column, row, sun, radius);
      }
      picture.rgb[static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) +
                  static_cast<std::size_t>(column)] = glm::vec3(rgb);
    }
  }
  return picture;
}

void write_sky_picture(const std::filesystem::path& path, const render::Daylight& answer,
                       const SkyPictureOptions& options) {
  const std::string ending = path.extension().string();
  if (ending != ".exr" && ending != ".hdr" && ending != ".png") {
    throw UsageError(path.string() + ": a sky picture is written as .exr, .hdr or .png");
  }
  const render::LinearImage picture = sky_picture(answer, options);
  if (ending == ".exr") render::write_exr(path, picture);
  if (ending == ".hdr") render::write_hdr(path, picture);
  if (ending == ".png") render::write_png(path, tone_mapped(picture, options.exposure));
}

}  // namespace app
