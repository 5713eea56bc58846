#include "mrpbench_local/forecast.hpp"

#include <algorithm>

namespace mrpbench::local {

Point Forecast::at(std::size_t disc, double time) const {
  const std::span<const Point> its = of(disc);
  const double steps = time / step;
  const auto before = std::min(static_cast<std::size_t>(steps), count - 1);
  const Point here = its[before];
  if (before + 1 == count) return here;
  return here + (its[before + 1] - here) * (steps - static_cast<double>(before));
}

std::vector<std::size_t> within_reach(const Forecast& forecast, Point robot, double radius, double way,
                                      double distance) {
  std::vector<std::size_t> discs;
  for (std::size_t i = 0; i < forecast.size(); ++i) {
    const double reach = forecast.radius[i] + radius + way + distance;
    if (std::ranges::any_of(forecast.of(i), [&](Point it) { return sim::length(it - robot) < reach; })) {
      discs.push_back(i);
    }
  }
  return discs;
}

}  // namespace mrpbench::local
