#include "app/calibration/gather.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <thread>

#include "app/calibration/board_file.h"
#include "app/calibration/corners_cache.h"
#include "app/calibration/inputs.h"
#include "app/pipeline/interrupt.h"
#include "app/pipeline/progress.h"
#include "ar/capture/source.h"
#include "ar/error.h"
#include "ar/track/grey.h"
#include "calib/boards/board_check.h"
#include "calib/boards/board_finder.h"
#include "calib/views/view_choice.h"

namespace app {
namespace {

int detector_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

LookedAt look_at(const std::string& input, calib::BoardFinder& finder, Progress& progress, int& pictures) {
  const auto source = open_quietly(input);
  LookedAt looked{input,
                  source->info().format.width,
                  source->info().format.height,
                  !is_picture(input) && !source->info().path.empty(),
                  {}};
  const int every = looked.video ? frames_to_skip(source->info()) : 1;
  cv::Mat room;
  std::int64_t index = 0;
  while (const auto frame = source->next()) {
    if (InterruptGuard::requested()) break;
    if (index++ % every != 0) continue;
    calib::Observation seen =
        finder.find(ar::grey8(*frame, room), looked.video ? calib::Effort::Quick : calib::Effort::Thorough);
    seen.time_s = frame->time_s;
    seen.name = looked.video || index > 1 ? fmt::format("{}#{}", input, frame->index) : input;
    looked.frames.push_back(std::move(seen));
    progress.update(++pictures);
  }
  return looked;
}

void check_sizes(const std::vector<LookedAt>& all) {
  for (const LookedAt& other : all) {
    const LookedAt& first = all.front();
    if (other.width == first.width && other.height == first.height) continue;
    const bool turned = other.width == first.height && other.height == first.width;
    throw ar::InputError(fmt::format(
        "pictures of different sizes: {} has {}x{}, {} has {}x{}\n{}", first.input, first.width, first.height,
        other.input, other.width, other.height,
        turned ? "one is upright, the other across: hold the camera one way, or calibrate with one kind only"
               : "a calibration holds for one size: calibrate with the pictures of one camera mode only"));
  }
}

// How many pixels the sharpest edge of a picture takes, whatever it shows.
double sharpest_edge_px(const cv::Mat& grey8) {
  return calib::edge_width_px(grey8, {{0.5 * grey8.cols, 0.5 * grey8.rows}}, std::max(grey8.cols, grey8.rows));
}

std::string instead_of_board(const calib::Board& board, const std::string& input) {
  const auto source = open_quietly(input);
  const auto frame = source->next();
  if (!frame) return "";
  cv::Mat room;
  const cv::Mat grey = ar::grey8(*frame, room);
  const calib::OtherBoard other = calib::look_for_others(board, grey);
  if (other.mirrored) {
    return fmt::format("{} shows the board mirrored\nturn mirroring off in the camera, or flip the pictures back",
                       input);
  }
  if (!other.family.empty()) {
    return fmt::format("{} shows tags of {}: {}\ngive a board file of that family", input, other.family,
                       fmt::join(other.ids, ", "));
  }
  const bool same = other.chessboard.width == board.columns && other.chessboard.height == board.rows;
  if (other.chessboard.area() > 0 && !same) {
    return fmt::format(
        "{} shows a chessboard of {} x {} inner corners\ncount where four squares meet; --board "
        "chessboard:{}x{}:SQUARE",
        input, other.chessboard.width, other.chessboard.height, other.chessboard.width, other.chessboard.height);
  }
  const double edge = sharpest_edge_px(grey);
  if (edge > 8.0) {
    return fmt::format("{} is blurred: its sharpest edge takes {:.0f} px\nfocus, hold still, give more light", input,
                       edge);
  }
  return "";
}

[[noreturn]] void complain_of_none(const calib::Board& board, const std::vector<LookedAt>& all, int pictures) {
  std::set<int> foreign;
  for (const LookedAt& looked : all) {
    for (const calib::Observation& s : looked.frames) foreign.insert(s.foreign_ids.begin(), s.foreign_ids.end());
  }
  const std::string what =
      fmt::format("no board ({}) in {} picture{}", board.description, pictures, pictures == 1 ? "" : "s");
  if (!foreign.empty()) {
    throw ar::InputError(
        fmt::format("{}: they show tags {} of {}, none of which is on the board\ngive the board file of "
                    "the board in the pictures",
                    what, fmt::join(foreign, ", "), board.family));
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 4); ++i) {
    const std::string reason = instead_of_board(board, all[i].input);
    if (!reason.empty()) throw ar::InputError(what + ": " + reason);
  }
  throw ar::InputError(what + "\nis it the right board file? is the whole board in the picture, sharp, evenly lit?");
}

void add_views(const calib::Board& board, const LookedAt& looked, const GatherOptions& options, Gathered& out) {
  std::vector<calib::Observation> with_board;
  for (const calib::Observation& s : looked.frames) {
    if (!s.points.empty()) with_board.push_back(s);
  }
  out.with_board += static_cast<int>(with_board.size());
  if (!looked.video) {
    for (calib::Observation& s : with_board) out.observations.views.push_back(std::move(s));
    return;
  }
  for (std::size_t i : calib::choose_views(board, with_board, looked.width, looked.height,
                                           static_cast<std::size_t>(options.most_views))) {
    out.observations.views.push_back(with_board[i]);
  }
}

}  // namespace

Gathered gather(const calib::Board& board, const GatherOptions& options) {
  CornersCache cache(options.corners_cache, board_text(board));
  calib::BoardFinder finder(board, detector_threads());
  const InterruptGuard interrupt;
  Progress progress(std::nullopt, options.quiet);
  std::vector<LookedAt> all;
  Gathered out;
  for (const std::string& input : one_by_one(options.inputs)) {
    auto known = cache.find(input);
    if (known) {
      out.pictures += static_cast<int>(known->frames.size());
    } else {
      known = look_at(input, finder, progress, out.pictures);
      if (!InterruptGuard::requested()) cache.keep(*known);
    }
    all.push_back(std::move(*known));
  }
  cache.save();
  out.interrupted = InterruptGuard::requested();
  if (out.interrupted) return out;
  check_sizes(all);
  out.observations.width = all.front().width;
  out.observations.height = all.front().height;
  for (const LookedAt& looked : all) add_views(board, looked, options, out);
  if (out.observations.views.empty()) complain_of_none(board, all, out.pictures);
  return out;
}

}  // namespace app
