#include "calib/tag_mapper.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

#include "ar/track/bent_edges.h"
#include "ar/track/lens.h"
#include "ar/track/solve.h"
#include "calib/tag_bundle.h"

namespace calib {
namespace {

constexpr std::size_t kPairPictures = 8;  // of a pair of tags, that decide how they stand to each other
constexpr double kRobustPx = 1.0;

class Mapper {
 public:
  Mapper(const ar::CameraModel& camera, const std::string& family, const std::vector<TagPicture>& pictures,
         const MapperOptions& options)
      : camera_(camera), lens_(camera), family_(family), options_(options) {
    for (const TagPicture& picture : pictures) {
      std::map<int, int> times;
      for (const ar::Detection& d : picture.detections) times[d.id] += d.family == family ? 1 : 0;
      std::vector<ar::Detection> once;
      for (const ar::Detection& d : picture.detections) {
        if (d.family == family && times[d.id] == 1) once.push_back(d);
      }
      if (!once.empty()) pictures_.push_back(std::move(once));
    }
    for (std::size_t p = 0; p < pictures_.size(); ++p) {
      for (const ar::Detection& d : pictures_[p]) pictures_of_[d.id].push_back(p);
    }
  }

  MapResult run();

 private:
  double size_of(int id) const {
    const auto own = options_.own_sizes_m.find(id);
    return own != options_.own_sizes_m.end() ? own->second : options_.tag_size_m;
  }
  ar::TagMap map_of(const std::map<int, ar::Rigid3>& poses) const;
  int origin() const;
  std::vector<std::vector<int>> groups() const;
  std::vector<std::size_t> shared(int a, int b) const;
  std::optional<ar::Rigid3> pair_pose(int a, int b) const;
  std::map<int, ar::Rigid3> chained(int origin, const std::vector<int>& group) const;
  TagBundle make_bundle(const std::map<int, ar::Rigid3>& poses, int origin, std::vector<int>& ids) const;
  void straighten(TagBundle& bundle, const std::vector<int>& ids) const;
  const ar::Detection& detection(std::size_t picture, int id) const;

  ar::CameraModel camera_;
  ar::Lens lens_;
  std::string family_;
  MapperOptions options_;
  std::vector<std::vector<ar::Detection>> pictures_;
  std::map<int, std::vector<std::size_t>> pictures_of_;
};

ar::TagMap Mapper::map_of(const std::map<int, ar::Rigid3>& poses) const {
  ar::TagMap map;
  map.family = family_;
  for (const auto& [id, pose] : poses) map.tags[id] = {pose, size_of(id)};
  return map;
}

int Mapper::origin() const {
  if (options_.origin) {
    if (pictures_of_.contains(*options_.origin)) return *options_.origin;
    std::vector<int> seen;
    for (const auto& [id, pictures] : pictures_of_) seen.push_back(id);
    throw std::runtime_error(
        fmt::format("tag {} is not in the pictures\nseen: {}", *options_.origin, fmt::join(seen, ", ")));
  }
  const auto fewer = [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); };
  return std::max_element(pictures_of_.begin(), pictures_of_.end(), fewer)->first;
}

// Tags that pictures connect, directly or through others.
std::vector<std::vector<int>> Mapper::groups() const {
  std::map<int, int> group_of;
  for (const auto& [id, pictures] : pictures_of_) group_of[id] = id;
  for (const auto& picture : pictures_) {
    for (const ar::Detection& d : picture) {
      const int from = group_of[d.id];
      const int to = group_of[picture.front().id];
      for (auto& [id, group] : group_of) group = group == from ? to : group;
    }
  }
  std::map<int, std::vector<int>> members;
  for (const auto& [id, group] : group_of) members[group].push_back(id);
  std::vector<std::vector<int>> out;
  for (auto& [group, ids] : members) out.push_back(std::move(ids));
  return out;
}

std::vector<std::size_t> Mapper::shared(int a, int b) const {
  std::vector<std::size_t> both;
  std::set_intersection(pictures_of_.at(a).begin(), pictures_of_.at(a).end(), pictures_of_.at(b).begin(),
                        pictures_of_.at(b).end(), std::back_inserter(both));
  return both;
}

const ar::Detection& Mapper::detection(std::size_t picture, int id) const {
  return *std::find_if(pictures_[picture].begin(), pictures_[picture].end(),
                       [&](const ar::Detection& d) { return d.id == id; });
}

// How b stands to a. Each square alone allows two poses, a pair up to four ways a picture: the way counts that explains
// all pictures of the pair best.
std::optional<ar::Rigid3> Mapper::pair_pose(int a, int b) const {
  std::vector<std::size_t> pictures = shared(a, b);
  if (pictures.size() > kPairPictures) {
    // Those from the most different places: evenly through the recording.
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < kPairPictures; ++i) some.push_back(pictures[i * pictures.size() / kPairPictures]);
    pictures = some;
  }
  std::vector<ar::Rigid3> ways;
  for (std::size_t p : pictures) {
    auto alone = [&](int id) {
      auto tags = ar::seen_tags(lens_, map_of({{id, ar::Rigid3{}}}), {detection(p, id)});
      std::vector<ar::Rigid3> tag_from_camera;
      for (const ar::PoseFit& fit : ar::solve_pose(lens_, tags, std::nullopt)) {
        tag_from_camera.push_back(fit.world_from_camera);
      }
      return tag_from_camera;
    };
    for (const ar::Rigid3& a_from_camera : alone(a)) {
      for (const ar::Rigid3& b_from_camera : alone(b)) ways.push_back(a_from_camera * b_from_camera.inverse());
    }
  }
  std::optional<ar::Rigid3> best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const ar::Rigid3& a_from_b : ways) {
    const ar::TagMap map = map_of({{a, ar::Rigid3{}}, {b, a_from_b}});
    double cost = 0.0;
    for (std::size_t p : pictures) {
      auto tags = ar::seen_tags(lens_, map, {detection(p, a), detection(p, b)});
      const auto fits = ar::solve_pose(lens_, tags, std::nullopt);
      cost += fits.empty() ? 100.0 : std::min(100.0, fits.front().cost);
      if (cost >= best_cost) break;
    }
    if (cost >= best_cost) continue;
    best_cost = cost;
    best = a_from_b;
  }
  return best;
}

