#include "app/synth/truth.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <fstream>
#include <numbers>
#include <stdexcept>

#include "ar/place/place.h"
#include "calib/files/camera_file.h"

namespace app::synth {

namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

std::ofstream create(const std::filesystem::path& file) {
  std::ofstream out(file);
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
  return out;
}

void close(std::ofstream& out, const std::filesystem::path& file) {
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{}: could not be written whole; is the disk full?", file.string()));
}

void write_poses(const std::filesystem::path& file, const Spec& spec, const CameraPath& path) {
  std::ofstream out = create(file);
  out << "frame,time_s,state,x_m,y_m,z_m,qw,qx,qy,qz,rms_px,tag_ids\n";
  for (int frame = 0; frame < spec.frames; ++frame) {
    const ar::Rigid3 pose = path.world_from_camera(spec.time_of_frame_s(frame));
    const cv::Vec3d& p = pose.translation;
    const cv::Vec4d q = ar::quaternion_wxyz(pose.rotation);
    std::vector<int> ids;
    for (const TrueTag& tag : true_tags(spec, pose)) {
      if (tag.whole) ids.push_back(tag.id);
    }
    fmt::print(out, "{},{:.9f},truth,{:.9f},{:.9f},{:.9f},{:.12f},{:.12f},{:.12f},{:.12f},0,{}\n", frame,
               spec.time_of_frame_s(frame), p[0], p[1], p[2], q[0], q[1], q[2], q[3], fmt::join(ids, " "));
  }
  close(out, file);
}

void write_corners(const std::filesystem::path& file, const Spec& spec, const CameraPath& path) {
  std::ofstream out = create(file);
  out << "frame,family,id,whole,x0_px,y0_px,x1_px,y1_px,x2_px,y2_px,x3_px,y3_px\n";
  for (int frame = 0; frame < spec.frames; ++frame) {
    for (const TrueTag& tag : true_tags(spec, path.world_from_camera(spec.time_of_frame_s(frame)))) {
      fmt::print(out, "{},{},{},{}", frame, spec.tags.family, tag.id, tag.whole ? 1 : 0);
      for (const cv::Point2d& corner : tag.corners_px) fmt::print(out, ",{:.5f},{:.5f}", corner.x, corner.y);
      out << '\n';
    }
  }
  close(out, file);
}

std::string vector_text(const glm::dvec3& v) {
  return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x, v.y, v.z);
}

// What `skyshaft process` needs to know of the clip: all that was known when it was made, and its real things.
void write_scene(const std::filesystem::path& file, const Spec& spec, double exposure) {
  std::ofstream out = create(file);
  fmt::print(
      out,
      "# The real world of the clip beside this file, as it was made. Add `medium:` and `objects:`.\nskyshaft: 1\n");
  fmt::print(out, "place: {{ latitude: {:.9g}, longitude: {:.9g}, height: {:.9g} }}\n", spec.latitude_deg,
             spec.longitude_deg, spec.height_m);
  fmt::print(out, "time: {}\nexposure: {{ white_luminance: {:.9g} }}\n", ar::format_time(spec.time), 1.0 / exposure);
  fmt::print(out, "sky: {{ model: {}, turbidity: {:.9g} }}\n", spec.sky_model, spec.turbidity);
  fmt::print(out, "tags:\n  family: {}\n  map:\n", spec.tags.family);
  for (const auto& [id, tag] : spec.tags.tags) {
    const cv::Vec4d q = ar::quaternion_wxyz(tag.world_from_tag.rotation);
    const cv::Vec3d& p = tag.world_from_tag.translation;
    fmt::print(out,
               "    - {{ id: {}, size: {:.9g}, position: {}, orientation: [{:.12f}, {:.12f}, {:.12f}, {:.12f}] }}\n",
               id, tag.size_m, vector_text({p[0], p[1], p[2]}), q[0], q[1], q[2], q[3]);
  }
  out << "real:\n  - { plane: ground }\n";
  for (const BoxSpec& box : spec.boxes) {
    fmt::print(out, "  - {{ box: {{ size: {}, position: {}, heading_deg: {:.9g} }} }}\n", vector_text(box.size),
               vector_text(box.position), box.heading_rad * kDegreesPerRadian);
  }
  close(out, file);
}

}  // namespace

std::vector<TrueTag> true_tags(const Spec& spec, const ar::Rigid3& world_from_camera) {
  const ar::Rigid3 camera_from_world = world_from_camera.inverse();
  std::vector<TrueTag> found;
  for (const auto& [id, mapped] : spec.tags.tags) {
    std::vector<cv::Point3d> in_camera;
    bool before = true;
    for (const cv::Vec3d& corner : ar::corners_in_tag(mapped.size_m)) {
      const cv::Vec3d p = camera_from_world * (mapped.world_from_tag * corner);
      before = before && p[2] > 1e-3;
      in_camera.emplace_back(p[0], p[1], p[2]);
    }
    if (!before) continue;
    TrueTag tag;
    tag.id = id;
    const auto pixels = ar::project(spec.camera, in_camera);
    const ar::Rigid3 camera_from_tag = camera_from_world * mapped.world_from_tag;
    const cv::Vec3d normal(camera_from_tag.rotation(0, 2), camera_from_tag.rotation(1, 2),
                           camera_from_tag.rotation(2, 2));
    tag.whole = normal.dot(camera_from_tag.translation) > 0.0;  // z points into the tag
    for (std::size_t i = 0; i < 4; ++i) {
      tag.corners_px[i] = pixels[i];
      tag.whole = tag.whole && pixels[i].x >= -0.5 && pixels[i].y >= -0.5 && pixels[i].x <= spec.width - 0.5 &&
                  pixels[i].y <= spec.height - 0.5;
    }
    found.push_back(tag);
  }
  return found;
}

TruthFiles::TruthFiles(const std::filesystem::path& clip) {
  const auto beside = [&](const char* ending) {
    std::filesystem::path file = clip;
    return file.replace_extension(ending);
  };
  poses = beside(".truth.csv");
  corners = beside(".corners.csv");
  camera = beside(".camera.yaml");
  scene = beside(".scene.yaml");
}

void write_truth(const TruthFiles& files, const Spec& spec, const CameraPath& path, double exposure) {
  write_poses(files.poses, spec, path);
  write_corners(files.corners, spec, path);
  calib::write_camera_file(files.camera, spec.camera);
  write_scene(files.scene, spec, exposure);
}

}  // namespace app::synth
