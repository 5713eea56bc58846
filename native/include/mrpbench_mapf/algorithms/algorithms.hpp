// Algorithms by name: what each stands for, its options and their defaults. A new one is a header with a solve function
// and an options struct, and one row in `algorithms.cpp`; one outside of this library is made by `make_algorithm`.
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

/// An algorithm with the options that `Options::description()` lists. `preset` holds the defaults under this name;
/// `fixed` tells which options the name decides.
template <class Options>
Algorithm make_algorithm(
    std::string name, std::string help, Result (*solve)(const Instance&, const Options&, Limits&), Options preset = {},
    const std::function<bool(const std::string&)>& fixed = [](const std::string&) { return false; }) {
  const Description<Options> rows = Options::description();
  Algorithm made{std::move(name), std::move(help), parameters(rows, preset), {}};
  for (Parameter& option : made.options) option.fixed = fixed(option.info.name);
  made.configure = [rows, preset, solve](const OptionValues& values) -> Algorithm::Solver {
    const Options options = configured(rows, values, preset);
    return [options, solve](const Instance& instance, Limits& limits) { return solve(instance, options, limits); };
  };
  return made;
}

/// The algorithms of this library, in alphabetical order.
const std::vector<Algorithm>& algorithms();

/// The one of this name. Throws std::invalid_argument if there is none.
const Algorithm& find(const std::vector<Algorithm>& algorithms, const std::string& name);

}  // namespace mrpbench::mapf
