// Critics of MPPI. Those of Nav2 have its names, parameters and defaults (lyrical 1.5).
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "mrpbench_local/mppi/batch.hpp"
#include "mrpbench_options/options.hpp"

namespace mrpbench::local::mppi {

class Critic {
 public:
  virtual ~Critic() = default;
  /// Called in each period before the first block.
  virtual void begin(const Batch&) {}
  /// Raw scores of the samples of a block, which come as zeros. Returns false if all of them collide.
  virtual bool score(const Batch& batch, std::span<float> raw) = 0;
  /// Tell whether scores depend on `furthest`, which is known when all blocks are rolled out. Such a critic sees only
  /// the ways of samples; others come before, and see motions, too.
  virtual bool looks_at_furthest() const { return false; }
  /// Called with the raw scores of all blocks.
  virtual void finish(std::span<float>) {}
};

/// A critic and how its scores count: (weight * raw) ^ power.
struct WeightedCritic {
  std::string name;
  float weight = 1;
  int power = 1;
  std::unique_ptr<Critic> critic;

  /// Add (weight * raw) ^ power of each sample to its total.
  void add(std::span<const float> raw, std::span<float> total) const;
};

struct CriticKind {
  std::function<WeightedCritic(const OptionValues&)> make;
  std::vector<Parameter> options;
};

/// The critics that Nav2 calls by this name. Throws std::invalid_argument if there are none.
const CriticKind& critic_kind(const std::string& name);

/// Options of all critics.
struct Weighting {
  bool enabled = true;
  double cost_weight = 1;
  int cost_power = 1;
};

/// The kind of critics of the class `C`, which is made from `C::Options`; these derive from `Weighting`.
template <class C>
CriticKind kind_of(double weight) {
  using Options = typename C::Options;
  Options preset;
  preset.cost_weight = weight;
  Description<Options> rows = Options::description();
  rows.push_back({"enabled", static_cast<bool Options::*>(&Weighting::enabled), "use it"});
  rows.push_back({"cost_weight", static_cast<double Options::*>(&Weighting::cost_weight), at_least(0).usually(0, 20),
                  "weight among the other critics; 0 = off"});
  rows.push_back({"cost_power", static_cast<int Options::*>(&Weighting::cost_power), within(1, 8).usually(1, 2),
                  "power of the weighted score"});
  return {[rows, preset](const OptionValues& values) {
            const Options options = configured(rows, values, preset);
            return WeightedCritic{"", options.enabled ? static_cast<float>(options.cost_weight) : 0.0f,
                                  options.cost_power, std::make_unique<C>(options)};
          },
          parameters(rows, preset)};
}

CriticKind constraint_critic();
CriticKind cost_critic();
CriticKind goal_critic();
CriticKind goal_angle_critic();
CriticKind obstacles_critic();
CriticKind path_align_critic();
CriticKind path_angle_critic();
CriticKind path_follow_critic();
CriticKind predicted_obstacle_critic();
CriticKind prefer_forward_critic();
CriticKind twirling_critic();
CriticKind velocity_deadband_critic();

}  // namespace mrpbench::local::mppi
