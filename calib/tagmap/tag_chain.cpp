#include "calib/tagmap/tag_chain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

#include "ar/track/solve.h"

namespace calib {
namespace {

constexpr std::size_t kPairPictures = 8;  // of a pair of tags, that decide how they stand to each other

}  // namespace

TagObservations::TagObservations(const ar::CameraModel& camera, const std::string& family,
                                 const std::vector<TagPicture>& pictures, const MapperOptions& options)
    : lens_(camera), family_(family), options_(options) {
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

double TagObservations::size_of(int id) const {
  const auto own = options_.own_sizes_m.find(id);
  return own != options_.own_sizes_m.end() ? own->second : options_.tag_size_m;
}

ar::TagMap TagObservations::map_of(const std::map<int, ar::Rigid3>& poses) const {
  ar::TagMap map;
  map.family = family_;
  for (const auto& [id, pose] : poses) map.tags[id] = {pose, size_of(id)};
  return map;
}

int TagObservations::origin() const {
  if (pictures_of_.empty()) {
    throw std::runtime_error(fmt::format("no {} tags in the pictures\nis it the right --family?", family_));
  }
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

std::vector<std::vector<int>> TagObservations::groups() const {
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

std::vector<std::size_t> TagObservations::shared(int a, int b) const {
  std::vector<std::size_t> both;
  std::set_intersection(pictures_of_.at(a).begin(), pictures_of_.at(a).end(), pictures_of_.at(b).begin(),
                        pictures_of_.at(b).end(), std::back_inserter(both));
  return both;
}

const ar::Detection& TagObservations::detection(std::size_t picture, int id) const {
  return *std::find_if(pictures_[picture].begin(), pictures_[picture].end(),
                       [&](const ar::Detection& d) { return d.id == id; });
}

// Each square alone allows two poses, a pair up to four ways a picture.
std::vector<ar::Rigid3> TagObservations::ways_between(int a, int b, const std::vector<std::size_t>& pictures) const {
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
  return ways;
}

// How b stands to a: the way counts that explains all pictures of the pair best.
std::optional<ar::Rigid3> TagObservations::pair_pose(int a, int b) const {
  std::vector<std::size_t> pictures = shared(a, b);
  if (pictures.size() > kPairPictures) {
    // Those from the most different places: evenly through the recording.
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < kPairPictures; ++i) some.push_back(pictures[i * pictures.size() / kPairPictures]);
    pictures = some;
  }
  std::optional<ar::Rigid3> best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const ar::Rigid3& a_from_b : ways_between(a, b, pictures)) {
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

std::map<int, ar::Rigid3> TagObservations::chained(int origin, const std::vector<int>& group) const {
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

}  // namespace calib
