// Python bindings: arrays in, arrays out. The only file that knows Python; nothing here decides anything.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "mrpbench_mapf/astar.hpp"
#include "mrpbench_mapf/bounded/bounded_cbs.hpp"
#include "mrpbench_mapf/cbs.hpp"
#include "mrpbench_mapf/lacam.hpp"
#include "mrpbench_mapf/lns.hpp"
#include "mrpbench_mapf/pbs.hpp"
#include "mrpbench_mapf/pibt.hpp"
#include "mrpbench_mapf/prioritized.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using namespace mrpbench::mapf;

namespace {

template <class T>
using Vector = nb::ndarray<const T, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
template <class T, int columns>
using Matrix = nb::ndarray<const T, nb::shape<-1, columns>, nb::c_contig, nb::device::cpu>;
template <class T>
using Output = nb::ndarray<nb::numpy, const T, nb::ndim<1>>;
using Points = nb::ndarray<nb::numpy, const double, nb::shape<-1, 3>>;

template <class T, class Array>
std::vector<T> copy(const Array& array) {
  return {array.data(), array.data() + array.size()};
}

/// A read-only view; as the value of a property it keeps its owner alive.
template <class T>
Output<T> view(const std::vector<T>& values) {
  return Output<T>(values.data(), {values.size()});
}

Tick tick(std::int64_t value) {
  if (value < -1 || value > kLatestTime) throw std::invalid_argument("times are at most 2^28 ticks");
  return static_cast<Tick>(value);
}

/// Rows [first[i], first[i+1]) of lists that are stored one after another.
void require_rows(const Vector<std::int64_t>& first, std::size_t rows, std::size_t size, const char* name) {
  bool sound =
      first.size() == rows + 1 && first.data()[0] == 0 && first.data()[rows] == static_cast<std::int64_t>(size);
  for (std::size_t i = 0; sound && i < rows; ++i) sound = first.data()[i] <= first.data()[i + 1];
  if (!sound) throw std::invalid_argument(std::string(name) + " does not fit");
}

void require_size(std::size_t size, std::size_t wanted, const char* name) {
  if (size != wanted) throw std::invalid_argument(std::string(name) + " has the wrong length");
}

Roadmap make_roadmap(const Matrix<double, 2>& position, const Matrix<std::int32_t, 2>& edges,
                     const nb::ndarray<const std::int32_t, nb::ndim<2>, nb::c_contig, nb::device::cpu>& duration) {
  require_size(duration.shape(1), edges.shape(0), "duration");
  std::vector<int> tail, head;
  tail.reserve(edges.shape(0));
  head.reserve(edges.shape(0));
  for (std::size_t e = 0; e < edges.shape(0); ++e) {
    tail.push_back(edges.data()[2 * e]);
    head.push_back(edges.data()[2 * e + 1]);
  }
  std::vector<Point> points;
  points.reserve(position.shape(0));
  for (std::size_t v = 0; v < position.shape(0); ++v) {
    points.push_back({position.data()[2 * v], position.data()[2 * v + 1]});
  }
  return Roadmap(static_cast<int>(position.shape(0)), std::move(tail), std::move(head), copy<Tick>(duration),
                 std::move(points));
}

void construct(Instance* self, const Matrix<double, 2>& position, const Matrix<std::int32_t, 2>& edges,
               const nb::ndarray<const std::int32_t, nb::ndim<2>, nb::c_contig, nb::device::cpu>& duration,
               const Vector<std::int32_t>& profile, const Vector<double>& radius, const Vector<std::int32_t>& start,
               const Vector<std::int64_t>& ready, const Vector<std::int64_t>& goal_first,
               const Vector<std::int32_t>& goal, const Vector<std::int64_t>& committed_first,
               const Vector<std::int32_t>& committed_edge, const Vector<std::int64_t>& committed_enter,
               const Vector<std::int64_t>& committed_leave, const Vector<std::int64_t>& exclusion_first,
               const Vector<std::int32_t>& exclusion_element, const Vector<double>& exclusion_distance,
               const Vector<std::int64_t>& resource_first, const Vector<std::int32_t>& resource_element,
               const Vector<std::int32_t>& resource_capacity, const Vector<std::int64_t>& resource_setup,
               bool following_forbidden, bool disappear_at_goal) {
  const std::size_t count = start.size();
  require_size(profile.size(), count, "profile");
  require_size(radius.size(), count, "radius");
  require_size(ready.size(), count, "ready");
  require_rows(goal_first, count, goal.size(), "goal_first");
  require_rows(committed_first, count, committed_edge.size(), "committed_first");
  require_size(committed_enter.size(), committed_edge.size(), "committed_enter");
  require_size(committed_leave.size(), committed_edge.size(), "committed_leave");
  std::vector<Robot> robots(count);
  for (std::size_t r = 0; r < count; ++r) {
    robots[r].profile = profile.data()[r];
    robots[r].radius = radius.data()[r];
    robots[r].start = start.data()[r];
    robots[r].ready = tick(ready.data()[r]);
    robots[r].goals.assign(goal.data() + goal_first.data()[r], goal.data() + goal_first.data()[r + 1]);
    for (auto k = committed_first.data()[r]; k < committed_first.data()[r + 1]; ++k) {
      robots[r].committed.push_back(
          {committed_edge.data()[k], tick(committed_enter.data()[k]), tick(committed_leave.data()[k])});
    }
  }
  require_rows(resource_first, resource_capacity.size(), resource_element.size(), "resource_first");
  require_size(resource_setup.size(), resource_capacity.size(), "resource_setup");
  std::vector<Resource> resources(resource_capacity.size());
  for (std::size_t r = 0; r < resources.size(); ++r) {
    const auto* const elements = resource_element.data();
    resources[r] = {resource_capacity.data()[r],
                    tick(resource_setup.data()[r]),
                    {elements + resource_first.data()[r], elements + resource_first.data()[r + 1]}};
  }
  new (self) Instance(
      make_roadmap(position, edges, duration), std::move(robots), {following_forbidden, disappear_at_goal},
      {copy<std::int64_t>(exclusion_first), copy<std::int32_t>(exclusion_element), copy<double>(exclusion_distance)},
      std::move(resources));
}

/// A result as Python sees it.
struct Answer {
  Result result;
  std::vector<std::int64_t> first{0}, enter, leave;
  std::vector<std::int32_t> edge;

