#include "app/trade/trade.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>

#include "app/report/thumbnail.h"
#include "render/base/median.h"
#include "render/plan/features/features.h"
#include "render/shafts/shaft_settings.h"

namespace app {
namespace {

constexpr double kPanRad = 0.1 * 3.14159265358979323846 / 180.0;
constexpr double kSlowMs = 2000.0;  // a frame that takes longer is timed three times only

double milliseconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

render::SceneState panned(render::SceneState state) {
  state.camera.world_from_camera =
      state.camera.world_from_camera * glm::rotate(glm::dmat4(1.0), kPanRad, glm::dvec3(0.0, 1.0, 0.0));
  return state;
}

class Measure {
 public:
  Measure(render::Renderer& renderer, const render::SceneState& state, const render::Quality& quality)
      : renderer_(renderer), state_(state), panned_(panned(state)), quality_(quality) {}

  // What the eye is shown, and the air alone.
  struct Seen {
    render::LinearImage linear;
    render::Image shown;
    render::MediumImage medium;
    double pan_change = 0.0;
  };

  // For both, by the same settings.
  struct Plans {
    render::Plan still;
    render::Plan medium;
  };

  Plans plans(const std::string& settings) const {
    render::Quality quality = quality_;
    quality.shafts = render::parse_shaft_settings(settings);
    Plans plans{render::make_plan(state_, quality, render::Target::Still),
                render::make_plan(state_, quality, render::Target::Medium)};
    if (!plans.medium.has(render::feature::kMedium)) {
      throw std::runtime_error("the scene has no air to see shafts in\ngive it a `medium:` with an extinction above 0");
    }
    return plans;
  }

  Seen look(const Plans& plans) {
    Seen seen;
    seen.medium = renderer_.render_medium(state_, plans.medium);
    const render::LinearImage turned = renderer_.render_medium(panned_, plans.medium).in_scattered();
    seen.pan_change = render::linear_error(turned, seen.medium.in_scattered()).relative_rmse;
    seen.linear = renderer_.render_linear(state_, plans.still);
    seen.shown = renderer_.display_image(seen.linear, state_.exposure);
    return seen;
  }

  // After look() at the same plans, so that caches are full; `first` is what it saw. A tint by translucent occluders
  // counts with the shafts: not every technique leaves it to a pass of its own.
  void time(const render::Plan& still, int frames, const render::LinearImage& first, TradeRow& row) {
    std::vector<double> frame_ms;
    row.still_is_equal = true;
    for (int i = 0, count = frames; i < count; ++i) {
      render::LinearImage again;
      frame_ms.push_back(milliseconds_of([&] { again = renderer_.render_linear(state_, still); }));
      row.still_is_equal = row.still_is_equal && again.rgb == first.rgb;
      if (frame_ms.back() > kSlowMs) count = std::min(frames, 3);
    }
    std::vector<double> gpu_ms;
    std::vector<double> wall_ms;
    renderer_.enable_timing(true);
    for (std::size_t i = 0; i < frame_ms.size(); ++i) {
      renderer_.render_linear(state_, still);
      gpu_ms.push_back(0.0);
      wall_ms.push_back(0.0);
      for (const render::PassTime& pass : renderer_.pass_times()) {
        if (pass.name != render::feature::kShafts.name && pass.name != render::feature::kTranslucency.name) continue;
        gpu_ms.back() += pass.gpu_ms;
        wall_ms.back() += pass.wall_ms;
      }
    }
    renderer_.enable_timing(false);
    row.frame_ms = render::median(frame_ms, 0.0);
    row.shafts_wall_ms = render::median(wall_ms, 0.0);
    row.shafts_ms = render::median(gpu_ms, 0.0) > 0.0 ? render::median(gpu_ms, 0.0) : row.shafts_wall_ms;
  }

