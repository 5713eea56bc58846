#include "mrpbench_mapf/reordering/gses.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <queue>
#include <tuple>

#include "reordering/decisions.hpp"
#include "reordering/local_search.hpp"
#include "reordering/raise_bound.hpp"
#include "reordering/schedule.hpp"

namespace mrpbench::mapf {

namespace {

constexpr Cost kNone = std::numeric_limits<Cost>::max();
constexpr std::int64_t kBytesOfNode = 128;
constexpr std::int64_t kShareOfDives = 4;  // one part of the work in so many finds orders, the others bound them

/// What is known of a choice here and in the nodes below: robots arrive at these times at the earliest.
struct Known {
  bool possible = true;
  std::vector<Arrival> arrivals;
  std::int64_t times = -1;  // sum of the times around its arcs when it was probed
};

class Search {
 public:
  Search(AlternativeGraph graph, Limits& limits, std::int64_t work_limit)
      : graph_(std::move(graph)),
        limits_(limits),
        work_limit_(work_limit),
        decisions_(graph_),
        arcs_(graph_, decisions_),
        schedule_(graph_, decisions_, arcs_, limits),
        known_(2 * decisions_.count()) {
    result_.decisions = decisions_.count();
    const std::vector<char> planned(graph_.alternatives.size());
    result_.planned_cost = cost_of_order(graph_, planned);
    if (result_.planned_cost >= 0) {
      result_.switched = planned;
      best_ = result_.planned_cost;
    }
  }

  Reordering run() {
    try {
      search();
      result_.status = best_ == kNone ? Status::unsolvable : Status::solved;
      result_.lower_bound = best_ == kNone ? 0 : best_;
    } catch (const LimitReached& reached) {
      result_.status = reached.status;
      result_.lower_bound = std::min(bound_, best_);
    }
    if (best_ != kNone) result_.cost = best_;
    result_.work = work();
    return std::move(result_);
  }

 private:
  struct Node {
    std::int32_t parent;
    std::int32_t depth;
    Cost bound;
    std::vector<Choice> made;  // the choice that leads here from the parent, then those that it forces
  };
  struct Step {  // a node on the way from the root to the present one
    std::int32_t node;
    Schedule::Mark mark;
    std::size_t learnt;
  };

  void search() {
    if (!schedule_.consistent()) return;
    bound_ = schedule_.cost();
    if (best_ != kNone) improve_planned_order();
    nodes_.push_back({-1, 0, bound_, {}});
    path_.push_back({0, schedule_.mark(), 0});
    std::optional<std::int32_t> next = 0;
    while (next) {
      const std::int32_t node = *next;
      next.reset();
      bound_ = open_.empty() ? nodes_[node].bound : std::min(nodes_[node].bound, std::get<0>(open_.top()));
      if (go_to(node)) next = expand(node);
      if (!next || (!open_.empty() && std::get<0>(open_.top()) < nodes_[*next].bound)) {
        if (next) push(*next);
        next = pop();
      }
    }
  }

  void improve_planned_order() {
    LocalSearch local(graph_, decisions_, arcs_, decisions_.planned_sides(), limits_);
    const auto take = [&] {
      best_ = local.cost();
      local_work_ = local.work();
      for (std::size_t k = 0; k < graph_.alternatives.size(); ++k) {
        const Choice planned = decisions_.planned(k);
        result_.switched[k] = local.sides()[planned.decision] != planned.side;
      }
    };
    try {
      local.run(work_limit_);
    } catch (const LimitReached&) {
      take();
      throw;
    }
    take();
  }

  void push(std::int32_t node) { open_.emplace(nodes_[node].bound, -nodes_[node].depth, node); }

  std::optional<std::int32_t> pop() {
    if (open_.empty() || std::get<0>(open_.top()) >= best_) return std::nullopt;
    const std::int32_t node = std::get<2>(open_.top());
    open_.pop();
    return node;
  }

