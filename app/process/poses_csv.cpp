#include "app/process/poses_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "app/process/output_files.h"
#include "render/base/whole_file.h"

namespace app {

PosesCsv::PosesCsv(std::filesystem::path path, bool overwrite)
    : path_(std::move(path)), beside_(path_.string() + fmt::format(".part-{}", getpid())), overwrite_(overwrite) {
  check_may_write(path_, overwrite);
  out_.open(beside_, std::ios::trunc);
  out_ << "frame,time_s,state,x_m,y_m,z_m,qw,qx,qy,qz,rms_px,tag_ids\n";
  check();
}

PosesCsv::~PosesCsv() {
  if (finished_) return;
  out_.close();
  std::error_code ignored;
  std::filesystem::remove(beside_, ignored);
}

void PosesCsv::add(std::int64_t frame, double time_s, const ar::Track& track) {
  out_ << fmt::format("{},{:.6f},{},", frame, time_s, ar::to_string(track.state));
  if (track.state == ar::TrackState::Lost) {
    out_ << ",,,,,,,,";
  } else {
    const cv::Vec3d& x = track.world_from_camera.translation;
    const cv::Vec4d q = ar::quaternion_wxyz(track.world_from_camera.rotation);
    out_ << fmt::format("{:.6f},{:.6f},{:.6f},{:.9f},{:.9f},{:.9f},{:.9f},", x[0], x[1], x[2], q[0], q[1], q[2], q[3]);
    if (track.state == ar::TrackState::Tracking) out_ << fmt::format("{:.4f}", track.rms_px);
    out_ << fmt::format(",{}", fmt::join(track.tag_ids, ";"));
  }
  out_ << '\n';
  check();
}

void PosesCsv::finish() {
  out_.close();
  check();
  render::rename_whole(beside_, path_, overwrite_ ? render::Existing::Replace : render::Existing::Keep);
  finished_ = true;
}

void PosesCsv::check() const {
  if (!out_) {
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno)));
  }
}

}  // namespace app
