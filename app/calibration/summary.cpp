#include "app/calibration/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

namespace app {
namespace {

std::string short_name(const std::string& name) {
  return std::filesystem::path(name).filename().string();
}

std::string diagnostics_text(const calib::Assessment& assessment) {
  std::string text;
  for (const calib::Diagnostic& f : assessment.diagnostics) {
    text += fmt::format("  {} {}\n      {}\n", f.rejects ? "[rejects]" : "[note]   ", f.what, f.to_do);
  }
  return text;
}

std::string outliers_text(const Calibration& c) {
  const std::vector<Outlier> all = outliers_of(c);
  if (all.empty()) return "";
  std::map<std::string, std::pair<int, double>> views;  // number and worst
  for (const Outlier& o : all) {
    auto& [count, worst] = views[o.view];
    ++count;
    worst = std::max(worst, o.off_px);
  }
  std::string text = fmt::format("outliers     {} corners left out:", all.size());
  int shown = 0;
  for (const auto& [view, what] : views) {
    if (++shown > 8) {
      text += fmt::format(" and in {} more views", views.size() - 8);
      break;
    }
    text += fmt::format("{} {} {} (worst {:.1f} px)", shown > 1 ? "," : "", short_name(view), what.first, what.second);
  }
  return text + "\n";
}

std::string trials_text(const Calibration& c) {
  if (c.trials.empty()) return "";
  std::string text = "lenses tried held-out RMS px:";
  for (const calib::LensTrial& t : c.trials) {
    text += fmt::format(" {} {}", calib::to_string(t.lens), t.solved ? fmt::format("{:.3f}", t.held_out_rms_px) : "-");
  }
  return text + "\n";
}

std::string board_error_text(const Calibration& c) {
  if (c.solution.board_error.empty()) return "";
  double sum = 0.0;
  double largest = 0.0;
  for (const cv::Vec3d& e : c.solution.board_error) {
    sum += e.dot(e);
    largest = std::max(largest, cv::norm(e));
  }
  return fmt::format("board errors {:.3f} mm RMS, {:.3f} mm at most\n",
                     1e3 * std::sqrt(sum / static_cast<double>(c.solution.board_error.size())), 1e3 * largest);
}

}  // namespace

std::vector<Outlier> outliers_of(const Calibration& c) {
  std::vector<Outlier> out;
  for (std::size_t v = 0; v < c.solution.views.size(); ++v) {
    const calib::ViewFit& fit = c.solution.views[v];
    const calib::Observation& view = c.gathered.observations.views[v];
    for (std::size_t i = 0; i < fit.used.size(); ++i) {
      if (!fit.used[i]) out.push_back({view.name, view.points[i], cv::norm(fit.residual_px[i])});
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const Outlier& a, const Outlier& b) { return a.off_px > b.off_px; });
  return out;
}

calib::CameraNote note_of(const Calibration& c) {
  calib::CameraNote note;
  note.date = c.date;
  note.rms_px = c.solution.rms_px;
  note.held_out_rms_px = c.assessment.held_out_rms_px;
  note.views = static_cast<int>(std::count_if(c.solution.views.begin(), c.solution.views.end(),
                                              [](const calib::ViewFit& v) { return v.any_used(); }));
  for (int i = 0; i < static_cast<int>(c.solution.intrinsics.size()); ++i) {
    (i < 4 ? note.sigma_intrinsics : note.sigma_distortion).push_back(c.solution.sigma_of(i));
  }
  note.sigma_distortion.resize(c.solution.camera.distortion.size(), 0.0);
  return note;
}

std::string summary_text(const Calibration& c) {
  const calib::Solution& s = c.solution;
  const calib::Assessment& j = c.assessment;
  std::string text = fmt::format("board        {}\n", c.board.description);
  text += fmt::format("views        {} used; the board in {} of {} pictures of {}x{}\n", note_of(c).views,
                      c.gathered.with_board, c.gathered.pictures, c.gathered.observations.width,
                      c.gathered.observations.height);
  text += trials_text(c);
  text += fmt::format("lens         {}\n", calib::to_string(s.lens));
  const auto names = calib::intrinsics_names(s.lens);
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += fmt::format("  {:3} {:14.6f} +- {:.6f}\n", names[i], s.intrinsics[i], s.sigma_of(static_cast<int>(i)));
  }
  text += fmt::format("RMS          {:.4f} px over {} corners; one coordinate's noise {:.4f} px\n", s.rms_px,
                      s.points_used, s.sigma_px);
  text += fmt::format("held out     {:.4f} px RMS in {} folds\n", j.held_out_rms_px, j.folds);
  text += fmt::format("uncertainty  {:.3f} px where there were corners (median), {:.3f} px at worst in the picture\n",
                      j.sigma_typical_px, j.sigma_worst_px);
  text +=
      fmt::format("coverage     {:.0f} % of the picture; tilts up to {:.0f} degrees, normals {:.0f} degrees apart\n",
                  100.0 * j.covered, j.largest_tilt_rad * 180.0 / std::numbers::pi,
                  j.normals_spread_rad * 180.0 / std::numbers::pi);
  text += board_error_text(c) + outliers_text(c);
  return text + "verdict      " + j.sentence(s) + "\n" + diagnostics_text(j);
}

}  // namespace app
