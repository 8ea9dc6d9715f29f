#include "ar/photometry/exposure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace ar {
namespace {

constexpr int kGridStep = 8;
// A picture of night or a lens cap must not send the exposure to zero.
constexpr double kDarkestMean = 0.01;

// Inverse of the tagged opto-electronic transfer function; PQ and HLG come here tone-mapped to BT.709.
double linear_from_coded(double coded, Transfer transfer) {
  const double v = std::clamp(coded, 0.0, 1.0);
  switch (transfer) {
    case Transfer::Linear:
      return v;
    case Transfer::Srgb:
      return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    case Transfer::Gamma22:
      return std::pow(v, 2.2);
    case Transfer::Gamma28:
      return std::pow(v, 2.8);
    default:
      return v < 0.081 ? v / 4.5 : std::pow((v + 0.099) / 1.099, 1.0 / 0.45);  // Rec. ITU-R BT.709
  }
}

unsigned sample(const Frame& frame, int x, int y) {
  const std::uint8_t* row = frame.plane[0] + y * frame.stride_bytes[0];
  if (frame.format.bit_depth == 8) return row[x];
  std::uint16_t word = 0;
  std::memcpy(&word, row + std::ptrdiff_t{2} * x, sizeof word);
  return word;
}

// Luma in [0, 1]; of planar RGB the first plane, green.
double coded_luma(const Frame& frame, int x, int y) {
  const double scale = frame.format.bit_depth == 8 ? 1.0 : 4.0;
  const double value = sample(frame, x, y) / scale;
  return frame.format.color.range == ColorRange::Limited ? (value - 16.0) / 219.0 : value / 255.0;
}

}  // namespace

double exposure_from_ev100(double ev100) {
  return 1.0 / (1.2 * std::exp2(ev100));
}

std::optional<double> exposure_from_metadata(const ExposureInfo& info) {
  if (!info.exposure_s || !info.iso || !info.f_number) return std::nullopt;
  if (!(*info.exposure_s > 0.0 && *info.iso > 0.0 && *info.f_number > 0.0)) return std::nullopt;
  return exposure_from_ev100(std::log2(*info.f_number * *info.f_number / *info.exposure_s) -
                             std::log2(*info.iso / 100.0));
}

double mean_linear_luma(const std::vector<const Frame*>& frames) {
  double sum = 0.0;
  std::int64_t count = 0;
  for (const Frame* frame : frames) {
    for (int y = kGridStep / 2; y < frame->format.height; y += kGridStep) {
      for (int x = kGridStep / 2; x < frame->format.width; x += kGridStep) {
        sum += linear_from_coded(coded_luma(*frame, x, y), frame->format.color.transfer);
        ++count;
      }
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

double exposure_from_mean(double mean_linear, double horizontal_illuminance_lux) {
  constexpr double kGrey = 0.18;
  const double grey_luminance = kGrey * horizontal_illuminance_lux / std::numbers::pi;
  return std::max(mean_linear, kDarkestMean) / grey_luminance;
}

ExposureChoice choose_exposure(const std::optional<double>& of_scene, const SceneLight& light,
                               const std::vector<const Frame*>& frames) {
  if (of_scene) return {*of_scene, "the scene"};
  const auto metadata = frames.empty() ? std::nullopt : exposure_from_metadata(frames.front()->exposure);
  if (metadata) return {*metadata, "the video's metadata"};
  const double lux = light.horizontal_illuminance_lux;
  if (frames.empty() || lux <= 0.0) return {light.default_exposure, "the default, without light to estimate it from"};
  const double mean = mean_linear_luma(frames);
  return {exposure_from_mean(mean, lux),
          fmt::format("an estimate: the first frames' mean of {:.3f} taken as 18 % grey", mean)};
}

}  // namespace ar
