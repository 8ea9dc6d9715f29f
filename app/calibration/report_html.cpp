#include <fmt/format.h>

#include <cmath>

#include "app/calibration/report_plots.h"
#include "app/calibration/summary.h"
#include "app/report/log_plot.h"

namespace app {
namespace {

const char* verdict_color(calib::Verdict verdict) {
  switch (verdict) {
    case calib::Verdict::Good:
      return "#d9f0dc";
    case calib::Verdict::Usable:
      return "#fdf3cf";
    case calib::Verdict::Rejected:
      return "#f8d7d4";
  }
  return "#fff";
}

std::string head(const Calibration& c) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Camera calibration, {0}</title>\n"
      "<style>body{{font:15px/1.45 system-ui,sans-serif;margin:24px;max-width:1200px;color:#111;background:#fafafa}}"
      "table{{border-collapse:collapse;font-size:14px}}td,th{{padding:3px 12px;border-bottom:1px solid #ddd;"
      "text-align:right}}td:first-child,th:first-child{{text-align:left}}.verdict{{padding:12px 16px;background:{1};"
      "border-radius:6px;font-size:17px}}figure{{display:inline-block;margin:8px;vertical-align:top}}"
      "figcaption{{font-weight:600}}li span{{color:#555}}</style></head><body>\n<h1>Camera calibration</h1>\n"
      "<p>{2}; {3} views of {4}x{5} px; lens <b>{6}</b>; {0}.</p>\n<p class=\"verdict\">{7}</p>\n",
      c.date, verdict_color(c.assessment.verdict), escaped(c.board.description), note_of(c).views,
      c.gathered.observations.width, c.gathered.observations.height, calib::to_string(c.solution.lens),
      escaped(c.assessment.sentence(c.solution)));
}

std::string diagnostics(const Calibration& c) {
  if (c.assessment.diagnostics.empty()) return "";
  std::string html = "<h2>What to do next</h2>\n<ul>\n";
  for (const calib::Diagnostic& f : c.assessment.diagnostics) {
    html += fmt::format("<li>{}{}: <b>{}</b></li>\n", f.rejects ? "<b>Rejects</b> " : "", escaped(f.what),
                        escaped(f.to_do));
  }
  return html + "</ul>\n";
}

std::string numbers(const Calibration& c) {
  std::string html =
      "<h2>The camera</h2>\n<table><tr><th>parameter</th><th>value</th><th>standard deviation</th></tr>\n";
  const auto names = calib::intrinsics_names(c.solution.lens);
  for (std::size_t i = 0; i < names.size(); ++i) {
    html += fmt::format("<tr><td>{}</td><td>{:.6f}</td><td>{:.6f}</td></tr>\n", names[i], c.solution.intrinsics[i],
                        c.solution.sigma_of(static_cast<int>(i)));
  }
  html += fmt::format(
      "<tr><td>RMS, px</td><td>{:.4f}</td><td></td></tr><tr><td>held-out RMS, px ({} folds)</td>"
      "<td>{:.4f}</td><td></td></tr><tr><td>noise of one coordinate, px</td><td>{:.4f}</td><td></td></tr>"
      "<tr><td>corners used, left out</td><td>{}</td><td>{}</td></tr></table>\n",
      c.solution.rms_px, c.assessment.folds, c.assessment.held_out_rms_px, c.solution.sigma_px, c.solution.points_used,
      c.solution.points_rejected);
  return html;
}

std::string lenses(const Calibration& c) {
  if (c.trials.empty()) return "";
  std::string html =
      "<h2>Lenses tried</h2>\n<p>The simplest whose held-out RMS is within a tenth of the best one's is "
      "kept.</p>\n<table>"
      "<tr><th>lens</th><th>RMS px</th><th>held-out RMS px</th></tr>\n";
  for (const calib::LensTrial& t : c.trials) {
    const bool chosen = t.lens == c.solution.lens;
    html += t.solved ? fmt::format("<tr><td>{0}{1}{2}</td><td>{3:.4f}</td><td>{4:.4f}</td></tr>\n", chosen ? "<b>" : "",
                                   calib::to_string(t.lens), chosen ? "</b>" : "", t.rms_px, t.held_out_rms_px)
                     : fmt::format("<tr><td>{}</td><td>-</td><td>-</td></tr>\n", calib::to_string(t.lens));
  }
  return html + "</table>\n";
}

std::string figure(const std::string& title, const std::string& svg) {
  return fmt::format("<figure><figcaption>{}</figcaption>\n{}</figure>\n", title, svg);
}

std::string outliers(const Calibration& c) {
  const auto all = outliers_of(c);
  if (all.empty()) return "";
  std::string html = fmt::format(
      "<h2>Outliers</h2>\n<p>{} corners were left out, worst first.</p>\n<table><tr><th>view</th>"
      "<th>point of the board</th><th>off by px</th></tr>\n",
      all.size());
  for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 50); ++i) {
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{:.2f}</td></tr>\n", escaped(all[i].view), all[i].point,
                        all[i].off_px);
  }
  return html + "</table>\n";
}

}  // namespace

std::string report_html(const Calibration& c) {
  constexpr int kWide = 520;
  std::string html = head(c) + diagnostics(c) + numbers(c);
  html += "<h2>The picture</h2>\n";
  html += figure("Coverage", coverage_plot(c, kWide));
  html += figure("Where a direction is seen: projected uncertainty", uncertainty_plot(c, kWide));
  html += figure("Residuals", residual_plot(c, kWide));
  html += figure("Distortion", distortion_plot(c, kWide));
  html += "<h2>The views</h2>\n";
  html += figure("Residuals about zero", scatter_plot(c));
  html += figure("Tilts of the board", tilt_plot(c));
  html += figure("RMS of each view", view_bars(c));
  return html + lenses(c) + outliers(c) + "</body></html>\n";
}

}  // namespace app
