#include "calib/tagmap/tag_mapper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "ar/track/corner_bias.h"
#include "ar/track/lens.h"
#include "ar/track/solve.h"
#include "calib/tagmap/tag_bundle.h"
#include "calib/tagmap/tag_chain.h"
#include "render/base/median.h"

namespace calib {
namespace {

constexpr double kRobustPx = 1.0;

// All tags and cameras at those poses; `ids` receives the tags', the origin's first.
TagBundle make_bundle(const ar::CameraModel& camera, const TagObservations& observations,
                      const std::map<int, ar::Rigid3>& poses, int origin, std::vector<int>& ids) {
  const ar::Lens lens(camera);
  TagBundle bundle;
  bundle.lens = camera;
  ids = {origin};
  for (const auto& [id, pose] : poses) {
    if (id != origin) ids.push_back(id);
  }
  std::map<int, std::size_t> index_of;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    index_of[ids[i]] = i;
    bundle.tag_size_m.push_back(observations.size_of(ids[i]));
    bundle.map_from_tag.push_back(poses.at(ids[i]));
  }
  const ar::TagMap map = observations.map_of(poses);
  for (const auto& picture : observations.pictures()) {
    auto tags = ar::seen_tags(lens, map, picture);
    if (tags.empty()) continue;
    const auto fits = ar::solve_pose(lens, tags, std::nullopt);
    if (fits.empty()) continue;
    for (const ar::SeenTag& tag : tags) {
      bundle.observations.push_back({bundle.map_from_camera.size(), index_of.at(tag.id), tag.measured_px, true});
    }
    bundle.map_from_camera.push_back(fits.front().world_from_camera);
  }
  return bundle;
}

// `px` of the observations from the measured corners, for the poses as they now are.
void straighten(TagBundle& bundle) {
  const ar::Lens lens(bundle.lens);
  if (!lens.bends_lines()) return;
  for (TagObservation& seen : bundle.observations) {
    ar::SeenTag tag;
    tag.measured_px = seen.px;
    const auto in_tag = ar::corners_in_tag(bundle.tag_size_m[seen.tag]);
    for (std::size_t i = 0; i < 4; ++i) tag.corners_in_world[i] = bundle.map_from_tag[seen.tag] * in_tag[i];
    tag.corners_px = seen.px;
    ar::straighten(lens, bundle.map_from_camera[seen.camera], tag);
    seen.px = tag.corners_px;
  }
}

// Leaves out tags in pictures that are far off: more than a pixel and four times the usual.
bool choose_used(TagBundle& bundle) {
  const ar::Lens lens(bundle.lens);
  std::vector<double> rms;
  for (const TagObservation& seen : bundle.observations) rms.push_back(observation_rms_px(lens, bundle, seen));
  const double limit = std::max(1.0, 4.0 * render::upper_median(rms));
  bool changed = false;
  for (std::size_t i = 0; i < rms.size(); ++i) {
    changed = changed || bundle.observations[i].used != (rms[i] <= limit);
    bundle.observations[i].used = rms[i] <= limit;
  }
  return changed;
}

void describe(const TagBundle& bundle, const std::vector<int>& ids, MapResult& out) {
  const ar::Lens lens(bundle.lens);
  double sum = 0.0;
  std::vector<double> tag_sum(ids.size(), 0.0);
  std::set<std::size_t> cameras;
  for (const TagObservation& seen : bundle.observations) {
    if (!seen.used) {
      ++out.observations_rejected;
      continue;
    }
    const double rms = observation_rms_px(lens, bundle, seen);
    sum += 4.0 * rms * rms;
    tag_sum[seen.tag] += rms * rms;
    out.worst_px = std::max(out.worst_px, rms);
    out.corners_used += 4;
    ++out.notes[ids[seen.tag]].pictures;
    cameras.insert(seen.camera);
  }
  out.pictures_used = static_cast<int>(cameras.size());
  out.rms_px = out.corners_used > 0 ? std::sqrt(sum / out.corners_used) : 0.0;
  const double freedom = 2.0 * out.corners_used - 6.0 * (out.pictures_used + static_cast<double>(ids.size()) - 1.0);
  const double variance = freedom > 0.0 ? sum / freedom : std::numeric_limits<double>::infinity();
  const auto covariances = tag_covariances(bundle);
  for (std::size_t t = 0; t < ids.size(); ++t) {
    MappedTagNote& note = out.notes[ids[t]];
    note.rms_px = note.pictures > 0 ? std::sqrt(tag_sum[t] / note.pictures) : 0.0;
    if (t == 0) continue;
    const cv::Matx66d& c = covariances[t];
    note.sigma_turn_rad = std::sqrt(variance * (c(0, 0) + c(1, 1) + c(2, 2)));
    note.sigma_position_m = std::sqrt(variance * (c(3, 3) + c(4, 4) + c(5, 5)));
  }
}

}  // namespace

MapResult map_tags(const ar::CameraModel& camera, const std::string& family, const std::vector<TagPicture>& pictures,
                   const MapperOptions& options) {
  const TagObservations observations(camera, family, pictures, options);
  MapResult out;
  out.origin = observations.origin();
  std::vector<int> group;
  for (std::vector<int>& ids : observations.groups()) {
    const bool ours = std::find(ids.begin(), ids.end(), out.origin) != ids.end();
    if (ours) {
      group = std::move(ids);
    } else {
      out.other_groups.push_back(std::move(ids));
    }
  }
  std::vector<int> ids;
  TagBundle bundle = make_bundle(camera, observations, observations.chained(out.origin, group), out.origin, ids);
  // Wrong starts of single pictures must not bend the map: from far to near.
  bool fine = minimise(bundle, 10.0 * kRobustPx) && minimise(bundle, kRobustPx);
  std::map<int, ar::Rigid3> poses;
  for (std::size_t i = 0; i < ids.size(); ++i) poses[ids[i]] = bundle.map_from_tag[i];
  bundle = make_bundle(camera, observations, poses, out.origin, ids);  // each camera's pose anew from all its tags
  straighten(bundle);
  fine = fine && minimise(bundle, kRobustPx);
  for (int round = 0; fine && round < 4; ++round) {
    const bool changed = choose_used(bundle);
    if (round > 0 && !changed) break;
    fine = minimise(bundle, 0.0);
  }
  if (!fine) throw std::runtime_error("the tags' places do not come out\nis the camera file that of the recording?");
  for (std::size_t i = 0; i < ids.size(); ++i) poses[ids[i]] = bundle.map_from_tag[i];
  out.map = observations.map_of(poses);
  describe(bundle, ids, out);
  return out;
}

}  // namespace calib
