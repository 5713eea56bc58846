#include "reordering/raise_bound.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace mrpbench::mapf {

namespace {

constexpr int kPatience = 2'000;  // steps for one part

class Raising {
 public:
  Raising(int robots, std::span<const Raises> decisions, Limits& limits)
      : decisions_(decisions), limits_(limits), raise_(robots), used_(robots) {}

  Cost solve() {
    Cost sum = 0;
    for (const std::vector<std::int32_t>& part : parts()) sum += solve_part(part);
    return sum;
  }

 private:
  /// Decisions that are connected by robots, those that cost most first.
  std::vector<std::vector<std::int32_t>> parts() {
    std::vector<std::int32_t> parent(raise_.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto find = [&](std::int32_t robot) {
      while (parent[robot] != robot) robot = parent[robot] = parent[parent[robot]];
      return robot;
    };
    for (const Raises& it : decisions_) {
      for (const auto& side : it) {
        for (const Raise& raise : side) parent[find(raise.robot)] = find(it[0].front().robot);
      }
    }
    std::vector<std::int32_t> order(decisions_.size());
    std::iota(order.begin(), order.end(), 0);
    std::vector<Cost> weight;
    for (const Raises& it : decisions_) weight.push_back(std::min(added(it[0]), added(it[1])));
    std::ranges::stable_sort(order, std::greater{}, [&](std::int32_t k) { return weight[k]; });
    std::vector<std::vector<std::int32_t>> parts;
    std::vector<std::int32_t> part_of(raise_.size(), -1);
    for (const std::int32_t k : order) {
      std::int32_t& part = part_of[find(decisions_[k][0].front().robot)];
      if (part < 0) {
        part = static_cast<std::int32_t>(parts.size());
        parts.emplace_back();
      }
      parts[part].push_back(k);
    }
    return parts;
  }

  Cost solve_part(const std::vector<std::int32_t>& part) {
    best_ = std::numeric_limits<Cost>::max();
    steps_ = 0;
    const Cost bound = disjoint(part, 0);
    branch(part, 0, 0);
    return steps_ > kPatience ? bound : best_;
  }

  /// What a choice adds to the raises so far.
  Cost added(const std::vector<Raise>& side) const {
    Cost sum = 0;
    for (const Raise& raise : side) sum += std::max(0, raise.ticks - raise_[raise.robot]);
    return sum;
  }

  /// Sum over decisions from `depth` on that share no robot.
  Cost disjoint(const std::vector<std::int32_t>& part, std::size_t depth) {
    ++round_;
    Cost sum = 0;
    for (std::size_t k = depth; k < part.size(); ++k) {
      const Raises& it = decisions_[part[k]];
      const Cost least = std::min(added(it[0]), added(it[1]));
      const auto is_used = [&](const Raise& raise) { return used_[raise.robot] == round_; };
      if (least == 0 || std::ranges::any_of(it[0], is_used) || std::ranges::any_of(it[1], is_used)) continue;
      sum += least;
      for (const auto& side : it) {
        for (const Raise& raise : side) used_[raise.robot] = round_;
      }
    }
    return sum;
  }

  void branch(const std::vector<std::int32_t>& part, std::size_t depth, Cost sum) {
    limits_.check();
    if (++steps_ > kPatience) return;
    const auto is_met = [&](std::int32_t k) { return added(decisions_[k][0]) == 0 || added(decisions_[k][1]) == 0; };
    while (depth < part.size() && is_met(part[depth])) ++depth;
    if (depth == part.size()) {
      best_ = std::min(best_, sum);
      return;
    }
    if (sum + disjoint(part, depth) >= best_) return;
    const Raises& it = decisions_[part[depth]];
    const int first = added(it[1]) < added(it[0]) ? 1 : 0;
    for (const int side : {first, 1 - first}) {
      const Cost more = added(it[side]);
      std::vector<Raise> before;
      for (const Raise& raise : it[side]) {
        before.push_back({raise.robot, raise_[raise.robot]});
        raise_[raise.robot] = std::max(raise_[raise.robot], raise.ticks);
      }
      branch(part, depth + 1, sum + more);
      for (const Raise& raise : before) raise_[raise.robot] = raise.ticks;
    }
  }

  std::span<const Raises> decisions_;
  Limits& limits_;
  std::vector<Tick> raise_;
  std::vector<std::int32_t> used_;
  std::int32_t round_ = 0;
  Cost best_ = 0;
  int steps_ = 0;
};

}  // namespace

Cost least_raise(int robots, std::span<const Raises> decisions, Limits& limits) {
  return Raising(robots, decisions, limits).solve();
}

}  // namespace mrpbench::mapf