  /// Make the choices of a node. False if they form a cycle.
  bool go_to(std::int32_t node) {
    std::vector<std::int32_t> down;
    for (std::int32_t at = node; at >= 0 && !on_path(at); at = nodes_[at].parent) down.push_back(at);
    const std::size_t kept = down.empty() ? nodes_[node].depth + 1 : nodes_[down.back()].depth;
    if (path_.size() > kept) {
      forget(path_[kept].learnt);
      schedule_.undo(path_[kept].mark);
      path_.resize(kept);
    }
    for (auto it = down.rbegin(); it != down.rend(); ++it) {
      path_.push_back({*it, schedule_.mark(), learnt_.size()});
      for (const Choice& choice : nodes_[*it].made) {
        if (!schedule_.decide(choice)) return false;
      }
    }
    return true;
  }

  bool on_path(std::int32_t node) const {
    const std::size_t depth = nodes_[node].depth;
    return depth < path_.size() && path_[depth].node == node;
  }

  /// Bound the present node and create its children. Returns the more promising child.
  std::optional<std::int32_t> expand(std::int32_t node) {
    ++result_.expansions;
    if (!tighten(node)) return std::nullopt;
    if (kShareOfDives * dive_work_ <= schedule_.work()) dive();
    if (schedule_.cost() >= best_) return std::nullopt;
    if (schedule_.pending().empty()) {
      keep();
      return std::nullopt;
    }
    Cost bound = std::max(nodes_[node].bound, schedule_.cost());
    std::vector<Raises> raises;
    Choice branch{schedule_.pending().front(), 0};
    std::array<Cost, 2> weight{-1, -1}, at_branch{};  // the least of both choices, and the greatest
    for (const std::int32_t decision : schedule_.pending()) {
      Raises both{raises_of({decision, 0}), raises_of({decision, 1})};
      const std::array<Cost, 2> sums = {sum(both[0]), sum(both[1])};
      const std::array<Cost, 2> own = {std::min(sums[0], sums[1]), std::max(sums[0], sums[1])};
      if (own > weight) {
        weight = own;
        at_branch = sums;
        branch = {decision, static_cast<Side>(sums[1] < sums[0])};
      }
      if (own[0] > 0) raises.push_back(std::move(both));
    }
    bound = std::max(bound, schedule_.cost() + least_raise(graph_.robots(), raises, limits_));
    nodes_[node].bound = bound;
    if (bound >= best_) return std::nullopt;
    const std::int32_t second = child(node, branch.other(), std::max(bound, schedule_.cost() + weight[1]));
    const std::int32_t first = child(node, branch, std::max(bound, schedule_.cost() + weight[0]));
    if (nodes_[second].bound < best_) push(second);
    if (nodes_[first].bound >= best_) return std::nullopt;
    return first;
  }

  std::int32_t child(std::int32_t parent, Choice choice, Cost bound) {
    limits_.charge(kBytesOfNode);
    nodes_.push_back({parent, nodes_[parent].depth + 1, bound, {choice}});
    return static_cast<std::int32_t>(nodes_.size()) - 1;
  }

  /// Probe pending decisions and make the choices that are forced. False if no better order begins like this.
  bool tighten(std::int32_t node) {
    for (bool changed = true; changed;) {
      changed = false;
      const auto pending = schedule_.pending();
      probed_.assign(pending.begin(), pending.end());  // decisions are made while these are probed
      for (const std::int32_t decision : probed_) {
        if (!schedule_.is_pending(decision)) continue;
        const bool one = is_useful({decision, 0}), other = is_useful({decision, 1});
        if (one && other) continue;
        const Choice forced{decision, static_cast<Side>(one ? 0 : 1)};
        nodes_[node].made.push_back(forced);
        if ((!one && !other) || !schedule_.decide(forced)) return false;
        changed = true;
      }
    }
    return true;
  }

  bool is_useful(Choice choice) {
    const Known& known = learn(choice);
    return known.possible && schedule_.cost() + later(known.arrivals) < best_;
  }

