#include "app/synth/clip.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <stdexcept>

#include "app/synth/film.h"
#include "app/synth/gaze.h"
#include "app/synth/path.h"
#include "app/synth/raycast.h"
#include "app/synth/truth.h"
#include "app/synth/world.h"
#include "ar/output/sink.h"

namespace app::synth {

namespace {

// The recording as a camera would have described it.
ar::SourceInfo describe(const Spec& spec) {
  ar::SourceInfo info;
  info.name = spec.file.string();
  info.format.width = spec.width;
  info.format.height = spec.height;
  info.format.bit_depth = spec.bit_depth;
  info.format.chroma = ar::Chroma::C420;
  info.format.color = {ar::ColorMatrix::Bt709, ar::ColorRange::Limited, ar::Transfer::Bt709, ar::Primaries::Bt709,
                       ar::ChromaSiting::Left};
  info.time_base = {spec.fps_den, spec.fps_num};
  info.frame_rate = {spec.fps_num, spec.fps_den};
  info.frame_count = spec.frames;
  info.duration_s = spec.time_of_frame_s(spec.frames);
  info.recorded.latitude_deg = spec.latitude_deg;
  info.recorded.longitude_deg = spec.longitude_deg;
  info.recorded.height_m = spec.height_m;
  info.recorded.time = spec.time;
  return info;
}

// Where the middle of the first view meets the ground, not further than the scene is detailed.
glm::vec3 focus_of(const ar::Rigid3& pose) {
  const glm::vec3 eye(pose.translation[0], pose.translation[1], pose.translation[2]);
  const glm::vec3 ahead(pose.rotation(0, 2), pose.rotation(1, 2), 0.0F);
  const float length = glm::length(ahead);
  const float reach = 6.5F;  // the detailed ground then begins behind the eye and ends 14 m before it
  glm::vec3 focus = eye + (length > 1e-3F ? ahead / length * reach : glm::vec3(0.0F));
  focus.z = 0.0F;
  return focus;
}

void refuse_existing(const TruthFiles& files) {
  for (const auto& file : {files.poses, files.corners, files.camera, files.scene}) {
    if (std::filesystem::exists(file))
      throw std::runtime_error(fmt::format("{}: exists already\nuse --overwrite to replace it", file.string()));
  }
}

}  // namespace

int write_clip(const Spec& spec, const std::filesystem::path& clip, const ClipOptions& options) {
  const TruthFiles files(clip);
  if (!options.overwrite) refuse_existing(files);
  ar::VideoSinkOptions sink_options;
  sink_options.crf = options.crf;
  sink_options.preset = "veryfast";
  sink_options.overwrite = options.overwrite;
  sink_options.copy_other_streams = false;
  const auto sink = ar::make_file_sink(clip, describe(spec), sink_options);

  const CameraPath path(spec.path, spec.time_of_frame_s(spec.frames - 1), spec.seed);
  const ar::Rigid3 start = path.world_from_camera(0.5 * spec.time_of_frame_s(spec.frames - 1));
  const glm::vec3 eye(start.translation[0], start.translation[1], start.translation[2]);
  const World world(spec, eye, focus_of(start), Gaze(spec, path));
  spdlog::info("sun at azimuth {:.1f}, elevation {:.1f} degrees; exposure {:.4g} per cd/m2",
               glm::degrees(world.light().sun().azimuth_rad), glm::degrees(world.light().sun().elevation_rad),
               world.light().exposure());
  const RayCaster caster(spec, world, path);
  const Film film(spec);
  int done = 0;
  while (done < spec.frames && !(options.stop && options.stop())) {
    ar::OutputFrame picture = sink->allocate();
    film.develop(caster.render(done), done, picture);
    sink->write(std::move(picture), done);
    ++done;
    if (options.progress) options.progress(done, spec.frames);
  }
  sink->finish();
  Spec written = spec;
  written.frames = done;
  write_truth(files, written, path, world.light().exposure());
  return done;
}

}  // namespace app::synth
