#include "mrpbench_mapf/reordering/alternative_graph.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace mrpbench::mapf {

namespace {

class Checker {
 public:
  explicit Checker(const AlternativeGraph& graph) : graph_(graph), robot_(graph.events()) {
    for (int robot = 0; robot < graph.robots(); ++robot) {
      std::fill(robot_.begin() + graph.first[robot], robot_.begin() + graph.first[robot + 1], robot);
    }
  }

  void arc(const Arc& it, const char* list, std::size_t index) const {
    const auto inside = [&](std::int32_t event) { return event >= 0 && event < graph_.events(); };
    if (!inside(it.before) || !inside(it.after)) fail(list, index, "names an event that does not exist");
    if (robot_[it.before] == robot_[it.after]) fail(list, index, "connects two events of one robot");
    if (it.lag < 1 || it.lag > kLatestTime) fail(list, index, "has a lag below 1 or above 2^28");
  }

  void pair(const Alternatives& it, std::size_t index) const {
    arc(it.planned, "alternatives", index);
    arc(it.switched, "alternatives", index);
    if (robot_[it.planned.before] != robot_[it.switched.after] ||
        robot_[it.planned.after] != robot_[it.switched.before]) {
      fail("alternatives", index, "does not connect the same two robots in both directions");
    }
  }

 private:
  [[noreturn]] static void fail(const char* list, std::size_t index, const char* why) {
    throw std::invalid_argument(std::string(list) + "[" + std::to_string(index) + "] " + why);
  }

  const AlternativeGraph& graph_;
  std::vector<std::int32_t> robot_;
};

}  // namespace

void AlternativeGraph::check() const {
  if (first.empty() || first.front() != 0 || duration.size() != static_cast<std::size_t>(first.back())) {
    throw std::invalid_argument("first begins with 0 and ends with the number of durations");
  }
  for (int robot = 0; robot < robots(); ++robot) {
    if (first[robot + 1] <= first[robot]) {
      throw std::invalid_argument("robot " + std::to_string(robot) + " has no event");
    }
  }
  for (std::size_t event = 0; event < duration.size(); ++event) {
    if (duration[event] < 1 || duration[event] > kLatestTime) {
      throw std::invalid_argument("duration[" + std::to_string(event) + "] is below 1 or above 2^28");
    }
  }
  const Checker checker(*this);
  for (std::size_t k = 0; k < fixed.size(); ++k) checker.arc(fixed[k], "fixed", k);
  for (std::size_t k = 0; k < alternatives.size(); ++k) checker.pair(alternatives[k], k);
}

AlternativeGraph reduced(const AlternativeGraph& graph) {
  AlternativeGraph result{.first = {0}, .duration = {}, .fixed = graph.fixed, .alternatives = graph.alternatives};
  std::vector<char> kept(graph.events());
  const auto for_all_arcs = [](AlternativeGraph& of, const auto& visit) {
    for (Arc& arc : of.fixed) visit(arc);
    for (Alternatives& pair : of.alternatives) visit(pair.planned), visit(pair.switched);
  };
  for_all_arcs(result, [&](const Arc& arc) { kept[arc.before] = kept[arc.after] = true; });
  std::vector<std::int32_t> number(graph.events());
  for (int robot = 0; robot < graph.robots(); ++robot) {
    const std::int32_t begin = graph.first[robot], last = graph.first[robot + 1] - 1;
    kept[begin] = kept[last] = true;
    for (std::int32_t event = begin; event <= last; ++event) {
      if (kept[event]) {
        number[event] = static_cast<std::int32_t>(result.duration.size());
        result.duration.push_back(0);
      }
      result.duration.back() += graph.duration[event];
    }
    result.first.push_back(static_cast<std::int32_t>(result.duration.size()));
  }
  for_all_arcs(result, [&](Arc& arc) { arc.before = number[arc.before], arc.after = number[arc.after]; });
  return result;
}

std::vector<Tick> earliest_times(std::span<const std::int32_t> first, std::span<const Tick> duration,
                                 std::span<const Arc> arcs) {
  const std::int32_t events = first.back();
  std::vector<std::int32_t> begin(events + 1), waiting(events, 1), ready;
  std::vector<char> is_last(events);
  for (const Arc& arc : arcs) {
    ++begin[arc.before + 1];
    ++waiting[arc.after];
  }
  for (std::int32_t event = 0; event < events; ++event) begin[event + 1] += begin[event];
  std::vector<Arc> by_tail(arcs.size());
  for (std::vector<std::int32_t> next = begin; const Arc& arc : arcs) by_tail[next[arc.before]++] = arc;
  for (std::size_t robot = 0; robot + 1 < first.size(); ++robot) {
    is_last[first[robot + 1] - 1] = true;
    if (--waiting[first[robot]] == 0) ready.push_back(first[robot]);
  }
  std::vector<Tick> time(events);
  std::int32_t seen = 0;
  const auto reach = [&](std::int32_t event, Tick at) {
    time[event] = std::max(time[event], at);
    if (--waiting[event] == 0) ready.push_back(event);
  };
  for (; !ready.empty(); ++seen) {
    const std::int32_t event = ready.back();
    ready.pop_back();
    for (std::int32_t k = begin[event]; k < begin[event + 1]; ++k)
      reach(by_tail[k].after, time[event] + by_tail[k].lag);
    if (!is_last[event]) reach(event + 1, time[event] + duration[event]);
  }
  if (seen < events) time.clear();
  return time;
}

Cost cost_of_order(const AlternativeGraph& graph, std::span<const char> switched) {
  std::vector<Arc> arcs = graph.fixed;
  for (std::size_t k = 0; k < graph.alternatives.size(); ++k) {
    arcs.push_back(switched[k] ? graph.alternatives[k].switched : graph.alternatives[k].planned);
  }
  const std::vector<Tick> time = earliest_times(graph.first, graph.duration, arcs);
  if (time.empty() && graph.events() > 0) return -1;
  Cost cost = 0;
  for (int robot = 0; robot < graph.robots(); ++robot) cost += time[graph.first[robot + 1] - 1];
  return cost;
}

}  // namespace mrpbench::mapf