  Answer(const Instance& instance, Result solved) : result(std::move(solved)) {
    for (std::size_t robot = 0; robot < result.paths.size(); ++robot) {
      for (const Segment& segment : segments(instance, static_cast<int>(robot), result.paths[robot])) {
        edge.push_back(segment.edge);
        enter.push_back(segment.enter);
        leave.push_back(segment.leave);
      }
      first.push_back(static_cast<std::int64_t>(edge.size()));
    }
  }

  const char* status() const {
    switch (result.status) {
      case Status::solved:
        return "solved";
      case Status::timeout:
        return "timeout";
      case Status::out_of_memory:
        return "out_of_memory";
      case Status::unsolvable:
        return "unsolvable";
      case Status::gave_up:
        break;
    }
    return "gave_up";
  }

  nb::dict statistics() const {
    const Statistics& it = result.statistics;
    nb::dict values;
    values["expansions"] = it.expansions;
    values["generated"] = it.generated;
    values["low_level_expansions"] = it.low_level_expansions;
    values["low_level_generated"] = it.low_level_generated;
    values["bypasses"] = it.bypasses;
    values["pair_expansions"] = it.pair_expansions;
    values["memory_bytes"] = it.memory_bytes;
    values["assignments"] = it.assignments;
    values["restarts"] = it.restarts;
    values["failed_robot"] = it.failed_robot;
    return values;
  }
};

Points history(const Answer& it) {
  static_assert(sizeof(Progress) == 3 * sizeof(double));
  const auto* first = reinterpret_cast<const double*>(it.result.history.data());  // null where it is empty
  return Points(first, {it.result.history.size(), 3});
}

template <class T>
T choose(const std::map<std::string, T>& choices, const std::string& name) {
  const auto place = choices.find(name);
  if (place != choices.end()) return place->second;
  std::string known;
  for (const auto& [choice, _] : choices) known += (known.empty() ? "" : ", ") + choice;
  throw std::invalid_argument("'" + name + "' is none of: " + known);
}

/// NaN is not within.
template <class T>
void require_within(T value, T least, T most, const char* name) {
  if (value >= least && value <= most) return;
  std::ostringstream fault;
  fault << name << " is from " << least << " to " << most << ", not " << value;
  throw std::invalid_argument(fault.str());
}

template <class T>
void require_at_least(T value, T least, const char* name) {
  if (value < least) throw std::invalid_argument(std::string(name) + " is at least " + std::to_string(least));
}

Answer astar(const Instance& instance, const std::string& heuristic, double wall_s, std::int64_t memory_bytes) {
  static const std::map<std::string, Heuristic> choices{{"exact", Heuristic::exact},
                                                        {"zero", Heuristic::zero},
                                                        {"manhattan", Heuristic::manhattan},
                                                        {"octile", Heuristic::octile},
                                                        {"euclidean", Heuristic::euclidean}};
  const Heuristic choice = choose(choices, heuristic);
  nb::gil_scoped_release without_python;
  Limits limits(wall_s, memory_bytes);
  return {instance, solve_astar(instance, choice, limits)};
}

Answer prioritized(const Instance& instance, const std::string& order, int restarts, std::uint64_t seed, double wall_s,
                   std::int64_t memory_bytes) {
  static const std::map<std::string, Order> choices{{"index", Order::index},
                                                    {"longest_first", Order::longest_first},
                                                    {"shortest_first", Order::shortest_first},
                                                    {"random", Order::random}};
  require_at_least(restarts, 0, "restarts");
  const PrioritizedOptions options{choose(choices, order), restarts, seed};
  nb::gil_scoped_release without_python;
  Limits limits(wall_s, memory_bytes);
  return {instance, solve_prioritized(instance, options, limits)};
}

GoalChoice goal_choice_of(const std::string& name) {
  static const std::map<std::string, GoalChoice> choices{
      {"own", GoalChoice::own}, {"ranked", GoalChoice::ranked}, {"by_node", GoalChoice::by_node}};
  return choose(choices, name);
}

Answer cbs(const Instance& instance, const std::string& goal_choice, bool prioritize, bool bypass, bool heuristic,
           bool target, bool corridor, bool rectangle, double wall_s, std::int64_t memory_bytes) {
  const CbsOptions options{.goals = goal_choice_of(goal_choice),
                           .prioritize = prioritize,
                           .bypass = bypass,
                           .heuristic = heuristic,
                           .target = target,
                           .corridor = corridor,
                           .rectangle = rectangle};
  nb::gil_scoped_release without_python;
  Limits limits(wall_s, memory_bytes);
  return {instance, solve_cbs(instance, options, limits)};
}

Answer bounded_cbs(const Instance& instance, const std::string& goal_choice, const std::string& selection, double w,
                   bool prioritize, bool bypass, bool heuristic, bool target, bool corridor, bool rectangle, bool flex,
                   std::optional<std::int64_t> incumbent_after, double distance_weight, double conflict_weight,
                   double wall_s, std::int64_t memory_bytes) {
  static const std::map<std::string, Selection> choices{{"focal", Selection::focal},
                                                        {"explicit_estimation", Selection::explicit_estimation}};
  require_within(w, 1.0, 1e9, "w");
  require_within(distance_weight, 1.0, 1e3, "distance_weight");
  require_within(conflict_weight, 0.0, 1e6, "conflict_weight");
  if (incumbent_after) require_at_least<std::int64_t>(*incumbent_after, 0, "incumbent_after");
  const BoundedOptions options{.w = w,
                               .selection = choose(choices, selection),
                               .techniques = {.goals = goal_choice_of(goal_choice),
                                              .prioritize = prioritize,
                                              .bypass = bypass,
                                              .heuristic = heuristic,
                                              .target = target,
                                              .corridor = corridor,
                                              .rectangle = rectangle},
                               .flex = flex,
                               .incumbent_after = incumbent_after,
                               .distance_weight = distance_weight,
                               .conflict_weight = conflict_weight};
  nb::gil_scoped_release without_python;
  Limits limits(wall_s, memory_bytes);
  return {instance, solve_bounded(instance, options, limits)};
}

Answer pbs(const Instance& instance, double wall_s, std::int64_t memory_bytes) {
  nb::gil_scoped_release without_python;
  Limits limits(wall_s, memory_bytes);
  return {instance, solve_pbs(instance, limits)};
}

Answer pibt(const Instance& instance, bool swap, int steps, std::uint64_t seed, double wall_s,
            std::int64_t memory_bytes) {
  require_at_least(steps, 0, "steps");
  nb::gil_scoped_release without_python;
  Limits limits(wall_s, memory_bytes);
  return {instance, solve_pibt(instance, {swap, steps, seed}, limits)};
}

Objective objective_of(const std::string& name) {
  static const std::map<std::string, Objective> choices{{"flowtime", Objective::flowtime},
                                                        {"makespan", Objective::makespan}};
  return choose(choices, name);
}

Answer lacam(const Instance& instance, const std::string& objective, bool swap, bool prioritized, bool guides,
             bool star, bool neighbourhoods, std::optional<std::int64_t> iterations, std::uint64_t seed, double wall_s,
             std::int64_t memory_bytes) {
  if (iterations) require_at_least<std::int64_t>(*iterations, 0, "iterations");
  const LacamOptions options{objective_of(objective), swap,       prioritized, guides, star,
                             neighbourhoods,          iterations, seed};
  nb::gil_scoped_release without_python;
  Limits limits(wall_s, memory_bytes);
  return {instance, solve_lacam(instance, options, limits)};
}

Answer lns(const Instance& instance, const std::string& objective, const std::string& initial,
           std::optional<int> neighbourhood, std::optional<std::int64_t> iterations, std::uint64_t seed, double wall_s,
           std::int64_t memory_bytes) {
  static const std::map<std::string, Initial> choices{
      {"repair", Initial::repair}, {"lacam", Initial::lacam}, {"either", Initial::either}};
  if (iterations) require_at_least<std::int64_t>(*iterations, 0, "iterations");
  if (neighbourhood) require_at_least(*neighbourhood, 1, "neighbourhood");
  const LnsOptions options{objective_of(objective), choose(choices, initial), neighbourhood, iterations, seed};
  nb::gil_scoped_release without_python;
  Limits limits(wall_s, memory_bytes);
  return {instance, solve_lns(instance, options, limits)};
}

}  // namespace

