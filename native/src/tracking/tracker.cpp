#include "mrpbench_tracking/tracker.hpp"

#include <algorithm>
#include <tuple>

namespace mrpbench::tracking {

namespace {

constexpr double kSpeedDeviation = 1;  // m/s, of what was detected for the first time

}  // namespace

void Track::predict(double dt, double acceleration_deviation) {
  const double noise = acceleration_deviation * acceleration_deviation;
  place = place + velocity * dt;
  pp += dt * (2 * pv + dt * vv) + noise * dt * dt * dt / 3;
  pv += dt * vv + noise * dt * dt / 2;
  vv += noise * dt;
}

void Track::correct(Point detected_at, double deviation) {
  const Point off = detected_at - place;
  const double of_place = pp / (pp + deviation * deviation), of_velocity = pv / (pp + deviation * deviation);
  place = place + off * of_place;
  velocity = velocity + off * of_velocity;
  vv -= of_velocity * pv;
  pv *= 1 - of_place;
  pp *= 1 - of_place;
}

std::vector<std::size_t> Tracker::update(double now, std::span<const Detection> detections, const Options& options) {
  for (Track& it : tracks_) it.predict(now - updated_, options.acceleration_deviation);
  updated_ = now;
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    for (std::size_t d = 0; d < detections.size(); ++d) {
      const double distance = length(tracks_[t].place - detections[d].centre);
      if (distance <= options.gating_distance) pairs.emplace_back(distance, t, d);
    }
  }
  std::ranges::sort(pairs);
  constexpr auto none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> track_of(detections.size(), none);
  std::vector<char> taken(tracks_.size(), 0);
  for (const auto& [_, t, d] : pairs) {
    if (taken[t] || track_of[d] != none) continue;
    taken[t] = 1;
    track_of[d] = t;
    tracks_[t].correct(detections[d].centre, options.measurement_deviation);
    tracks_[t].detected = now;
    ++tracks_[t].detections;
  }
  // What is lost goes, and the others keep their order.
  std::vector<std::size_t> index(tracks_.size(), none);
  std::vector<Track> next;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    if (now - tracks_[t].detected > options.lost_after) continue;
    index[t] = next.size();
    next.push_back(tracks_[t]);
  }
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (track_of[d] != none) {
      track_of[d] = index[track_of[d]];
      continue;
    }
    track_of[d] = next.size();
    const double deviation = options.measurement_deviation;
    next.push_back({detections[d].centre, {}, deviation * deviation, 0, kSpeedDeviation * kSpeedDeviation, 1, now});
  }
  tracks_ = std::move(next);
  return track_of;
}

bool moves(const Track& track, const Options& options) {
  return track.detections >= options.confirmed_after && length(track.velocity) >= options.least_speed;
}

}  // namespace mrpbench::tracking
