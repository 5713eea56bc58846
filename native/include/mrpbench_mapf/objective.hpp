// What anytime solvers minimise.
#pragma once

#include <algorithm>
#include <compare>

#include "mrpbench_mapf/result.hpp"

namespace mrpbench::mapf {

enum class Objective { flowtime, makespan };

/// Smaller is better: first what is asked for, then the sum of arrival times.
struct Value {
  Cost first;
  Cost second;

  auto operator<=>(const Value&) const = default;
};

template <class Paths>
Value value(Objective objective, const Paths& paths) {
  Cost sum = 0, latest = 0;
  for (const auto& path : paths) {
    sum += arrival(path);
    latest = std::max<Cost>(latest, arrival(path));
  }
  return objective == Objective::makespan ? Value{latest, sum} : Value{sum, sum};
}

}  // namespace mrpbench::mapf