// Tag after tag, each from the one already placed that shares most pictures with it.
std::map<int, ar::Rigid3> Mapper::chained(int origin, const std::vector<int>& group) const {
  std::map<int, ar::Rigid3> placed{{origin, ar::Rigid3{}}};
  std::set<std::pair<int, int>> useless;
  while (placed.size() < group.size()) {
    std::size_t most = 0;
    std::pair<int, int> next{0, 0};
    for (const auto& [from, pose] : placed) {
      for (int to : group) {
        if (placed.contains(to) || useless.contains({from, to})) continue;
        const std::size_t count = shared(from, to).size();
        if (count <= most) continue;
        most = count;
        next = {from, to};
      }
    }
    if (most == 0) break;
    const auto from_to = pair_pose(next.first, next.second);
    if (!from_to) {
      useless.insert(next);
      continue;
    }
    placed[next.second] = placed[next.first] * *from_to;
  }
  return placed;
}

TagBundle Mapper::make_bundle(const std::map<int, ar::Rigid3>& poses, int origin, std::vector<int>& ids) const {
  TagBundle bundle;
  bundle.lens = camera_;
  ids = {origin};
  for (const auto& [id, pose] : poses) {
    if (id != origin) ids.push_back(id);
  }
  std::map<int, std::size_t> index_of;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    index_of[ids[i]] = i;
    bundle.tag_size_m.push_back(size_of(ids[i]));
    bundle.map_from_tag.push_back(poses.at(ids[i]));
  }
  const ar::TagMap map = map_of(poses);
  for (const auto& picture : pictures_) {
    auto tags = ar::seen_tags(lens_, map, picture);
    if (tags.empty()) continue;
    const auto fits = ar::solve_pose(lens_, tags, std::nullopt);
    if (fits.empty()) continue;
    for (const ar::SeenTag& tag : tags) {
      bundle.observations.push_back({bundle.map_from_camera.size(), index_of.at(tag.id), tag.measured_px, true});
    }
    bundle.map_from_camera.push_back(fits.front().world_from_camera);
  }
  return bundle;
}

// `px` of the observations from the measured corners, for the poses as they now are.
void Mapper::straighten(TagBundle& bundle, const std::vector<int>& ids) const {
  if (!lens_.bends_lines()) return;
  for (TagObservation& seen : bundle.observations) {
    ar::SeenTag tag;
    tag.id = ids[seen.tag];
    tag.measured_px = seen.px;
    const auto in_tag = ar::corners_in_tag(bundle.tag_size_m[seen.tag]);
    for (std::size_t i = 0; i < 4; ++i) tag.corners_in_world[i] = bundle.map_from_tag[seen.tag] * in_tag[i];
    tag.corners_px = seen.px;
    ar::straighten(lens_, bundle.map_from_camera[seen.camera], tag);
    seen.px = tag.corners_px;
  }
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Leaves out tags in pictures that are far off: more than a pixel and four times the usual.
bool choose_used(TagBundle& bundle) {
  const ar::Lens lens(bundle.lens);
  std::vector<double> rms;
  for (const TagObservation& seen : bundle.observations) rms.push_back(observation_rms_px(lens, bundle, seen));
  const double limit = std::max(1.0, 4.0 * median(rms));
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

MapResult Mapper::run() {
  if (pictures_of_.empty()) {
    throw std::runtime_error(fmt::format("no {} tags in the pictures\nis it the right --family?", family_));
  }
  MapResult out;
  out.origin = origin();
  std::vector<int> group;
  for (std::vector<int>& ids : groups()) {
    const bool ours = std::find(ids.begin(), ids.end(), out.origin) != ids.end();
    if (ours) {
      group = std::move(ids);
    } else {
      out.other_groups.push_back(std::move(ids));
    }
  }
  std::vector<int> ids;
  TagBundle bundle = make_bundle(chained(out.origin, group), out.origin, ids);
  // Wrong starts of single pictures must not bend the map: from far to near.
  bool fine = minimise(bundle, 10.0 * kRobustPx) && minimise(bundle, kRobustPx);
  std::map<int, ar::Rigid3> poses;
  for (std::size_t i = 0; i < ids.size(); ++i) poses[ids[i]] = bundle.map_from_tag[i];
  bundle = make_bundle(poses, out.origin, ids);  // each camera's pose anew from all its tags
  straighten(bundle, ids);
  fine = fine && minimise(bundle, kRobustPx);
  for (int round = 0; fine && round < 4; ++round) {
    const bool changed = choose_used(bundle);
    if (round > 0 && !changed) break;
    fine = minimise(bundle, 0.0);
  }
  if (!fine) throw std::runtime_error("the tags' places do not come out\nis the camera file that of the recording?");
  for (std::size_t i = 0; i < ids.size(); ++i) poses[ids[i]] = bundle.map_from_tag[i];
  out.map = map_of(poses);
  describe(bundle, ids, out);
  return out;
}

}  // namespace

MapResult map_tags(const ar::CameraModel& camera, const std::string& family, const std::vector<TagPicture>& pictures,
                   const MapperOptions& options) {
  return Mapper(camera, family, pictures, options).run();
}

}  // namespace calib
