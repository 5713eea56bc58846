#include "mrpbench_amcl/likelihood_field.hpp"

#include <algorithm>
#include <stdexcept>

#include "mrpbench_sim/segment_buckets.hpp"

namespace mrpbench::amcl {

namespace {

constexpr double kMostCells = 2e8;

}  // namespace

Ends ends_of(std::span<const double> ranges, double range, double min_range, Point mount,
             const Parameters& parameters) {
  Ends ends;
  ends.anywhere = parameters.z_rand / range;
  const std::size_t beams = ranges.size();
  const std::size_t used = std::min(beams, static_cast<std::size_t>(parameters.max_beams));
  for (std::size_t i = 0; i < used; ++i) {
    const std::size_t beam = i * beams / used;
    const double distance = ranges[beam];
    if (!(distance >= min_range && distance < range)) continue;
    const double angle = static_cast<double>(beam) * (2 * std::numbers::pi / static_cast<double>(beams));
    ends.points.push_back(mount + Point{std::cos(angle), std::sin(angle)} * distance);
  }
  return ends;
}

LikelihoodField::LikelihoodField(const std::vector<sim::Segment>& segments, double resolution,
                                 const Parameters& parameters)
    : independent_(parameters.independent_beams), per_metre_(1 / resolution), resolution_(resolution) {
  const double reach = parameters.laser_likelihood_max_dist, spread = 2 * parameters.sigma_hit * parameters.sigma_hit;
  const auto likelihood = [&](double squared) {
    return static_cast<float>(parameters.z_hit * std::exp(-squared / spread));
  };
  nothing_ = likelihood(reach * reach);
  if (segments.empty()) return;
  Point low = segments[0].start, high = low;
  for (const sim::Segment& it : segments) {
    low = {std::min({low.x, it.start.x, it.end.x}), std::min({low.y, it.start.y, it.end.y})};
    high = {std::max({high.x, it.start.x, it.end.x}), std::max({high.y, it.start.y, it.end.y})};
  }
  origin_ = low - Point{reach, reach};
  const Point size = (high - low + Point{2 * reach, 2 * reach}) * per_metre_;
  if (!(std::ceil(size.x) * std::ceil(size.y) <= kMostCells)) {
    throw std::invalid_argument("the map has too many cells: choose a coarser resolution");
  }
  columns_ = static_cast<std::size_t>(std::ceil(size.x));
  rows_ = static_cast<std::size_t>(std::ceil(size.y));
  hit_.assign(columns_ * rows_, nothing_);
  const sim::SegmentBuckets buckets(segments, reach, std::max(0.5, reach / 4));
  for (std::size_t row = 0; row < rows_; ++row) {
    for (std::size_t column = 0; column < columns_; ++column) {
      const Point centre =
          origin_ + Point{static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5} * resolution_;
      double nearest = reach * reach;
      for (const std::int32_t index : buckets.near(centre)) {
        const Point gap = sim::gap(segments[static_cast<std::size_t>(index)], centre);
        nearest = std::min(nearest, dot(gap, gap));
      }
      if (nearest < reach * reach) hit_[row * columns_ + column] = likelihood(nearest);
    }
  }
}

double LikelihoodField::hit(Point point) const {
  const double x = (point.x - origin_.x) * per_metre_, y = (point.y - origin_.y) * per_metre_;
  if (!(x >= 0 && y >= 0 && x < static_cast<double>(columns_) && y < static_cast<double>(rows_))) return nothing_;
  return hit_[static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x)];
}

template <class Visit>
void LikelihoodField::each(Pose pose, const Ends& ends, Visit&& visit) const {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  for (const Point& end : ends.points) {
    visit(ends.anywhere + hit({pose.x + c * end.x - s * end.y, pose.y + s * end.x + c * end.y}));
  }
}

double LikelihoodField::weigh(std::span<Particle> particles, const Ends& ends) const {
  return independent_ ? multiply(particles, ends) : add_cubes(particles, ends);
}

double LikelihoodField::add_cubes(std::span<Particle> particles, const Ends& ends) const {
  double total = 0;
  for (Particle& it : particles) {
    double likelihood = 1;
    each(it.pose, ends, [&](double one) { likelihood += one * one * one; });
    it.weight *= likelihood;
    total += it.weight;
  }
  return total;
}

double LikelihoodField::multiply(std::span<Particle> particles, const Ends& ends) const {
  std::vector<double> logarithms;
  logarithms.reserve(particles.size());
  for (const Particle& it : particles) {
    double sum = 0, product = 1;  // one logarithm for eight beams keeps the product in range
    std::size_t count = 0;
    each(it.pose, ends, [&](double one) {
      product *= one;
      if (++count % 8 != 0) return;
      sum += std::log(product);
      product = 1;
    });
    logarithms.push_back(sum + std::log(product));
  }
  const double largest = *std::max_element(logarithms.begin(), logarithms.end());
  double total = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles[i].weight *= std::exp(logarithms[i] - largest);
    total += particles[i].weight;
  }
  return total * std::exp(largest);
}

}  // namespace mrpbench::amcl
