// EPIBT: PIBT over operations of several actions, improved by large neighbourhood search.
#pragma once

#include <array>

#include "mrpbench_discrete/planner.hpp"
#include "operations.hpp"

namespace mrpbench::discrete {

/// Enhanced PIBT (Yukhnevich and Andreychuk, "Enhancing PIBT via Multi-Action Operations", AAAI 2026). Each robot holds
/// an operation, and all operations together break no rule. A robot that wants another operation may push one robot at
/// a time. Of each operation the first action is executed; what is left of it, and a wait, is what the robot holds
/// next.
class Epibt final : public Planner {
 public:
  Epibt(int depth, bool improve, std::uint64_t seed);
  void plan(const View& view, const Budget& budget, std::vector<Action>& action) override;

 private:
  static constexpr int kDeepest = 5;
  using Path = std::array<std::int32_t, kDeepest + 1>;

  struct Choice {
    std::int32_t value;
    std::int16_t operation;
  };

  /// Of a robot in the search that has this stamp. `pushing`: it has, or is about to get, an operation that others make
  /// room for.
  struct Visit {
    std::uint64_t stamp = 0;
    int tries = 0;
    bool pushing = false;
  };

  void inherit(const View& view);
  void rank(const View& view);
  const std::vector<Choice>& choices(const View& view, int robot);
  std::int32_t value(const View& view, int robot, const Path& path, int operation) const;
  bool path_of(const View& view, int robot, const Operation& operation, Path& path) const;
  void place(int robot, const Path& path);
  void remove(int robot);
  int hit(const View& view, int robot, const Path& path) const;
  bool build(const View& view, int robot, double spent);
  void construct(const View& view);
  void improve(const View& view, const Budget& budget, double began);

  const int depth_;
  const bool improves_;
  const std::uint64_t seed_;
  const std::vector<Operation> operations_;
  std::vector<Operation> held_;
  std::vector<Path> path_;
  std::vector<std::int32_t> value_;
  std::vector<Pose> expected_;
  std::vector<std::vector<std::int32_t>> at_;
  std::vector<std::vector<Choice>> choices_;
  std::vector<std::uint8_t> known_, fixed_;
  std::vector<Visit> visit_;
  std::uint64_t stamp_ = 0, draws_ = 0, steps_ = 0;
  std::vector<double> weight_;
  std::vector<std::int32_t> order_;
  std::vector<std::int32_t> last_goal_;
  std::vector<std::uint32_t> nearest_;
  std::vector<std::uint64_t> waited_;
  double threshold_ = 0;
  bool any_ = true;
  int calls_ = 0;
};

}  // namespace mrpbench::discrete