 private:
  render::Renderer& renderer_;
  const render::SceneState& state_;
  render::SceneState panned_;
  render::Quality quality_;
};

std::vector<std::string> all_settings(const TradeOptions& options) {
  if (!options.settings.empty()) return options.settings;
  std::vector<std::string> all;
  for (const render::ShaftTechniqueInfo& info : render::shaft_techniques()) {
    all.insert(all.end(), info.presets.begin(), info.presets.end());
  }
  return all;
}

}  // namespace

void mark_pareto(std::vector<TradeRow>& rows) {
  for (TradeRow& row : rows) {
    row.pareto = std::ranges::none_of(rows, [&](const TradeRow& other) {
      const bool no_worse = other.shafts_ms <= row.shafts_ms && other.linear.relative_rmse <= row.linear.relative_rmse;
      const bool better = other.shafts_ms < row.shafts_ms || other.linear.relative_rmse < row.linear.relative_rmse;
      return no_worse && better;
    });
  }
}

std::string grade(const TradeRow& row) {
  return row.display.lossless() ? "lossless" : row.display.good() ? "good" : "";
}

Trade measure_trade(render::Renderer& renderer, const render::SceneState& state, const render::Quality& quality,
                    const TradeOptions& options, const std::function<void(const std::string&)>& notify) {
  Measure measure(renderer, state, quality);
  Trade trade;
  trade.width = state.camera.width;
  trade.height = state.camera.height;
  for (const render::Instance& instance : state.instances) trade.triangles += instance.model->triangle_count();
  notify("the truth: " + options.truth);
  const Measure::Plans truth_plans = measure.plans(options.truth);
  Measure::Seen truth = measure.look(truth_plans);
  trade.truth_settings = options.truth;
  trade.truth_error = renderer.shafts_error();
  trade.truth_pan_change = truth.pan_change;
  trade.truth_thumbnail = thumbnail(truth.shown);
  const render::LinearImage true_light = truth.medium.in_scattered();
  for (const std::string& settings : all_settings(options)) {
    const Measure::Plans plans = measure.plans(settings);
    const Measure::Seen seen = measure.look(plans);
    TradeRow row;
    row.technique = plans.still.quality.shafts.technique;
    row.settings = settings;
    row.linear = render::linear_error(seen.medium.in_scattered(), true_light);
    row.display = render::display_error(seen.shown, truth.shown, truth.medium.axis_distance_m);
    row.pan_change = seen.pan_change;
    measure.time(plans.still, options.frames, seen.linear, row);
    row.thumbnail = thumbnail(seen.shown);
    row.difference = thumbnail(render::difference_image(seen.shown, truth.shown));
    notify(fmt::format("{}: {:.1f} ms, relative RMSE {:.2e}, {:.1f} dB, FLIP {:.4f} {}", settings, row.shafts_ms,
                       row.linear.relative_rmse, row.display.psnr_db, row.display.flip, grade(row)));
    trade.rows.push_back(std::move(row));
  }
  mark_pareto(trade.rows);
  trade.truth = std::move(truth.medium);
  return trade;
}

std::string trade_csv(const Trade& trade) {
  std::string csv =
      "scene,width,height,technique,settings,shafts_ms,shafts_wall_ms,frame_ms,relative_rmse,largest_relative,"
      "psnr_db,ssim,flip,share_off,largest_at_edges,still_is_equal,pan_change,truth_pan_change,pareto,grade\n";
  for (const TradeRow& row : trade.rows) {
    const render::DisplayError& d = row.display;
    csv += fmt::format("{},{},{},{},\"{}\",{:.4f},{:.4f},{:.4f},{:.6e},{:.6e},", trade.scene, trade.width, trade.height,
                       row.technique, row.settings, row.shafts_ms, row.shafts_wall_ms, row.frame_ms,
                       row.linear.relative_rmse, row.linear.largest_relative);
    csv +=
        fmt::format("{:.3f},{:.6f},{:.6f},{:.6f},{},{},{:.6e},{:.6e},{},{}\n", d.psnr_db, d.ssim, d.flip, d.share_off,
                    d.largest_at_edges ? fmt::format("{:.0f}", *d.largest_at_edges) : "", row.still_is_equal ? 1 : 0,
                    row.pan_change, trade.truth_pan_change, row.pareto ? 1 : 0, grade(row));
  }
  return csv;
}

}  // namespace app
