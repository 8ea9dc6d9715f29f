#include "ar/track/tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ar/track/motion_filter.h"
#include "ar/track/search_regions.h"
#include "ar/track/solve.h"
#include "render/base/check.h"

namespace ar {
namespace {

// How much smoothing may add to the reprojection error, px: more would be seen as virtual things that swim.
constexpr double kSwimPx = 0.1;
// Log-likelihood by which a farther solution must beat the one close to the expected pose: odds of 160,000 to 1.
constexpr double kFlipEvidence = 12.0;

std::vector<int> ids_of(const std::vector<SeenTag>& tags, const PoseFit& fit) {
  std::vector<int> ids;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (fit.used[i]) ids.push_back(tags[i].id);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

cv::Matx66d covariance_of(const cv::Matx66d& information) {
  bool invertible = false;
  const cv::Matx66d inverse = information.inv(cv::DECOMP_CHOLESKY, &invertible);
  return invertible ? inverse : cv::Matx66d(cv::Matx66d::eye() * 1e6);
}

// The map's own family is always sought.
TrackerOptions with_family(TrackerOptions options, const std::string& family) {
  std::vector<std::string>& families = options.detector.families;
  if (std::find(families.begin(), families.end(), family) == families.end()) families.push_back(family);
  return options;
}

std::size_t closest(const std::vector<PoseFit>& fits, const Rigid3& expected) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < fits.size(); ++i) {
    const auto turn = [&](std::size_t k) {
      return angle_between(fits[k].world_from_camera.rotation, expected.rotation);
    };
    if (turn(i) < turn(best)) best = i;
  }
  return best;
}

// The two poses of a square look alike. The expected pose decides until the pictures together say clearly otherwise:
// `evidence` adds up, over frames, the log-likelihood ratio in favour of the better fit.
std::size_t choose(const std::vector<PoseFit>& fits, const std::optional<Rigid3>& expected, double variance_px2,
                   double& evidence) {
  if (!expected) return 0;
  const std::size_t close = closest(fits, *expected);
  evidence = close == 0 ? 0.0 : evidence + (fits[close].cost - fits[0].cost) / (2.0 * variance_px2);
  if (evidence <= kFlipEvidence) return close;
  evidence = 0.0;
  return 0;
}

}  // namespace

const char* to_string(TrackState state) {
  switch (state) {
    case TrackState::Lost:
      return "lost";
    case TrackState::Predicted:
      return "predicted";
    case TrackState::Tracking:
      return "tracking";
  }
  return "lost";
}

std::optional<PoseEstimate> estimate_pose(const CameraModel& camera, const TagMap& map,
                                          const std::vector<Detection>& detections,
                                          const std::optional<Rigid3>& near_world_from_camera) {
  const Lens lens(camera);
  std::vector<SeenTag> tags = seen_tags(lens, map, detections);
  const std::vector<PoseFit> fits = solve_pose(lens, tags, near_world_from_camera);
  if (fits.empty()) return std::nullopt;
  double evidence = 0.0;
  const double variance = corner_variance_px2(fits[0].sum_squares_px2, fits[0].used_corners());
  const std::size_t chosen = choose(fits, near_world_from_camera, variance, evidence);
  const PoseFit& fit = fits[chosen];
  PoseEstimate estimate;
  estimate.world_from_camera = fit.world_from_camera;
  estimate.covariance =
      covariance_of(fit.information * (1.0 / corner_variance_px2(fit.sum_squares_px2, fit.used_corners())));
  estimate.rms_px = fit.rms_px();
  if (fits.size() > 1) estimate.second_best_rms_px = fits[chosen == 0 ? 1 : 0].rms_px();
  estimate.tag_ids = ids_of(tags, fit);
  return estimate;
}

struct Tracker::Impl {
  CameraModel camera;
  Lens lens;
  TagMap map;
  TrackerOptions options;
  Detector detector;
  MotionFilter filter;
  std::vector<Detection> detections;

  bool following = false;  // the filter holds a pose that may be carried on
  double filter_time_s = 0.0;
  double seen_time_s = 0.0;
  int since_full_search = 0;
  double flip_evidence = 0.0;
  double noise_squares_px2 = 0.0;  // recent residuals and their degrees of freedom, older ones fading
  double noise_freedom = 0.0;

  Impl(CameraModel c, TagMap m, TrackerOptions o)
      : camera(std::move(c)),
        lens(camera),
        map(std::move(m)),
        options(with_family(std::move(o), map.family)),
        detector(options.detector) {}

  void advance(double time_s);
  std::vector<SeenTag> search(const Frame& frame);
  void learn_noise(const PoseFit& fit);
  double corner_sigma_px() const;
  PoseFit smoothed(std::vector<SeenTag>& tags, const PoseFit& free);
  Track without_tags(double time_s);
  Track with_tags(std::vector<SeenTag>& tags);
  Track follow(std::vector<SeenTag> tags, double time_s);
};

Tracker::Tracker(CameraModel camera, TagMap map, TrackerOptions options)
    : impl_(std::make_unique<Impl>(std::move(camera), std::move(map), std::move(options))) {
  CHECK(impl_->options.predict_for_s >= 0.0);
  CHECK(impl_->options.full_search_every >= 1);
}

Tracker::~Tracker() = default;

const std::vector<Detection>& Tracker::detections() const {
  return impl_->detections;
}

