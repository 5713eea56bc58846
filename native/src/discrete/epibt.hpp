// EPIBT: PIBT over operations of several actions, improved by large neighbourhood search.
#pragma once

#include <optional>
#include <span>

#include "operation_lns.hpp"
#include "operations.hpp"

namespace mrpbench::discrete {

/// Enhanced PIBT (Yukhnevich and Andreychuk, "Enhancing PIBT via Multi-Action Operations", AAAI 2026). Each robot holds
/// an operation, and all operations together break no rule. A robot that wants another operation may push one robot at
/// a time. Of each operation the first action is executed; what is left of it, and a wait, is what the robot holds
/// next.
class Epibt final : public Planner {
 public:
  Epibt(int depth, bool improve, int threads, std::uint64_t seed);
  void plan(const View& view, const Budget& budget, std::vector<Action>& action) override;

 private:
  void inherit(const View& view);
  void rank(const View& view);
  void choose(const View& view);
  void construct();
  std::optional<OperationPlan> plan_of(const View& view, int robot, std::span<const Action> actions, int worth) const;
  std::int32_t value(const View& view, int robot, const OperationPlan& plan, int worth) const;

  const int depth_;
  const bool improves_;
  const std::uint64_t seed_;
  const std::vector<Operation> operations_;
  OperationLns lns_;
  std::optional<OperationSearch> search_;
  Wishes wishes_;
  std::vector<OperationPlan> held_;
  std::vector<Pose> expected_;
  std::uint64_t steps_ = 0;
  std::vector<std::int32_t> order_;
  std::vector<std::int32_t> last_goal_;
  std::vector<std::uint32_t> nearest_;
  std::vector<std::uint64_t> waited_;
};

}  // namespace mrpbench::discrete
