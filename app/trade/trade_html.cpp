#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/report/log_plot.h"
#include "app/report/thumbnail.h"
#include "app/trade/trade.h"

namespace app {
namespace {

// Colours that the colour-blind tell apart [Okabe & Ito 2008], then some more.
const std::array<const char*, 12> kColors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
                                          "#806000", "#5f4690", "#38a6a5", "#94346e", "#444444", "#b0a000"};

std::vector<std::string> techniques(const Trade& trade) {
  std::vector<std::string> names;
  for (const TradeRow& row : trade.rows) {
    if (std::ranges::find(names, row.technique) == names.end()) names.push_back(row.technique);
  }
  return names;
}

const char* color(std::size_t technique) {
  return kColors[technique % kColors.size()];
}

std::string label(const TradeRow& row) {
  return fmt::format("{}: {:.3g} ms, relative RMSE {:.3g}, {:.1f} dB {}", row.settings, row.shafts_ms,
                     row.linear.relative_rmse, row.display.psnr_db, grade(row));
}

std::string head(const Trade& trade) {
  const std::string error =
      trade.truth_error ? fmt::format("; its own estimate of its error: {:.2g} in the mean, {:.2g} at most, relative",
                                      trade.truth_error->mean, trade.truth_error->largest)
                        : "";
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Shafts: accuracy against speed, "
      "{0}</title>\n"
      "<style>body{{font:15px/1.45 system-ui,sans-serif;margin:24px;max-width:1200px;color:#111;background:#fafafa}}"
      "table{{border-collapse:collapse;font-size:13px}}td,th{{padding:3px 9px;border-bottom:1px solid #ddd;"
      "text-align:right}}td:first-child,th:first-child{{text-align:left;font-family:ui-monospace,monospace}}"
      "tr.front{{background:#eaf4ea}}figure{{display:inline-block;margin:6px}}figcaption{{font-size:12px;"
      "font-family:ui-monospace,monospace;max-width:660px}}.panels svg{{margin:4px}}img{{image-rendering:auto}}"
      "</style></head><body>\n<h1>Light shafts in {0}: accuracy against speed</h1>\n"
      "<p>{1} x {2} pixels, {3} triangles, on {4}. Truth: <code>{5}</code>{6}. When the camera turns by 0.1 degrees "
      "the "
      "true in-scattered light changes by {7:.3g} (RMS, relative).</p>\n",
      escaped(trade.scene), trade.width, trade.height, trade.triangles, escaped(trade.renderer),
      escaped(trade.truth_settings), error, trade.truth_pan_change);
}

std::string scatter(const Trade& trade) {
  std::vector<PlotSeries> series;
  const std::vector<std::string> names = techniques(trade);
  for (std::size_t i = 0; i < names.size(); ++i) {
    PlotSeries one{.name = names[i], .color = color(i), .points = {}, .joined = false};
    for (const TradeRow& row : trade.rows) {
      if (row.technique != names[i]) continue;
      one.points.push_back({row.shafts_ms, row.linear.relative_rmse, label(row), row.display.lossless()});
    }
    series.push_back(one);
  }
  PlotSeries front{.name = "Pareto front", .color = "#888", .points = {}, .dashed = true, .dots = false};
  for (const TradeRow& row : trade.rows) {
    if (row.pareto) front.points.push_back({row.shafts_ms, row.linear.relative_rmse, "", false});
  }
  std::ranges::sort(front.points, {}, &PlotPoint::x);
  series.push_back(front);
  return "<h2>Error against time</h2>\n<p>Each dot is a setting (point at it for its name); rings are lossless on the "
         "displayed picture: PSNR at least 50 dB, SSIM 0.997, mean FLIP at most 0.006, at most 0.5 % of the pixels off "
         "by "
         "more than 2/255.</p>\n" +
         log_plot(series, {.x_title = "shaft pass, ms (median)", .y_title = "relative RMSE of the in-scattered light"});
}

std::string convergence(const Trade& trade) {
  std::string html =
      "<h2>Convergence</h2>\n<p>The error along each technique's settings, from its cheapest to its most "
      "accurate.</p>\n"
      "<div class=\"panels\">";
  const std::vector<std::string> names = techniques(trade);
  for (std::size_t i = 0; i < names.size(); ++i) {
    PlotSeries one{.name = names[i], .color = color(i), .points = {}};
    for (const TradeRow& row : trade.rows) {
      if (row.technique != names[i]) continue;
      one.points.push_back(
          {static_cast<double>(one.points.size() + 1), row.linear.relative_rmse, label(row), row.display.lossless()});
    }
    html += log_plot({one}, {.x_title = "setting, cheapest first",
                             .y_title = "relative RMSE",
                             .width = 380,
                             .height = 260,
                             .log_x = false});
  }
  return html + "</div>\n";
}

std::string table(const Trade& trade) {
  std::string html =
      "<h2>All settings</h2>\n<table><tr><th>setting</th><th>shafts, ms</th><th>wall, ms</th><th>frame, ms</th>"
      "<th>relative RMSE</th><th>largest relative</th><th>PSNR, dB</th><th>SSIM</th><th>FLIP</th><th>off, %</th>"
      "<th>at edges, codes</th><th>still</th><th>0.1&deg; pan</th><th>grade</th></tr>\n";
  std::vector<const TradeRow*> rows;
  for (const TradeRow& row : trade.rows) rows.push_back(&row);
  std::ranges::stable_sort(rows, {}, &TradeRow::shafts_ms);
  for (const TradeRow* row : rows) {
    const render::DisplayError& d = row->display;
    html += fmt::format(
        "<tr{}><td>{}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.1f}</td><td>{:.2e}</td><td>{:.2e}</td><td>{:.1f}</td>"
        "<td>{:.5f}</td><td>{:.4f}</td><td>{:.2f}</td><td>{}</td><td>{}</td><td>{:.3g}</td><td>{}</td></tr>\n",
        row->pareto ? " class=\"front\"" : "", escaped(row->settings), row->shafts_ms, row->shafts_wall_ms,
        row->frame_ms, row->linear.relative_rmse, row->linear.largest_relative, d.psnr_db, d.ssim, d.flip,
        100.0 * d.share_off, d.largest_at_edges ? fmt::format("{:.0f}", *d.largest_at_edges) : "",
        row->still_is_equal ? "equal" : "differs", row->pan_change, grade(*row));
  }
  return html + "</table>\n<p>Green: the Pareto front.</p>\n";
}

std::string pictures(const Trade& trade) {
  std::string html = fmt::format(
      "<h2>Pictures</h2>\n<figure><img alt=\"truth\" src=\"{}\"><figcaption>{}</figcaption></figure>\n"
      "<p>Beside each picture its difference from the truth, 16 times, about grey.</p>\n",
      data_uri(trade.truth_thumbnail), escaped(trade.truth_settings));
  for (const TradeRow& row : trade.rows) {
    html += fmt::format(
        "<figure><img alt=\"\" src=\"{}\"> <img alt=\"difference\" src=\"{}\"><figcaption>{}</figcaption></figure>\n",
        data_uri(row.thumbnail), data_uri(row.difference), escaped(label(row)));
  }
  return html;
}

}  // namespace

std::string trade_html(const Trade& trade) {
  return head(trade) + scatter(trade) + convergence(trade) + table(trade) + pictures(trade) + "</body></html>\n";
}

}  // namespace app