// A step back in time or a gap longer than a pose is carried on breaks the motion: begin anew.
void Tracker::Impl::advance(double time_s) {
  const double dt = time_s - filter_time_s;
  filter_time_s = time_s;
  if (!following) return;
  if (dt < 0.0 || time_s - seen_time_s > options.predict_for_s + 1e-9) {
    following = false;
  } else {
    filter.predict(dt);
  }
}

// Decimation costs no accuracy, because edges are refined in the full picture, but small tags are not found: 30 px a
// side must remain of them.
std::vector<SeenTag> Tracker::Impl::search(const Frame& frame) {
  const double asked = options.detector.quad_decimate;
  ++since_full_search;
  if (following) {
    const cv::Size picture(frame.format.width, frame.format.height);
    const SearchRegions regions =
        search_regions(lens, picture, map, filter.world_from_camera(), filter.pose_covariance());
    const bool whole = regions.boxes.empty() || since_full_search >= options.full_search_every;
    detector.set_decimate(std::max(asked, std::floor(std::clamp(regions.smallest_side_px / 30.0, 1.0, 3.0))));
    detections = whole ? detector.detect(frame) : detector.detect(frame, regions.boxes);
    if (whole) since_full_search = 0;
    std::vector<SeenTag> tags = seen_tags(lens, map, detections);
    if (!tags.empty()) return tags;
  }
  since_full_search = 0;
  detector.set_decimate(asked);
  detections = detector.detect(frame);
  return seen_tags(lens, map, detections);
}

void Tracker::Impl::learn_noise(const PoseFit& fit) {
  constexpr double kKeep = 0.95;  // some twenty frames
  noise_squares_px2 = kKeep * noise_squares_px2 + fit.sum_squares_px2;
  noise_freedom = kKeep * noise_freedom + std::max(0, 2 * fit.used_corners() - 6);
}

double Tracker::Impl::corner_sigma_px() const {
  constexpr double kUsual = 0.1 * 0.1;  // as in corner_variance_px2()
  constexpr double kWeight = 6.0;
  return std::sqrt((kWeight * kUsual + noise_squares_px2) / (kWeight + noise_freedom));
}

// Most probable pose given corners and motion together (an iterated Kalman update on the pixels themselves), so that
// what the corners say clearly is followed at once and what they hardly say is taken from the motion. Where that costs
// more than kSwimPx, the motion is believed less until it does not.
PoseFit Tracker::Impl::smoothed(std::vector<SeenTag>& tags, const PoseFit& free) {
  const double sigma = corner_sigma_px();
  filter.adapt(free.world_from_camera, covariance_of(free.information * (1.0 / (sigma * sigma))));
  constexpr int kAttempts = 12;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const PosePrior prior{filter.world_from_camera(), covariance_of(filter.pose_covariance()), sigma};
    const auto fit = fit_pose(lens, tags, free.world_from_camera, prior);
    if (fit && fit->used == free.used && fit->rms_px() <= free.rms_px() + kSwimPx) {
      const cv::Matx66d information = fit->information * (1.0 / (sigma * sigma)) + prior.information;
      filter.correct(fit->world_from_camera, covariance_of(information));
      return *fit;
    }
    filter.inflate(3.0);
  }
  filter.reset(free.world_from_camera, covariance_of(free.information * (1.0 / (sigma * sigma))));
  return free;
}

Track Tracker::Impl::without_tags(double time_s) {
  Track track;
  if (following && time_s - seen_time_s <= options.predict_for_s + 1e-9) {
    track.state = TrackState::Predicted;
    track.world_from_camera = filter.world_from_camera();
    track.covariance = filter.pose_covariance();
  } else {
    following = false;
  }
  return track;
}

Track Tracker::Impl::with_tags(std::vector<SeenTag>& tags) {
  Track track;
  const auto expected = following ? std::optional(filter.world_from_camera()) : std::nullopt;
  const std::vector<PoseFit> fits = solve_pose(lens, tags, expected);
  if (fits.empty()) return track;
  const double sigma = corner_sigma_px();
  const PoseFit& free = fits[choose(fits, expected, sigma * sigma, flip_evidence)];
  learn_noise(free);
  const cv::Matx66d free_covariance = covariance_of(free.information * (1.0 / (sigma * sigma)));
  PoseFit filtered = free;
  if (following) {
    filtered = smoothed(tags, free);
  } else {
    filter.reset(free.world_from_camera, free_covariance);
  }
  const PoseFit& given = options.smooth ? filtered : free;
  track.state = TrackState::Tracking;
  track.world_from_camera = given.world_from_camera;
  track.covariance = options.smooth ? filter.pose_covariance() : free_covariance;
  track.rms_px = given.rms_px();
  track.tag_ids = ids_of(tags, given);
  return track;
}

Track Tracker::Impl::follow(std::vector<SeenTag> tags, double time_s) {
  Track track = tags.empty() ? Track{} : with_tags(tags);
  if (track.state != TrackState::Tracking) return without_tags(time_s);
  following = true;
  seen_time_s = time_s;
  return track;
}

Track Tracker::track(const Frame& frame) {
  CHECK(frame.format.width == impl_->camera.width);
  CHECK(frame.format.height == impl_->camera.height);
  impl_->advance(frame.time_s);
  return impl_->follow(impl_->search(frame), frame.time_s);
}

Track Tracker::track(std::vector<Detection> detections, double time_s) {
  impl_->advance(time_s);
  impl_->detections = std::move(detections);
  return impl_->follow(seen_tags(impl_->lens, impl_->map, impl_->detections), time_s);
}

}  // namespace ar
