// What anytime solvers minimise.
#pragma once

#include <algorithm>
#include <compare>

#include "mrpbench_mapf/model/result.hpp"
#include "mrpbench_options/options.hpp"

namespace mrpbench::mapf {

enum class Objective { flowtime, makespan };

/// The row of the option that chooses it.
template <class Options>
Option<Options> objective_option() {
  return {"objective", &Options::objective,
          Choices<Objective>{{"flowtime", Objective::flowtime}, {"makespan", Objective::makespan}},
          "What is minimised: flowtime (the sum of arrival times) or makespan (the last arrival, then the sum)"};
}

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
