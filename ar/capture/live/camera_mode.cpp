#include "ar/capture/live/camera_mode.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "ar/capture/live/camera_format.h"

namespace ar {
namespace {

constexpr double kReached = 0.97;  // 29.97 is as good as 30

// The offered rate that serves `wish` best: the slowest that reaches it, else the fastest there is. Unknown rates may
// be anything, so the wish is as good as any.
double nearest_rate(const CameraMode& mode, double request) {
  if (mode.rates.empty()) return request;
  if (mode.rates_are_range) return std::clamp(request, mode.rates.back(), mode.rates.front());
  double best = mode.rates.front();
  for (const double rate : mode.rates) {
    if (rate >= kReached * request) best = rate;
  }
  return best;
}

// How far sizes are from each other, as a ratio of lengths: 0 for equal ones.
double size_distance(const CameraMode& mode, const LiveRequest& request) {
  const auto apart = [](int offered, int wanted) {
    return std::abs(std::log(static_cast<double>(offered) / static_cast<double>(wanted)));
  };
  const bool any = !request.width && !request.height;
  double distance = 0.0;
  if (request.width || any) distance += apart(mode.width, request.width.value_or(kUsualWidth));
  if (request.height || any) distance += apart(mode.height, request.height.value_or(kUsualHeight));
  return distance;
}

// Smaller is better, first member first.
std::tuple<double, double, double, int> cost(const CameraMode& mode, const LiveRequest& request) {
  const double wanted_rate = request.rate.value_or(kUsualRate);
  const double reached = nearest_rate(mode, wanted_rate) / wanted_rate;
  const double rate_lack = reached >= kReached ? 0.0 : 1.0 - reached;
  // The fastest of several sizes that all reach the rate is no better than the others.
  const double size = size_distance(mode, request);
  const bool size_asked = request.width || request.height;
  const int rank = camera_format_rank(mode.format);
  // Of a width alone the usual shape: 16:9.
  const double shape = std::abs(std::log(mode.width * 9.0 / (mode.height * 16.0)));
  if (size_asked) return {size, rate_lack, shape, rank};
  return {rate_lack, size, shape, rank};
}

}  // namespace

std::optional<ModeChoice> choose_mode(const std::vector<CameraMode>& modes, const LiveRequest& request) {
  const CameraMode* best = nullptr;
  for (const CameraMode& mode : modes) {
    if (!find_camera_format(mode.format)) continue;
    if (request.format && mode.format != *request.format) continue;
    if (best == nullptr || cost(mode, request) < cost(*best, request)) best = &mode;
  }
  if (best == nullptr) return std::nullopt;
  return ModeChoice{*best, nearest_rate(*best, request.rate.value_or(kUsualRate))};
}

std::string describe(const CameraMode& mode) {
  std::string text = fmt::format("{} {}x{}", mode.format, mode.width, mode.height);
  if (mode.rates.empty()) return text;
  if (mode.rates_are_range) return text + fmt::format(" at {:.4g} to {:.4g}", mode.rates.back(), mode.rates.front());
  std::vector<std::string> rates;
  for (const double rate : mode.rates) rates.push_back(fmt::format("{:.4g}", rate));
  return text + " at " + fmt::format("{}", fmt::join(rates, ", "));
}

}  // namespace ar
