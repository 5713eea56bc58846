#include "mrpbench_mapf/algorithms/pbs.hpp"

#include <algorithm>
#include <numeric>

#include "mrpbench_mapf/common/arena.hpp"
#include "mrpbench_mapf/infeasibility/solvability.hpp"
#include "mrpbench_mapf/model/conflict.hpp"
#include "mrpbench_mapf/model/uses.hpp"
#include "mrpbench_mapf/single_agent/sipp.hpp"

namespace mrpbench::mapf {

namespace {

/// A node of the tree of priorities: those of its parent and one more.
struct Node {
  const Node* parent = nullptr;
  std::int32_t before = -1, after = -1;  // robots
  std::vector<std::span<const Occupation>> paths;
  std::vector<PairConflict> conflicts;               // one entry for each pair of robots in one another's way
  std::vector<CapacityConflict> capacity_conflicts;  // pairs among too many users of a resource
  Cost cost = 0;

  std::size_t conflict_count() const { return conflicts.size() + capacity_conflicts.size(); }
};

class Pbs {
 public:
  Pbs(const Instance& instance, Limits& limits, Result& result)
      : instance_(instance),
        limits_(limits),
        result_(result),
        tables_(instance, limits),
        relations_(instance, limits),
        above_(instance, relations_, limits),
        present_(instance, relations_, limits),
        sipp_(instance, limits, result.statistics),
        occupations_(limits),
        robots_(instance.size()),
        after_(robots_),
        before_(robots_) {}

  void solve() {
    if (const auto robot = find_cut_off_robot(instance_, tables_, limits_)) return result_.no_plan_for(*robot);
    result_.lower_bound = static_cast<double>(tables_.sum_of_costs(instance_));
    if (const auto robot = find_clash(instance_, relations_, limits_)) return result_.no_plan_for(*robot);
    auto root = std::make_unique<Node>();
    root->paths.resize(robots_);
    gather(*root);
    for (int robot = 0; robot < robots_; ++robot) {
      if (!plan(*root, robot)) return result_.no_plan_for(robot);  // committed segments alone leave no path
    }
    depth_first(std::move(root));
  }

 private:
  void depth_first(std::unique_ptr<Node> root) {
    // Parents stay on the stack below their children, which refer to their priorities.
    std::vector<std::unique_ptr<Node>> open;
    std::vector<bool> expanded;
    const auto push = [&](std::unique_ptr<Node> node) {
      open.push_back(std::move(node));
      expanded.push_back(false);
      ++result_.statistics.generated;
      limits_.charge_growth(counted_, open.size() * (sizeof(Node) + robots_ * sizeof(std::span<const Occupation>)));
    };
    push(std::move(root));
    while (!open.empty()) {
      if (expanded.back()) {
        open.pop_back();
        expanded.pop_back();
        continue;
      }
      expanded.back() = true;
      Node& node = *open.back();
      if (node.conflict_count() == 0) return finish(node);
      ++result_.statistics.expansions;
      const auto [first, second] = next_pair(node);
      auto one = child(node, first, second), other = child(node, second, first);
      // The better one is expanded next: it comes last.
      if (one && other &&
          std::pair(one->cost, one->conflict_count()) < std::pair(other->cost, other->conflict_count())) {
        std::swap(one, other);
      }
      if (one) push(std::move(one));
      if (other) push(std::move(other));
    }
  }

  /// The pair to decide on: the first to conflict. Of too many users of a resource not all have an order yet, since the
  /// last in a full order has planned around the others.
  std::pair<int, int> next_pair(const Node& node) {
    gather(node);
    std::pair<int, int> pair{-1, -1};
    Half earliest = kForeverHalf;
    const auto consider = [&](const auto& it, bool open) {
      if (!open || (pair.first >= 0 && it.time >= earliest)) return;
      pair = {it.one, it.other};
      earliest = it.time;
    };
    for (const PairConflict& it : node.conflicts) consider(it, true);
    for (const CapacityConflict& it : node.capacity_conflicts) {
      consider(it, !comes_before(it.one, it.other) && !comes_before(it.other, it.one));
    }
    return pair;
  }

  void finish(const Node& node) {
    for (const auto& path : node.paths) result_.paths.emplace_back(path.begin(), path.end());
    result_.status = Status::solved;
    result_.statistics.failed_robot = -1;
  }