  /// Probe a choice, unless nothing around its arcs has changed since it was probed.
  const Known& learn(Choice choice) {
    const std::size_t index = choice.index();
    const std::int64_t times = schedule_.times_around(choice);
    if (known_[index] && (!known_[index]->possible || known_[index]->times == times)) return *known_[index];
    check_work();
    auto fresh = std::make_shared<Known>();
    auto arrivals = schedule_.probe(choice);
    fresh->possible = arrivals.has_value();
    if (arrivals) fresh->arrivals = std::move(*arrivals);
    fresh->times = times;
    learnt_.emplace_back(index, std::move(known_[index]));
    known_[index] = std::move(fresh);
    return *known_[index];
  }

  std::int64_t work() const { return local_work_ + schedule_.work(); }

  void check_work() const {
    if (work() >= work_limit_) throw LimitReached{Status::timeout};
  }

  void forget(std::size_t until) {
    for (; learnt_.size() > until; learnt_.pop_back()) known_[learnt_.back().first] = std::move(learnt_.back().second);
  }

  Cost later(const std::vector<Arrival>& arrivals) const {
    Cost sum = 0;
    for (const Arrival& it : arrivals) sum += std::max(0, it.time - schedule_.arrival(it.robot));
    return sum;
  }

  std::vector<Raise> raises_of(Choice choice) {
    std::vector<Raise> raises;
    for (const Arrival& it : learn(choice).arrivals) {
      const Tick ticks = it.time - schedule_.arrival(it.robot);
      if (ticks > 0) raises.push_back({it.robot, ticks});
    }
    return raises;
  }

  static Cost sum(const std::vector<Raise>& raises) {
    Cost sum = 0;
    for (const Raise& raise : raises) sum += raise.ticks;
    return sum;
  }

  /// Decide what is pending one by one, earliest first, each time as it costs less; keep the order if it is better.
  void dive() {
    const Schedule::Mark mark = schedule_.mark();
    const std::int64_t work = schedule_.work();
    bool possible = true;
    while (possible && !schedule_.pending().empty() && schedule_.cost() < best_) {
      const std::int32_t decision = *std::ranges::min_element(
          schedule_.pending(), {}, [&](std::int32_t it) { return std::pair{schedule_.begins(it), it}; });
      std::array<Cost, 2> more = {kNone, kNone};
      for (const Side side : {Side{0}, Side{1}}) {
        check_work();
        if (const auto arrivals = schedule_.probe({decision, side})) more[side] = later(*arrivals);
      }
      possible = std::min(more[0], more[1]) < kNone;
      if (possible) schedule_.decide({decision, static_cast<Side>(more[1] < more[0])});
    }
    if (possible && schedule_.cost() < best_) keep();
    schedule_.undo(mark);
    dive_work_ += schedule_.work() - work;
  }

  /// Take the order of the present node: decisions made, and for the others a choice that holds.
  void keep() {
    best_ = schedule_.cost();
    result_.switched.assign(graph_.alternatives.size(), 0);
    for (std::size_t k = 0; k < graph_.alternatives.size(); ++k) {
      result_.switched[k] = !schedule_.holds(decisions_.planned(k));
    }
  }

  const AlternativeGraph graph_;
  Limits& limits_;
  std::int64_t work_limit_;
  Decisions decisions_;
  ArcIndex arcs_;
  Schedule schedule_;
  Reordering result_;
  Cost best_ = kNone, bound_ = 0;
  std::int64_t local_work_ = 0, dive_work_ = 0;
  std::vector<std::int32_t> probed_;
  std::vector<Node> nodes_;
  std::vector<Step> path_;
  std::priority_queue<std::tuple<Cost, std::int32_t, std::int32_t>,
                      std::vector<std::tuple<Cost, std::int32_t, std::int32_t>>, std::greater<>>
      open_;
  std::vector<std::shared_ptr<const Known>> known_;
  std::vector<std::pair<std::size_t, std::shared_ptr<const Known>>> learnt_;  // what `known_` held before
};

}  // namespace

Reordering solve_gses(const AlternativeGraph& graph, Limits& limits, std::int64_t work_limit) {
  graph.check();
  return Search(reduced(graph), limits, work_limit).run();
}

}  // namespace mrpbench::mapf
