#include "delays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draws.hpp"

namespace mrpbench::discrete {
namespace {

enum Stream { events = 1, count, choice, length, phase };

/// Inversion by sequential search (Devroye, Non-Uniform Random Variate Generation, 1986, X.3.3), in parts whose mean is
/// small enough for exp(-mean).
int poisson(double mean, std::uint64_t seed, int time) {
  int found = 0;
  for (int part = 0; mean > 0; ++part, mean -= 500) {
    const double unit = drawn_unit(seed, count, time, part);
    double probability = std::exp(-std::min(mean, 500.0)), sum = probability;
    int k = 0;
    while (unit >= sum && probability > 0) {
      probability *= std::min(mean, 500.0) / ++k;
      sum += probability;
    }
    found += k;
  }
  return found;
}

}  // namespace

DelayModel::DelayModel(const Delays& options, std::size_t robots) : options_(options) {
  remaining_.assign(robots, 0);
  delayed_.assign(robots, 0);
  intervals_.resize(robots);
}

void DelayModel::hit(int time, std::size_t robot) {
  const double spread = options_.most - options_.least;
  double ticks;
  if (options_.gaussian) {
    const double radius = std::sqrt(-2 * std::log(1 - drawn_unit(options_.seed, length, time, robot)));
    const double normal = radius * std::cos(2 * std::numbers::pi * drawn_unit(options_.seed, phase, time, robot));
    ticks = std::round(options_.least + spread * (options_.mean_ratio + options_.deviation_ratio * normal));
    ticks = std::clamp<double>(ticks, options_.least, options_.most);
  } else {
    ticks = options_.least + std::floor((spread + 1) * drawn_unit(options_.seed, length, time, robot));
  }
  remaining_[robot] = static_cast<std::int32_t>(ticks);
  if (remaining_[robot] > 0) intervals_[robot].push_back({time, time + remaining_[robot]});
}

const std::vector<std::uint8_t>& DelayModel::tick(int time) {
  for (std::int32_t& it : remaining_) it = std::max(0, it - 1);
  if (options_.probability > 0) {
    const std::size_t robots = remaining_.size();
    if (!options_.poisson) {
      for (std::size_t i = 0; i < robots; ++i) {
        if (remaining_[i] == 0 && drawn_unit(options_.seed, events, time, i) < options_.probability) hit(time, i);
      }
    } else {
      available_.clear();
      for (std::size_t i = 0; i < robots; ++i) {
        if (remaining_[i] == 0) available_.push_back(static_cast<std::int32_t>(i));
      }
      const double mean = static_cast<double>(robots) * options_.probability;
      const auto hits = std::min<std::size_t>(poisson(mean, options_.seed, time), available_.size());
      for (std::size_t k = 0; k < hits; ++k) {
        const std::size_t left = available_.size() - k;
        std::swap(available_[k], available_[k + drawn(options_.seed, choice, time, k) % left]);
        hit(time, available_[k]);
      }
    }
  }
  for (std::size_t i = 0; i < delayed_.size(); ++i) delayed_[i] = remaining_[i] > 0;
  return delayed_;
}

}  // namespace mrpbench::discrete
