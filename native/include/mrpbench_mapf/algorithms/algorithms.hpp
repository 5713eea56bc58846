// The algorithms by name: what each stands for, its options and their defaults. A new one is a header with a solve
// function and an options struct, and one row in `algorithms.cpp`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mrpbench_mapf/model/result.hpp"
#include "mrpbench_options/options.hpp"

namespace mrpbench::mapf {

struct Algorithm {
  using Solver = std::function<Result(const Instance&, Limits&)>;

  std::string name;
  std::string help;  // one sentence
  std::vector<Parameter> options;
  /// The solver with these options and presets for the others. Throws std::invalid_argument, naming the option, for one
  /// that does not exist or a value that it cannot have.
  std::function<Solver(const OptionValues&)> configure;
};

/// All algorithms, in alphabetical order.
const std::vector<Algorithm>& algorithms();

/// Throws std::invalid_argument if there is none of this name.
const Algorithm& algorithm(const std::string& name);

}  // namespace mrpbench::mapf
