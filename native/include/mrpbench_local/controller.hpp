// The contract of local controllers. A controller is one file that defines a `ControllerKind` with a table of options,
// and a row in `controllers.cpp`.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mrpbench_local/forecast.hpp"
#include "mrpbench_local/path/path.hpp"
#include "mrpbench_local/robot_options.hpp"

namespace mrpbench::local {

/// The input of a controller in one control period.
struct Situation {
  double now = 0;
  Pose pose;
  Twist twist;
  Path path;
  const Costmap* costmap = nullptr;
  /// nullptr = nothing is predicted.
  const Forecast* forecast = nullptr;
};

/// Numbers in the order of rows, with the size of each dimension.
struct Array {
  std::vector<double> values;
  std::vector<std::size_t> shape;
};

/// Trajectories that a controller samples, for critics outside of this library: twists and poses, one row each.
struct Samples {
  Array twist, pose;
};

/// Scores that the caller adds to those of the trajectories; infinity = illegal.
using Extra = std::function<void(const Samples&, std::span<double>)>;

/// Why a controller chose its last command.
struct Explanation {
  std::map<std::string, Array> arrays;
  std::map<std::string, std::vector<std::string>> words;
};

class Controller {
 public:
  virtual ~Controller() = default;

  /// The best command, or nothing when none is admissible. Controllers that sample trajectories call `extra`, if it is
  /// set, and add its scores.
  virtual std::optional<Twist> command(const Situation& now, const Extra& extra) = 0;
  virtual Explanation explain() const { return {}; }
};

/// What the random numbers of a controller depend on: the seed of the run, and the index of the robot in its fleet.
struct RandomKey {
  std::uint64_t seed = 0;
  std::size_t robot = 0;
};

/// A critic by its name, the weight of its scores, and its options.
struct CriticChoice {
  std::string name;
  double weight = 1;
  OptionValues options;
};

/// The controllers of one name.
struct ControllerKind {
  std::function<std::unique_ptr<Controller>(const OptionValues&, const RobotOptions&, RandomKey,
                                            std::span<const CriticChoice>)>
      make;
  /// Options that Nav2 has, that it does not have, and that follow from the robot and the run.
  std::vector<Parameter> nav2, further, derived;
  /// The options of a critic. Throws std::invalid_argument if there is no critic of this name.
  std::function<std::vector<Parameter>(const std::string&)> critic_options;
};

/// The kind of controllers without critics of the class `C`, which is made from `C::Options` and `RobotOptions`. The
/// options describe themselves by `nav2()`, `further()` and `derived()`.
template <class C>
ControllerKind controller_of() {
  using Options = typename C::Options;
  Description<Options> rows = Options::nav2();
  for (const auto& group : {Options::further(), Options::derived()})
    rows.insert(rows.end(), group.begin(), group.end());
  return {.make = [rows](const OptionValues& values, const RobotOptions& robot, RandomKey,
                         std::span<const CriticChoice>) -> std::unique_ptr<Controller> {
            return std::make_unique<C>(configured(rows, values, Options{}), robot);
          },
          .nav2 = parameters(Options::nav2(), Options{}),
          .further = parameters(Options::further(), Options{}),
          .derived = parameters(Options::derived(), Options{}),
          .critic_options = {}};
}

/// Throws std::invalid_argument if there is no controller of this name.
const ControllerKind& controller_kind(const std::string& name);

ControllerKind dwb();
ControllerKind graceful();
ControllerKind mppi_controller();
ControllerKind rpp();

}  // namespace mrpbench::local
