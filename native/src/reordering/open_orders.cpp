#include "mrpbench_mapf/reordering/open_orders.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

#include "reordering/arc_index.hpp"

namespace mrpbench::mapf {

namespace {

class OpenOrders {
 public:
  OpenOrders(const AlternativeGraph& graph, std::span<const std::int32_t> together)
      : graph_(graph),
        together_(together),
        decisions_(graph),
        arcs_(graph, decisions_),
        planned_(decisions_.planned_sides()),
        is_planned_(arcs_.holding(planned_)),
        open_(decisions_.count()),
        robot_(graph.events()),
        members_(graph.events()),
        position_(graph.events()),
        reached_(graph.robots()),
        search_of_(graph.robots()) {
    for (int robot = 0; robot < graph.robots(); ++robot) {
      std::fill(robot_.begin() + graph.first[robot], robot_.begin() + graph.first[robot + 1], robot);
    }
    for (std::int32_t event = 0; event < graph.events(); ++event) {
      if (together[event] != event) members_[together[event]].push_back(event);
    }
    sort_events();
  }

  std::vector<std::int32_t> run(std::span<const std::int64_t> begin, std::int64_t limit) {
    std::vector<std::int64_t> least(decisions_.count(), std::numeric_limits<std::int64_t>::max());
    for (std::size_t k = 0; k < begin.size(); ++k) {
      std::int64_t& value = least[decisions_.planned(k).decision];
      value = std::min(value, begin[k]);
    }
    std::vector<std::int32_t> order(decisions_.count());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::int32_t decision) { return least[decision]; });
    if (static_cast<std::int64_t>(order.size()) > limit) order.resize(limit);
    for (const std::int32_t decision : order) try_to_open(decision);
    std::vector<std::int32_t> found;
    for (std::size_t k = 0; k < begin.size(); ++k) {
      const std::int32_t decision = decisions_.planned(k).decision;
      found.push_back(open_[decision] ? decision : -1);
    }
    return found;
  }

 private:
  /// Number the events so that all arcs of the plan lead to greater numbers; those together have the same one.
  void sort_events() {
    const std::int32_t events = graph_.events();
    std::vector<std::int32_t> waiting(events), ready;
    const auto for_all_next = [&](std::int32_t event, const auto& visit) {
      const auto follow = [&](std::int32_t from, std::int32_t to) {
        if (together_[from] != together_[to]) visit(together_[to]);
      };
      if (event + 1 < graph_.first[robot_[event] + 1]) follow(event, event + 1);
      for (const std::int32_t arc : arcs_.out(event)) {
        if (is_planned_[arc]) follow(event, arcs_[arc].after);
      }
    };
    for (std::int32_t event = 0; event < events; ++event) {
      for_all_next(event, [&](std::int32_t next) { ++waiting[next]; });
    }
    for (std::int32_t event = 0; event < events; ++event) {
      if (together_[event] == event && waiting[event] == 0) ready.push_back(event);
    }
    std::int32_t count = 0;
    for (std::size_t k = 0; k < ready.size(); ++k) {  // first come, first served: near in the plan is near in number
      const std::int32_t event = ready[k];
      const auto visit = [&](std::int32_t next) {
        if (--waiting[next] == 0) ready.push_back(next);
      };
      position_[event] = ++count;
      for_all_next(event, visit);
      for (const std::int32_t member : members_[event]) {
        position_[member] = count;
        for_all_next(member, visit);
      }
    }
    if (std::ranges::count(position_, 0) > 0) throw std::invalid_argument("the planned order has a cycle");
  }

  void try_to_open(std::int32_t decision) {
    const Choice switched = Choice{decision, planned_[decision]}.other();
    Span own{std::numeric_limits<std::int32_t>::max(), 0};
    for (const Arc& arc : decisions_.arcs(switched)) {
      own.begin = std::min(own.begin, position_[arc.after]);
      own.end = std::max(own.end, position_[arc.before]);
    }
    if (closes_cycle(switched, last_on_the_way_to(own.end))) return;
    open_[decision] = true;
    spans_.push_back(own);
  }

  /// The position beyond which no event leads back to `position`: only open arcs lead back, each within its span.
  std::int32_t last_on_the_way_to(std::int32_t position) const {
    for (bool grows = true; grows;) {
      grows = false;
      for (const Span& span : spans_) {
        if (span.begin > position || span.end <= position) continue;
        position = span.end;
        grows = true;
      }
    }
    return position;
  }

  /// Whether an event at which an arc of a choice begins follows from one at which such an arc ends. Events
  /// beyond the position `last` lead to none of these.
  bool closes_cycle(Choice switched, std::int32_t last) {
    ++search_;
    todo_.clear();
    for (const Arc& arc : decisions_.arcs(switched)) reach(arc.after);
    const auto is_closed = [&] {
      return std::ranges::any_of(decisions_.arcs(switched), [&](const Arc& arc) {
        const std::int32_t robot = robot_[arc.before];
        return search_of_[robot] == search_ && reached_[robot] <= arc.before;
      });
    };
    while (!todo_.empty()) {
      const auto [begin, end] = todo_.back();
      todo_.pop_back();
      for (std::int32_t event = begin; event < end && position_[event] <= last; ++event) {
        for (const std::int32_t other : members_[together_[event]]) reach(other);
        reach(together_[event]);
        for (const std::int32_t arc : arcs_.out(event)) {
          if (arc >= arcs_.first_fixed()) {
            reach(arcs_[arc].after);
            continue;
          }
          const std::int32_t decision = arcs_.choice_of(arc).decision;
          if (decision == switched.decision) continue;
          if (is_planned_[arc] || open_[decision]) reach(arcs_[arc].after);
        }
      }
      if (is_closed()) return true;
    }
    return is_closed();
  }