  /// `node` with robot `after` planning after robot `before`; nothing if there is no such plan.
  std::unique_ptr<Node> child(const Node& node, int before, int after) {
    gather(node);
    if (comes_before(after, before)) return nullptr;
    after_[before].push_back(after);
    before_[after].push_back(before);
    auto made = std::make_unique<Node>(node);
    made->parent = &node;
    made->before = before;
    made->after = after;
    // Robots that come after `after` may be in the way of its new path, and so on: in an order that plans none twice.
    for (const int robot : from_on(after)) {
      const auto hits = [&](const auto& conflict) {
        const int other = conflict.one == robot ? conflict.other : conflict.other == robot ? conflict.one : -1;
        return other >= 0 && comes_before(other, robot);
      };
      const bool hit =
          std::ranges::any_of(made->conflicts, hits) || std::ranges::any_of(made->capacity_conflicts, hits);
      if (hit && !plan(*made, robot)) {
        result_.statistics.failed_robot = robot;
        return nullptr;
      }
    }
    return made;
  }

  /// Write the priorities of `node` into `after_` and `before_`.
  void gather(const Node& node) {
    for (auto& robots : after_) robots.clear();
    for (auto& robots : before_) robots.clear();
    for (const Node* it = &node; it->parent != nullptr; it = it->parent) {
      after_[it->before].push_back(it->after);
      before_[it->after].push_back(it->before);
    }
  }

  bool comes_before(int one, int other) {
    mark_all(before_, other);
    return one != other && marked_[one];
  }

  /// Mark `robot` and all that `links` lead to from it; `order_` lists them, those that links lead to first.
  void mark_all(const std::vector<std::vector<int>>& links, int robot) {
    marked_.assign(robots_, false);
    order_.clear();
    mark(links, robot);
  }
  void mark(const std::vector<std::vector<int>>& links, int robot) {
    limits_.check();
    marked_[robot] = true;
    for (const int next : links[robot]) {
      if (!marked_[next]) mark(links, next);
    }
    order_.push_back(robot);
  }

  /// `robot` and those after it, each after all that come before it.
  std::vector<int> from_on(int robot) {
    mark_all(after_, robot);
    return {order_.rbegin(), order_.rend()};
  }

  /// Plan `robot` around those before it.
  bool plan(Node& node, int robot) {
    above_.clear();
    reserve_beginnings(instance_, above_);
    mark_all(before_, robot);
    for (const int other : order_) {
      if (other != robot) above_.add(other, node.paths[other]);
    }
    present_.clear();
    for (int other = 0; other < robots_; ++other) present_.add(other, node.paths[other]);
    if (!sipp_.search(robot, tables_, Others(above_, robot), path_, &present_)) return false;
    if (!node.paths[robot].empty()) node.cost -= arrival(node.paths[robot]);
    node.cost += arrival(path_);
    node.paths[robot] = occupations_.copy(path_);
    std::erase_if(node.conflicts, [&](const PairConflict& it) { return it.one == robot || it.other == robot; });
    for (int other = 0; other < robots_; ++other) {
      limits_.check();
      if (other == robot || node.paths[other].empty()) continue;
      const PairConflict found =
          find_conflict(instance_, relations_, robot, node.paths[robot], other, node.paths[other]);
      if (found.count > 0) node.conflicts.push_back(found);
    }
    node.capacity_conflicts = find_capacity_conflicts(instance_, node.paths);
    const Half last = 2 * instance_.rules().horizon;
    std::erase_if(node.capacity_conflicts, [&](const CapacityConflict& it) { return it.time > last; });
    return true;
  }

  const Instance& instance_;
  Limits& limits_;
  Result& result_;
  DistanceTables tables_;
  Relations relations_;
  Reservations above_;    // of robots that come before the one at hand, and what is certain
  Reservations present_;  // of all robots
  Sipp sipp_;
  Arena<Occupation> occupations_;
  int robots_;
  std::vector<std::vector<int>> after_, before_;  // by robot
  std::vector<bool> marked_;
  std::vector<int> order_;
  std::size_t counted_ = 0;
  Path path_;
};

}  // namespace

Result solve_pbs(const Instance& instance, const PbsOptions&, Limits& limits) {
  return solve_within(instance, limits, [&](Result& result) { Pbs(instance, limits, result).solve(); });
}

}  // namespace mrpbench::mapf
