#include "app/calibration/gather_live.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "app/calibration/gather_window.h"
#include "app/pipeline/interrupt.h"
#include "ar/capture/devices/open_live_source.h"
#include "ar/error.h"
#include "ar/track/grey.h"
#include "calib/boards/board_finder.h"
#include "calib/views/view_collector.h"

namespace app {
namespace {

constexpr std::chrono::milliseconds kPatience{20};
constexpr std::chrono::seconds kRemindEvery{4};

std::string coverage_words(const calib::ViewCoverage& coverage) {
  const auto& tilts = coverage.tilts;
  const auto& reaches = coverage.reaches;
  return fmt::format(
      "{:.0f} % of the picture; facing {}, left {}, right {}, top {}, bottom nearer {}; near {}, middle {}, far {}",
      100.0 * coverage.picture, tilts[0], tilts[1], tilts[2], tilts[3], tilts[4], reaches[0], reaches[1], reaches[2]);
}

// Says what happens on standard error: each view that is taken, and now and then what is asked for.
class Teller {
 public:
  void ask(const calib::ViewCollector& collector) {
    spdlog::info("hold the board {}", calib::words_of(collector.next()));
    told_ = LiveClock::now();
  }
  void apply(calib::FrameUse use, const calib::ViewCollector& collector) {
    if (use == calib::FrameUse::Taken) {
      spdlog::info("view {} taken: {}", collector.taken().size(), calib::words_of(collector.last_held()));
      spdlog::info("covered: {}", coverage_words(collector.coverage()));
      if (!collector.enough()) ask(collector);
    } else if (LiveClock::now() - told_ > kRemindEvery) {
      spdlog::info("{}", calib::to_string(use));
      ask(collector);
    }
  }

 private:
  LiveClock::time_point told_;
};

class Session {
 public:
  Session(const calib::Board& board, const LiveGatherOptions& options)
      : feed_(
            ar::open_live_source(options.source, options.request),
            [request = options.request](const std::string& identity) {
              return ar::open_live_source(identity, request);
            },
            options.feed),
        finder_(board, std::max(1, static_cast<int>(std::thread::hardware_concurrency()))),
        collector_(board, feed_.info().format.width, feed_.info().format.height,
                   static_cast<std::size_t>(options.most_views)) {
    if (!options.headless) window_ = std::make_unique<GatherWindow>(feed_.info());
  }

  Gathered run() {
    feed_.start();
    teller_.ask(collector_);
    while (goes_on()) {
      if (auto arrived = feed_.take(kPatience)) look_at(arrived->frame);
      if (window_) apply(window_->show(collector_, last_, use_, feed_.lost()));
    }
    feed_.stop();
    return gathered();
  }

 private:
  bool goes_on() const { return !done_ && !collector_.enough() && !InterruptGuard::requested() && !feed_.over(); }

  void look_at(const ar::Frame& frame) {
    last_ = finder_.find(ar::grey8(frame, room_), calib::Effort::Quick);
    last_.time_s = frame.time_s;
    last_.name = fmt::format("{}#{}", feed_.info().name, frame.index);
    use_ = collector_.add(last_);
    ++pictures_;
    with_board_ += last_.points.empty() ? 0 : 1;
    teller_.apply(use_, collector_);
    if (window_) window_->upload(frame);
  }

  void apply(GatherRequest request) {
    done_ = request == GatherRequest::Finish;
    if (request == GatherRequest::DropLast) collector_.drop_last();
  }

  Gathered gathered() const {
    if (collector_.taken().empty()) {
      throw ar::InputError(fmt::format(
          "{}: no view of the board was taken: {} of {} pictures show it\n{}", feed_.info().name, with_board_,
          pictures_,
          with_board_ > 0 ? "hold it still for half a second" : "is it the right board file? skyshaft board --check"));
    }
    Gathered out;
    out.observations = {feed_.info().format.width, feed_.info().format.height, collector_.taken()};
    out.pictures = pictures_;
    out.with_board = with_board_;
    return out;
  }

  const InterruptGuard interrupt_;
  LiveFeed feed_;
  calib::BoardFinder finder_;
  calib::ViewCollector collector_;
  std::unique_ptr<GatherWindow> window_;
  Teller teller_;
  cv::Mat room_;
  calib::Observation last_;
  calib::FrameUse use_ = calib::FrameUse::NoBoard;
  int pictures_ = 0;
  int with_board_ = 0;
  bool done_ = false;
};

}  // namespace

Gathered gather_live(const calib::Board& board, const LiveGatherOptions& options) {
  return Session(board, options).run();
}

}  // namespace app