NB_MODULE(mapf, module) {
  // Arrays come with the right type: converting would wrap numbers that are too large.
  const auto array = [](const char* name) { return nb::arg(name).noconvert(); };
  module.doc() = "Multi-agent path finding in C++. Plain arrays in, plain arrays out.";

  nb::class_<Instance>(
      module, "Instance",
      "Robots on a roadmap. Raises ValueError for data that make no sense. Lists of several robots are "
      "stored one after another: those of robot r are [first[r], first[r + 1]).")
      .def("__init__", &construct, nb::kw_only(), array("position"), array("edges"), array("duration"),
           array("profile"), array("radius"), array("start"), array("ready"), array("goal_first"), array("goal"),
           array("committed_first"), array("committed_edge"), array("committed_enter"), array("committed_leave"),
           array("exclusion_first"), array("exclusion_element"), array("exclusion_distance"), array("resource_first"),
           array("resource_element"), array("resource_capacity"), array("resource_setup"), "following_forbidden"_a,
           "disappear_at_goal"_a);

  nb::class_<Answer>(module, "Answer", "How a solver ended. The segments of robot r are [first[r], first[r + 1]).")
      .def_prop_ro("status", &Answer::status, "solved, timeout, out_of_memory, unsolvable or gave_up.")
      .def_prop_ro(
          "lower_bound", [](const Answer& it) { return it.result.lower_bound; },
          "Proved lower bound on the sum of arrival times in ticks, NaN if none.")
      .def_prop_ro("statistics", &Answer::statistics, "Counters; failed_robot is -1 where no robot is to blame.")
      .def_prop_ro(
          "clock_bound", [](const Answer& it) { return it.result.clock_bound; },
          "The clock ended the search for a better plan.")
      .def_prop_ro("history", &history, "f8[...,3]: seconds, cost of the best plan until then, lower bound.")
      .def_prop_ro(
          "first", [](const Answer& it) { return view(it.first); }, "i8[n+1], or [0] without a plan.")
      .def_prop_ro(
          "edge", [](const Answer& it) { return view(it.edge); }, "i4[...], -1 = wait.")
      .def_prop_ro(
          "enter", [](const Answer& it) { return view(it.enter); }, "i8[...] ticks.")
      .def_prop_ro("leave", [](const Answer& it) { return view(it.leave); }, "i8[...] ticks.");

  module.def("astar", &astar, "instance"_a, nb::kw_only(), "heuristic"_a, "wall_s"_a, "memory_bytes"_a,
             "Every robot alone: shortest paths that may conflict.");
  module.def("prioritized", &prioritized, "instance"_a, nb::kw_only(), "order"_a, "restarts"_a, "seed"_a, "wall_s"_a,
             "memory_bytes"_a, "One robot after another by safe interval path planning.");
  module.def(
      "cbs", &cbs, "instance"_a, nb::kw_only(), "goal_choice"_a = "own", "prioritize"_a = true, "bypass"_a = true,
      "heuristic"_a = true, "target"_a = true, "corridor"_a = true, "rectangle"_a = true, "wall_s"_a, "memory_bytes"_a,
      "The least sum of arrival times, by conflict-based search. goal_choice: own (each robot takes any of its), "
      "ranked "
      "or by_node (all take different ones, by trees for the cheapest assignments or by an assignment in each node).");
  module.def("bounded_cbs", &bounded_cbs, "instance"_a, nb::kw_only(), "goal_choice"_a = "own", "selection"_a, "w"_a,
             "prioritize"_a, "bypass"_a, "heuristic"_a, "target"_a, "corridor"_a, "rectangle"_a, "flex"_a,
             "incumbent_after"_a, "distance_weight"_a, "conflict_weight"_a, "wall_s"_a, "memory_bytes"_a,
             "At most w times the least sum of arrival times, by bounded-suboptimal conflict-based search.");
  module.def("pbs", &pbs, "instance"_a, nb::kw_only(), "wall_s"_a, "memory_bytes"_a,
             "One robot after another, by a search over who comes before whom.");
  module.def("pibt", &pibt, "instance"_a, nb::kw_only(), "swap"_a, "steps"_a, "seed"_a, "wall_s"_a, "memory_bytes"_a,
             "Tick by tick, by priority inheritance. Unit moves only.");
  module.def("lacam", &lacam, "instance"_a, nb::kw_only(), "objective"_a, "swap"_a, "prioritized"_a, "guides"_a,
             "star"_a, "neighbourhoods"_a, "iterations"_a.none(), "seed"_a, "wall_s"_a, "memory_bytes"_a,
             "A plan soon, by a search over configurations, and better ones later. Unit moves only.");
  module.def("lns", &lns, "instance"_a, nb::kw_only(), "objective"_a, "initial"_a, "neighbourhood"_a.none(),
             "iterations"_a.none(), "seed"_a, "wall_s"_a, "memory_bytes"_a,
             "Plans groups of robots anew until there is no conflict, then for better plans.");
}
