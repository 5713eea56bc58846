#include "mrpbench_mapf/cbs.hpp"

#include <algorithm>
#include <functional>

#include "mrpbench_mapf/arena.hpp"
#include "mrpbench_mapf/constraint.hpp"
#include "mrpbench_mapf/sipp.hpp"
#include "mrpbench_mapf/solvability.hpp"

// Where the time goes (random-32-32-20 with 60 robots, 25 000 expansions a second): a fifth lists the present paths by
// element anew for every expansion, a third is the search for one robot, a seventh of it counting conflicts; a tenth
// clears fresh memory. On roadmaps with long edges it is the number of expansions that hurts: robots that meet in a
// corridor are delayed tick by tick.

namespace mrpbench::mapf {

namespace {

/// A node of the constraint tree. It stores what differs from its parent: one constraint and the path replanned for it.
struct Node {
  const Node* parent = nullptr;
  Constraint constraint{};
  std::span<const Occupation> path;
  std::span<const PairConflict> conflicts;  // one entry for each pair of robots in one another's way
  Cost cost = 0;
};

struct Open {
  Cost cost;
  std::int32_t conflicts;
  std::int32_t id;
  const Node* node;

  /// Expanded after `other`: least cost first, then fewest conflicts, then newest.
  bool operator>(const Open& other) const {
    if (cost != other.cost) return cost > other.cost;
    if (conflicts != other.conflicts) return conflicts > other.conflicts;
    return id < other.id;
  }
};

class Cbs {
 public:
  Cbs(const Instance& instance, Limits& limits, Result& result)
      : instance_(instance),
        limits_(limits),
        result_(result),
        tables_(instance, limits),
        relations_(instance, limits),
        certain_(instance, relations_, limits),
        present_(instance, relations_, limits),
        sipp_(instance, limits, result.statistics),
        constraints_(instance.roadmap(), certain_, limits),
        nodes_(limits),
        occupations_(limits),
        conflicts_(limits) {}

  void solve() {
    if (const auto robot = find_cut_off_robot(instance_, tables_, limits_)) return unsolvable(*robot);
    result_.lower_bound = static_cast<double>(tables_.sum_of_costs(instance_));
    if (const auto robot = find_clash(instance_, relations_, limits_)) return unsolvable(*robot);
    reserve_beginnings(instance_, certain_);
    if (const auto robot = plan_root()) return unsolvable(*robot);
    while (!open_.empty()) {
      std::ranges::pop_heap(open_, std::greater{});
      const Node& node = *open_.back().node;
      open_.pop_back();
      result_.lower_bound = static_cast<double>(node.cost);
      gather(node);
      if (node.conflicts.empty()) return finish();
      expand(node);
    }
    result_.status = Status::unsolvable;  // the tree is exhausted
  }

 private:
  void unsolvable(int robot) {
    result_.statistics.failed_robot = robot;
    result_.status = Status::unsolvable;
  }

  void finish() {
    for (const auto& path : current_) result_.paths.emplace_back(path.begin(), path.end());
    result_.status = Status::solved;
  }

  /// Every robot's best path around what is certain; the robot that has none, or nothing.
  std::optional<int> plan_root() {
    Cost cost = 0;
    Path path;
    for (int robot = 0; robot < instance_.size(); ++robot) {
      constraints_.reset(robot);
      if (!sipp_.search(robot, tables_[robot], constraints_, path, &present_)) return robot;
      add_conflicts(robot, path);
      root_.push_back(occupations_.copy(path));
      present_.add(robot, path);
      cost += arrival(path);
    }
    Node root;
    root.cost = cost;
    push(root);
    return std::nullopt;
  }

  /// Put the paths of `node` into `current_`.
  void gather(const Node& node) {
    current_ = root_;
    replanned_.assign(instance_.size(), false);
    for (const Node* it = &node; it->parent != nullptr; it = it->parent) {
      const int robot = it->constraint.robot;
      if (!replanned_[robot]) current_[robot] = it->path;
      replanned_[robot] = true;
    }
  }

