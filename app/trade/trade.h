#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/compare/image_metrics.h"
#include "render/plan/renderer.h"

namespace app {

// One technique at one setting, measured on one scene.
struct TradeRow {
  std::string technique;
  std::string settings;    // as --shafts reads it
  double shafts_ms = 0.0;  // median of the shaft pass: the GPU's timer where there is one, else the wall clock's
  double shafts_wall_ms = 0.0;
  double frame_ms = 0.0;       // median of whole frames, nothing waited for in between
  render::LinearError linear;  // of the in-scattered light alone
  render::DisplayError display;
  bool still_is_equal = true;  // two frames of a still camera, bit by bit
  double pan_change = 0.0;     // RMS change of the in-scattered light when the camera turns by 0.1 degrees, relative
  bool pareto = false;         // nothing measured is both faster and more accurate
  render::Image thumbnail;
  render::Image difference;  // from the truth's thumbnail
};

struct Trade {
  std::string scene;
  int width = 0;
  int height = 0;
  std::size_t triangles = 0;
  std::string renderer;  // the GL's name
  std::string truth_settings;
  std::optional<render::ShaftError> truth_error;
  double truth_pan_change = 0.0;
  render::MediumImage truth;
  render::Image truth_thumbnail;
  std::vector<TradeRow> rows;  // technique by technique, each from its cheapest setting to its most accurate
};

struct TradeOptions {
  std::string truth = "reference:sky=open";
  int frames = 7;                     // timed, for each setting
  std::vector<std::string> settings;  // instead of every technique's presets, where not empty
};

// Measures a scene seen from its own view. `notify` gets what is being done, a line at a time. Throws
// std::runtime_error where the scene has no medium to measure.
Trade measure_trade(render::Renderer& renderer, const render::SceneState& state, const render::Quality& quality,
                    const TradeOptions& options, const std::function<void(const std::string&)>& notify);

// Marks the rows that no other beats in both relative RMSE and time of the shaft pass.
void mark_pareto(std::vector<TradeRow>& rows);

// "lossless", "good" or "" (docs/trade.md, "The measures").
std::string grade(const TradeRow& row);

// A header and a line a row.
std::string trade_csv(const Trade& trade);

// One self-contained page: error against time, the Pareto front, convergence, thumbnails and differences.
std::string trade_html(const Trade& trade);

}  // namespace app
