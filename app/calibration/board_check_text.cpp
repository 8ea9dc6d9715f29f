#include "app/calibration/board_check_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <set>

#include "app/calibration/gather.h"
#include "app/calibration/inputs.h"
#include "ar/track/grey.h"
#include "calib/boards/board_check.h"
#include "calib/boards/board_finder.h"

namespace app {
namespace {

// Tags of the board that the photograph does not show.
std::vector<int> missing_tags(const calib::Board& board, const calib::Observation& seen) {
  const std::set<int> points(seen.points.begin(), seen.points.end());
  std::vector<int> missing;
  for (const calib::BoardTag& tag : board.tags) {
    if (board.kind == calib::BoardKind::Tags && !points.contains(tag.first_point)) missing.push_back(tag.id);
  }
  return missing;
}

// How far the points are from where a flat board without lens distortion would have them, in units of the board.
double misfit_m(const calib::Board& board, const calib::Observation& seen) {
  std::vector<cv::Point2d> on_board;
  for (int p : seen.points) {
    const cv::Vec3d& at = board.points[static_cast<std::size_t>(p)];
    on_board.emplace_back(at[0], at[1]);
  }
  const cv::Mat board_from_picture = cv::findHomography(seen.px, on_board, cv::LMEDS);
  if (board_from_picture.empty()) return std::numeric_limits<double>::infinity();
  std::vector<cv::Point2d> back;
  cv::perspectiveTransform(seen.px, back, board_from_picture);
  double sum = 0.0;
  for (std::size_t i = 0; i < back.size(); ++i) sum += (back[i] - on_board[i]).dot(back[i] - on_board[i]);
  return std::sqrt(sum / static_cast<double>(back.size()));
}

}  // namespace

BoardCheck check_board_photo(const calib::Board& board, const std::string& photo) {
  GatherOptions one;
  one.inputs = {photo};
  one.quiet = true;
  const Gathered gathered = gather(board, one);  // throws with the reason where the board is not there
  BoardCheck check;
  if (gathered.interrupted) return check;
  const calib::Observation& seen = gathered.observations.views.front();
  check.text = fmt::format("board        {}\nseen         {} of {} points\n", board.description, seen.points.size(),
                           board.points.size());
  const auto missing = missing_tags(board, seen);
  if (!missing.empty()) check.text += fmt::format("not seen     tags {}\n", fmt::join(missing, ", "));
  if (!seen.foreign_ids.empty()) {
    check.text += fmt::format("not on it    tags {} of the photograph\n", fmt::join(seen.foreign_ids, ", "));
  }
  check.text += fmt::format("sharpness    edges take {:.1f} px (sharp: 2 to 3)\n", seen.edge_width_px);
  double misfit = 0.0;
  if (board.is_flat() && seen.points.size() > 4) {
    misfit = misfit_m(board, seen) / board.unit_m();
    check.text += fmt::format("places       off by {:.2f} % of a {} RMS, lens distortion included\n", 100.0 * misfit,
                              board.kind == calib::BoardKind::Tags ? "tag" : "square");
  }
  const auto wrong = calib::wrong_step(board, {seen}, 0.06);
  if (wrong) {
    check.text += fmt::format(
        "spacing      from tag {} to tag {} it is {:+.2f} tag sizes right, {:+.2f} down; the file says "
        "{:+.2f}, {:+.2f}\n",
        wrong->from_id, wrong->to_id, wrong->measured.x, wrong->measured.y, wrong->expected.x, wrong->expected.y);
  }
  check.fits = seen.foreign_ids.empty() && !wrong && misfit < 0.1;
  check.text += check.fits ? "verdict      the photograph fits the board file\n"
                           : "verdict      the photograph does not fit the board file\n";
  return check;
}

}  // namespace app
