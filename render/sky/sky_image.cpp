#include "render/sky/sky_image.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "render/base/angles.h"
#include "render/sky/hemisphere.h"
#include "render/sky/sky_condition.h"
#include "render/sky/sky_model_list.h"
#include "render/sky/twilight.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr double kStandsOut = 30.0;                    // times brighter than its surroundings
constexpr double kGlareRad = 3.0 * kRadPerDeg;         // what a lens spreads the disc to
constexpr double kSurroundingsRad = 6.0 * kRadPerDeg;  // ring from the glare to here

std::size_t pixel_index(const LinearImage& image, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(column);
}

double brightness(const glm::vec3& rgb) {
  return luminance(glm::dvec3(rgb));
}

double pixel_solid_angle(int row, int width, int height) {
  const double upper = std::cos(std::numbers::pi * row / height);
  const double lower = std::cos(std::numbers::pi * (row + 1) / height);
  return 2.0 * std::numbers::pi / width * (upper - lower);
}

template <typename Visit>
void for_each_near(const LinearImage& image, const glm::dvec3& centre, double radius_rad, const Visit& visit) {
  const double limit = std::cos(radius_rad);
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const glm::dvec3 direction = lat_long_direction(column, row, image.width, image.height);
      const double cosine = glm::dot(direction, centre);
      if (cosine >= limit) visit(pixel_index(image, column, row), row, cosine);
    }
  }
}

glm::dvec3 brightest_direction(const LinearImage& image) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < image.rgb.size(); ++i) {
    if (brightness(image.rgb[i]) > brightness(image.rgb[best])) best = i;
  }
  const auto width = static_cast<std::size_t>(image.width);
  const std::size_t row = best / width;
  const std::size_t column = best % width;
  return lat_long_direction(static_cast<double>(column), static_cast<double>(row), image.width, image.height);
}

glm::dvec3 mean_of_ring(const LinearImage& image, const glm::dvec3& centre) {
  glm::dvec3 sum(0.0);
  double weight = 0.0;
  for_each_near(image, centre, kSurroundingsRad, [&](std::size_t i, int row, double cosine) {
    if (cosine > std::cos(kGlareRad)) return;
    const double solid_angle = pixel_solid_angle(row, image.width, image.height);
    sum += glm::dvec3(image.rgb[i]) * solid_angle;
    weight += solid_angle;
  });
  return weight > 0.0 ? sum / weight : glm::dvec3(0.0);
}

class ImageSky final : public SkyModel {
 public:
  ImageSky(LinearImage image, double turn_rad, double scale)
      : image_(std::move(image)), turn_rad_(turn_rad), scale_(scale) {}

  void set_scale(double scale) { scale_ = scale; }

  glm::dvec3 luminance_rgb(const glm::dvec3& direction_in_world) const override {
    const glm::dvec3 view = glm::normalize(direction_in_world);
    const double azimuth = std::atan2(view.x, view.y) - turn_rad_;
    const double turns = azimuth / (2.0 * std::numbers::pi) + 0.5;
    const double column = (turns - std::floor(turns)) * image_.width - 0.5;
    const double row = std::acos(std::clamp(view.z, -1.0, 1.0)) / std::numbers::pi * image_.height - 0.5;
    const double left = std::floor(column);
    const double held = std::clamp(row, 0.0, image_.height - 1.0);
    const int above = std::min(static_cast<int>(held), image_.height - 2);
    const glm::dvec3 upper = between(above, static_cast<int>(left), column - left);
    const glm::dvec3 lower = between(above + 1, static_cast<int>(left), column - left);
    return glm::max(upper + (lower - upper) * (held - above), glm::dvec3(0.0)) * scale_;
  }

 private:
  glm::dvec3 between(int row, int column, double weight) const {
    const auto at = [&](int c) {
      const int wrapped = (c + image_.width) % image_.width;
      return glm::dvec3(image_.rgb[pixel_index(image_, wrapped, row)]);
    };
    return at(column) + (at(column + 1) - at(column)) * weight;
  }

  LinearImage image_;
  double turn_rad_;
  double scale_;
};