  /// Note that a robot gets to an event, and thereby to all later ones of its path.
  void reach(std::int32_t event) {
    const std::int32_t robot = robot_[event];
    if (search_of_[robot] != search_) {
      search_of_[robot] = search_;
      reached_[robot] = graph_.first[robot + 1];
    }
    if (event >= reached_[robot]) return;
    todo_.push_back({event, reached_[robot]});
    reached_[robot] = event;
  }

  struct Span {
    std::int32_t begin, end;
  };

  const AlternativeGraph& graph_;
  std::span<const std::int32_t> together_;
  Decisions decisions_;
  ArcIndex arcs_;
  std::vector<Side> planned_;     // by decision
  std::vector<char> is_planned_;  // by arc
  std::vector<char> open_;        // by decision
  std::vector<std::int32_t> robot_;
  std::vector<std::vector<std::int32_t>> members_;  // the other events of a set, by its first one
  std::vector<std::int32_t> position_;
  std::vector<std::int32_t> reached_, search_of_;  // by robot: its earliest event that follows, in which search
  std::vector<Span> spans_;                        // the least and greatest position of the arcs of each open choice
  std::vector<Span> todo_;
  std::int32_t search_ = 0;
};

/// The indices of all pairs of alternative arcs between those robots that have one of the first `limit` groups.
///
/// Each two robots have a group with the least value of all their pairs, so these are among the `limit` two robots of
/// the least value. Of equal values, those of the lower robots come first, as in `Decisions`.
std::vector<std::int32_t> near_pairs(const AlternativeGraph& graph, std::span<const std::int64_t> begin,
                                     std::int64_t limit) {
  struct Robots {
    std::int64_t least;
    std::uint64_t key;
  };
  std::vector<std::uint64_t> robot(graph.events());
  for (int r = 0; r < graph.robots(); ++r) {
    std::fill(robot.begin() + graph.first[r], robot.begin() + graph.first[r + 1], static_cast<std::uint64_t>(r));
  }
  std::vector<Robots> found;
  std::vector<std::int32_t> place_of(begin.size());
  std::unordered_map<std::uint64_t, std::int32_t> place;
  for (std::size_t k = 0; k < begin.size(); ++k) {
    const Arc& arc = graph.alternatives[k].planned;
    const auto [low, high] = std::minmax(robot[arc.before], robot[arc.after]);
    const std::uint64_t key = low << 32 | high;
    const auto [at, is_new] = place.try_emplace(key, static_cast<std::int32_t>(found.size()));
    if (is_new) found.push_back({begin[k], key});
    place_of[k] = at->second;
    found[at->second].least = std::min(found[at->second].least, begin[k]);
  }
  std::vector<std::int32_t> order(found.size());
  std::iota(order.begin(), order.end(), 0);
  const auto count = static_cast<std::size_t>(std::min<std::int64_t>(limit, static_cast<std::int64_t>(order.size())));
  std::ranges::nth_element(order, order.begin() + static_cast<std::ptrdiff_t>(count), {},
                           [&](std::int32_t at) { return std::pair(found[at].least, found[at].key); });
  std::vector<char> is_near(found.size());
  for (std::size_t k = 0; k < count; ++k) is_near[order[k]] = true;
  std::vector<std::int32_t> near;
  for (std::size_t k = 0; k < begin.size(); ++k) {
    if (is_near[place_of[k]]) near.push_back(static_cast<std::int32_t>(k));
  }
  return near;
}

}  // namespace

std::vector<std::int32_t> open_orders(const AlternativeGraph& graph, std::span<const std::int32_t> together,
                                      std::span<const std::int64_t> begin, std::int64_t limit) {
  graph.check();
  const auto inside = [&](std::int32_t event) { return event >= 0 && event < graph.events(); };
  if (static_cast<int>(together.size()) != graph.events() || !std::ranges::all_of(together, inside)) {
    throw std::invalid_argument("together names an event for each event");
  }
  if (begin.size() != graph.alternatives.size()) throw std::invalid_argument("begin has one value for each pair");
  const std::vector<std::int32_t> near = near_pairs(graph, begin, limit);
  AlternativeGraph tried{.first = graph.first, .duration = graph.duration, .fixed = graph.fixed, .alternatives = {}};
  std::vector<std::int64_t> begin_of_tried;
  std::size_t next = 0;
  for (std::size_t k = 0; k < begin.size(); ++k) {
    if (next < near.size() && near[next] == static_cast<std::int32_t>(k)) {
      tried.alternatives.push_back(graph.alternatives[k]);
      begin_of_tried.push_back(begin[k]);
      ++next;
    } else {
      tried.fixed.push_back(graph.alternatives[k].planned);  // they keep their order
    }
  }
  const std::vector<std::int32_t> group = OpenOrders(tried, together).run(begin_of_tried, limit);
  std::vector<std::int32_t> found(begin.size(), -1);
  for (std::size_t k = 0; k < near.size(); ++k) found[near[k]] = group[k];
  return found;
}

}  // namespace mrpbench::mapf
