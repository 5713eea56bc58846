#include "mrpbench_slam/mapper.hpp"

namespace mrpbench::slam {

namespace {

/// Returns that a scan must have to be matched.
constexpr std::size_t kFewest = 10;
/// Deviations of odometry between two scans, metres and radians, for the graph alone.
constexpr double kOdometryPlace = 0.02, kOdometryTurn = 0.04;
/// A loop is searched for within this distance, and this share of the way since the earlier submap.
constexpr double kSearch = 0.25, kDrift = 0.01;
/// Scans that a loop moves: what was built before the last ones stays, so that the time of a loop has a bound.
constexpr std::size_t kMoving = 400;
/// Scans after a closed loop before the next search.
constexpr std::size_t kPause = 3;
/// Deviations from which on the error of a loop counts linearly.
constexpr double kHuber = 10;
/// What the mean response must gain for a match at the edge of the window of a loop.
constexpr double kEdge = 0.3;
/// Least share of the returns that lie where an earlier submap has seen something: the other side of a rack fits
/// anywhere.
constexpr double kOverlap = 0.7;
/// Least share of what is known across the surfaces of a scan that must be known along them for a loop to close: in an
/// aisle without features a scan fits anywhere.
constexpr double kLeastAlong = 0.1;

double squared(Point a) {
  return dot(a, a);
}

Point place(Pose pose) {
  return {pose.x, pose.y};
}

/// The ratio of the least to the greatest information about a direction of the plane, where the yaw is unknown.
double known_along(const Information& it) {
  if (!(it[8] > 0)) return 0;
  const double xx = it[0] - it[2] * it[2] / it[8], xy = it[1] - it[2] * it[5] / it[8],
               yy = it[4] - it[5] * it[5] / it[8];
  const double mean = (xx + yy) / 2, apart = std::hypot((xx - yy) / 2, xy);
  return mean > 0 ? (mean - apart) / (mean + apart) : 0;
}

}  // namespace

Mapper::Mapper(Pose start, const Parameters& parameters)
    : parameters_(parameters),
      map_(parameters.resolution, parameters.min_pass_through, parameters.occupancy_threshold),
      corrected_(start) {}

bool Mapper::wants(double now, Pose odometry) const {
  if (scans_.empty()) return true;
  if (now - time_ < parameters_.minimum_time_interval) return false;
  const Pose step = relative(odometry_, odometry);
  return std::hypot(step.x, step.y) >= parameters_.minimum_travel_distance ||
         std::abs(step.yaw) >= parameters_.minimum_travel_heading;
}

void Mapper::take(double now, Pose odometry, Scan scan) {
  const Pose step = relative(odometry_, odometry);
  const bool first = scans_.empty();
  Pose local = first ? composed(corrected_, step) : composed(local_.back(), step);
  Information seen{};
  if (!first && parameters_.use_scan_matching && scan.returns.size() >= kFewest) {
    local = matched(scan, local).pose;
    seen = information_of(active_.front().submap.field(), scan, local);
  }
  driven_.push_back(first ? 0.0 : driven_.back() + std::hypot(step.x, step.y));
  connect(local, seen);
  insert(scan, local);
  scans_.push_back(std::move(scan));
  odometry_ = odometry;
  time_ = now;
  if (parameters_.use_scan_matching && parameters_.do_loop_closing) close_loop();
  corrected_ = poses_.back();
}

Match Mapper::matched(const Scan& scan, Pose predicted) {
  const Field& field = active_.front().submap.field();
  const Keeping keeping{parameters_.translation_weight, parameters_.rotation_weight};
  const Window window{parameters_.correlation_search_space_dimension / 2, parameters_.coarse_search_angle_offset,
                      parameters_.coarse_angle_resolution};
  const Match coarse = search_.best(field, scan, predicted, window, keeping);
  return refined(field, scan, coarse.pose, predicted, keeping);
}

/// Add a scan to the node of the graph, and bind it to the one before.
void Mapper::connect(Pose local, const Information& seen) {
  if (poses_.empty()) {
    local_.push_back(local);
    poses_.push_back(local);
    return;
  }
  const std::size_t last = poses_.size() - 1;
  const Pose step = relative(local_[last], local);
  Information information = seen;
  information[0] += 1 / (kOdometryPlace * kOdometryPlace);
  information[4] += 1 / (kOdometryPlace * kOdometryPlace);
  information[8] += 1 / (kOdometryTurn * kOdometryTurn);
  constraints_.push_back({last, last + 1, step, information, 0});
  local_.push_back(local);
  poses_.push_back(composed(poses_[last], step));
}

/// Add a scan to both submaps; the older one is finished when the newer one can replace it.
void Mapper::insert(const Scan& scan, Pose pose) {
  const std::size_t index = local_.size() - 1;
  const double resolution = parameters_.resolution, deviation = parameters_.correlation_search_space_smear_deviation;
  if (active_.empty() || active_.back().submap.scans() >= parameters_.submap_scans) {
    active_.push_back({Submap(resolution, deviation), index});
  }
  if (active_.size() > 2) {
    Active& oldest = active_.front();
    earlier_.push_back({std::move(oldest.submap), oldest.first, index - 1, {}});
    active_.erase(active_.begin());
  }
  for (Active& it : active_) it.submap.insert(scan, pose);
}

/// The earlier submap with a scan nearest to the last pose, if one is near enough.
const Mapper::Earlier* Mapper::nearest_earlier() const {
  const std::size_t last = poses_.size() - 1;
  const auto chain = static_cast<std::size_t>(parameters_.loop_match_minimum_chain_size);
  double nearest = parameters_.loop_search_maximum_distance * parameters_.loop_search_maximum_distance;
  const Earlier* found = nullptr;
  for (const Earlier& it : earlier_) {
    if (it.last + chain > last) continue;
    for (std::size_t index = it.first; index <= it.last; ++index) {
      const double distance = squared(place(poses_[index]) - place(poses_[last]));
      if (distance >= nearest) continue;
      nearest = distance;
      found = &it;
    }
  }
  return found;
}

void Mapper::close_loop() {
  const std::size_t last = poses_.size() - 1;
  if (last_loop_ > 0 && last - last_loop_ <= kPause) return;
  const Scan& scan = scans_.back();
  const Earlier* found = nearest_earlier();
  if (found == nullptr || scan.returns.size() < kFewest) return;
  Earlier& earlier = earlier_[static_cast<std::size_t>(found - earlier_.data())];
  const Pose predicted = relative(frame_of(earlier.first), poses_[last]);
  if (earlier.submap.overlap(scan, predicted) < kOverlap) return;
  const double most = parameters_.loop_search_space_dimension / 2;
  if (!earlier.search) {
    earlier.search.emplace(earlier.submap.field_of(parameters_.loop_search_space_smear_deviation), most);
  }
  const Window window{std::min(most, kSearch + kDrift * (driven_[last] - driven_[earlier.last])),
                      parameters_.coarse_search_angle_offset, parameters_.coarse_angle_resolution};
  const Keeping keeping{std::sqrt(kEdge) / window.half, 0};
  const auto coarse =
      earlier.search->best(scan, predicted, window, keeping, parameters_.loop_match_minimum_response_coarse);
  if (!coarse) return;
  const Match fine = refined(earlier.submap.field(), scan, coarse->pose, predicted, keeping);
  const double response = response_of(earlier.search->field(), scan, fine.pose);
  if (response < parameters_.loop_match_minimum_response_fine) return;
  const Information information = information_of(earlier.submap.field(), scan, fine.pose);
  if (known_along(information) < kLeastAlong) return;
  last_loop_ = last;
  const Pose off = relative(predicted, fine.pose);
  if (std::hypot(off.x, off.y) + scan.reach() * std::abs(off.yaw) <= parameters_.resolution) return;  // it is closed
  constraints_.push_back({earlier.first, last, relative(local_[earlier.first], fine.pose), information, kHuber});
  ++loops_;
  optimise(poses_, constraints_, std::max<std::size_t>(1, poses_.size() - std::min(poses_.size(), kMoving)));
}

std::vector<Tile> Mapper::changed_tiles() {
  for (std::size_t index = 0; index < scans_.size(); ++index) map_.insert(index, scans_[index], poses_[index]);
  return map_.changed();
}

}  // namespace mrpbench::slam