LinearImage read_picture(const std::filesystem::path& file) {
  std::string kind = file.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (kind == ".exr") return read_exr(file);
  if (kind == ".hdr") return read_hdr(file);
  throw std::runtime_error(file.string() + ": a sky picture must be an .exr or .hdr file");
}

SkyImage read_sky(const std::filesystem::path& file) {
  LinearImage picture = read_picture(file);
  try {
    return separate_sun(std::move(picture));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace

glm::dvec3 lat_long_direction(double column_px, double row_px, int width, int height) {
  const double azimuth = ((column_px + 0.5) / width - 0.5) * 2.0 * std::numbers::pi;
  const double from_zenith = (row_px + 0.5) / height * std::numbers::pi;
  return {std::sin(azimuth) * std::sin(from_zenith), std::cos(azimuth) * std::sin(from_zenith), std::cos(from_zenith)};
}

SkyImage separate_sun(LinearImage picture) {
  if (picture.height < 2 || picture.width != 2 * picture.height) {
    throw std::invalid_argument("a sky picture must be lat-long, twice as wide as high; found " +
                                std::to_string(picture.width) + "x" + std::to_string(picture.height));
  }
  const glm::dvec3 centre = brightest_direction(picture);
  const glm::dvec3 surroundings = mean_of_ring(picture, centre);
  PicturedSun sun;
  glm::dvec3 weighted(0.0);
  double peak = 0.0;
  LinearImage cleaned = picture;
  for_each_near(picture, centre, kGlareRad, [&](std::size_t i, int row, double) {
    const glm::dvec3 excess = glm::max(glm::dvec3(picture.rgb[i]) - surroundings, glm::dvec3(0.0));
    const glm::dvec3 light = excess * pixel_solid_angle(row, picture.width, picture.height);
    const int column = static_cast<int>(i % static_cast<std::size_t>(picture.width));
    weighted += luminance(light) * lat_long_direction(column, row, picture.width, picture.height);
    sun.irradiance_rgb += light;
    peak = std::max(peak, brightness(picture.rgb[i]));
    cleaned.rgb[i] = glm::min(picture.rgb[i], glm::vec3(surroundings));
  });
  if (!(peak > kStandsOut * std::max(luminance(surroundings), 0.0))) return {std::move(picture), std::nullopt};
  sun.direction_in_picture = glm::normalize(weighted);
  return {std::move(cleaned), sun};
}

std::unique_ptr<SkyModel> make_image_sky(const std::filesystem::path& file, const SunPosition& sun,
                                         double diffuse_lux) {
  SkyImage image = read_sky(file);
  if (!image.sun) {
    auto sky = std::make_unique<ImageSky>(std::move(image.sky), 0.0, 1.0);
    const double own = luminance(horizontal_illuminance(*sky));
    sky->set_scale(own > 0.0 ? diffuse_lux / own : 0.0);
    return sky;
  }
  const glm::dvec3& pictured = image.sun->direction_in_picture;
  const double turn = sun.azimuth_rad - std::atan2(pictured.x, pictured.y);
  auto sky = std::make_unique<ImageSky>(std::move(image.sky), turn, 1.0);
  const double direct = luminance(image.sun->irradiance_rgb) * std::max(pictured.z, 0.0);
  const double total = luminance(horizontal_illuminance(*sky)) + direct;
  const double lux = clear_illuminance_lux(std::asin(std::clamp(pictured.z, -1.0, 1.0)));
  sky->set_scale(total > 0.0 ? lux / total : 0.0);
  return sky;
}

SkyModelInfo image_model() {
  const std::string prefix = "image:";
  return {.written = prefix + "FILE",
          .prefix = prefix,
          .summary =
              "Lat-long EXR or Radiance picture. The disc is found, measured and painted over; the picture is "
              "turned so that its sun stands where the sun does, and scaled so that sun and sky give a clear "
              "day's illuminance at the pictured elevation.",
          .turbidity = TurbidityLimits{1.0, 20.0},
          .quick = false,
          .make = [prefix](const SkyOptions& options, const SunPosition& sun) {
            const double diffuse_lux =
                diffuse_level_lux(clear_condition(options, day_of(sun)).diffuse_lux, sun, options.turbidity);
            return make_image_sky(options.model.substr(prefix.size()), sun, diffuse_lux);
          }};
}

}  // namespace render