  void expand(const Node& node) {
    ++result_.statistics.expansions;
    present_.clear();
    for (int robot = 0; robot < instance_.size(); ++robot) present_.add(robot, current_[robot]);
    const PairConflict& conflict = *std::ranges::min_element(node.conflicts, {}, &PairConflict::time);
    for (const Constraint& constraint :
         split(conflict, current_[conflict.one], current_[conflict.other], instance_.roadmap().vertex_count())) {
      add_child(node, constraint);
    }
  }

  void add_child(const Node& parent, const Constraint& constraint) {
    const int robot = constraint.robot;
    constraints_.reset(robot);
    constraints_.add(constraint);
    for (const Node* it = &parent; it->parent != nullptr; it = it->parent) {
      if (it->constraint.robot == robot) constraints_.add(it->constraint);
    }
    if (!sipp_.search(robot, tables_[robot], constraints_, path_, &present_)) return;
    found_.clear();
    for (const PairConflict& old : parent.conflicts) {
      if (old.one != robot && old.other != robot) found_.push_back(old);
    }
    add_conflicts(robot, path_);
    push({&parent, constraint, occupations_.copy(path_), {}, parent.cost - arrival(current_[robot]) + arrival(path_)});
  }

  /// Append to `found_` the conflicts of `path` with the present paths, one entry per robot.
  void add_conflicts(int robot, std::span<const Occupation> path) {
    first_with_.assign(instance_.size(), -1);
    for (std::size_t step = 0; step < path.size(); ++step) {
      limits_.check();
      present_.conflicts_of(robot, path[step], [&](const auto& other, Relation relation) {
        std::int32_t& index = first_with_[other.robot];
        const Half time = std::max(path[step].begin, other.begin);
        if (index < 0) {
          index = static_cast<std::int32_t>(found_.size());
          found_.push_back({robot, other.robot, 0, 0, kForeverHalf, Relation::none, 0});
        }
        PairConflict& conflict = found_[index];
        ++conflict.count;
        if (time >= conflict.time) return;
        conflict.one_step = static_cast<std::int32_t>(step);
        conflict.other_step = other.step;
        conflict.time = time;
        conflict.relation = relation;
      });
    }
  }

  void push(Node node) {
    node.conflicts = conflicts_.copy(found_);
    std::int32_t count = 0;
    for (const PairConflict& conflict : found_) count += conflict.count;
    const auto id = static_cast<std::int32_t>(result_.statistics.generated++);
    open_.push_back({node.cost, count, id, &nodes_.copy(node)});
    std::ranges::push_heap(open_, std::greater{});
    limits_.charge_growth(counted_, open_.capacity() * sizeof(Open));
  }

  const Instance& instance_;
  Limits& limits_;
  Result& result_;
  DistanceTables tables_;
  Relations relations_;
  Reservations certain_;  // what the robots do in any case
  Reservations present_;  // what they do in the node at hand
  Sipp sipp_;
  ConstraintTable constraints_;
  Arena<Node> nodes_;
  Arena<Occupation> occupations_;
  Arena<PairConflict> conflicts_;
  std::vector<Open> open_;
  std::size_t counted_ = 0;
  std::vector<std::span<const Occupation>> root_, current_;  // by robot
  std::vector<bool> replanned_;
  std::vector<PairConflict> found_;
  std::vector<std::int32_t> first_with_;  // index into `found_` by the other robot, -1 = none
  Path path_;
};

}  // namespace

Result solve_cbs(const Instance& instance, Limits& limits) {
  Result result;
  try {
    Cbs(instance, limits, result).solve();
  } catch (const LimitReached& limit) {
    result.status = limit.status;
  } catch (const std::bad_alloc&) {
    result.status = Status::out_of_memory;
  }
  return result;
}

}  // namespace mrpbench::mapf
