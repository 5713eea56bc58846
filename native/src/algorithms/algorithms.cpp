#include "mrpbench_mapf/algorithms/algorithms.hpp"

#include <algorithm>
#include <stdexcept>

#include "mrpbench_mapf/algorithms/astar.hpp"
#include "mrpbench_mapf/algorithms/cbs.hpp"
#include "mrpbench_mapf/algorithms/lacam.hpp"
#include "mrpbench_mapf/algorithms/lns.hpp"
#include "mrpbench_mapf/algorithms/pbs.hpp"
#include "mrpbench_mapf/algorithms/pibt.hpp"
#include "mrpbench_mapf/algorithms/prioritized.hpp"

namespace mrpbench::mapf {

namespace {

using Names = std::vector<std::string>;
using Fixed = std::function<bool(const std::string&)>;

Fixed only(Names names) {
  return [names](const std::string& name) { return std::ranges::count(names, name) > 0; };
}

Fixed all_but(Names names) {
  return [names](const std::string& name) { return std::ranges::count(names, name) == 0; };
}

constexpr double kW = 1.2;
constexpr StateOrder kWeighted{.distance_weight = 1.2, .conflict_weight = 20.0};

/// ECBS as published has no techniques.
CbsOptions ecbs() {
  CbsOptions options{.selection = Selection::focal, .w = kW};
  for (const auto& row : CbsOptions::description()) {
    if (row.info.type == OptionInfo::Type::boolean) row.set(options, false);
  }
  return options;
}

CbsOptions eecbs() {
  return {.selection = Selection::explicit_estimation, .w = kW, .incumbent_after = 100'000, .order = kWeighted};
}

/// Without `heuristic`, since focal search rarely needs higher lower bounds, and without the fallback, which supports
/// one assignment only.
CbsOptions assigning(GoalChoice goals) {
  return {.goals = goals, .selection = Selection::focal, .w = kW, .heuristic = false, .order = kWeighted};
}

/// The names of all variants except EECBS decide these options and `more`.
Fixed fixed(Names more) {
  more.insert(more.end(),
              {"goal_choice", "selection", "flex", "incumbent_after", "distance_weight", "conflict_weight"});
  return only(more);
}

std::vector<Algorithm> make_all() {
  return {
      make_algorithm("astar", "Plans every robot alone: shortest paths that may conflict.", solve_astar),
      make_algorithm("cbs", "Finds the least sum of costs by conflict-based search.", solve_cbs, {}, fixed({"w"})),
      make_algorithm("cbs_ta", "Finds the least sum of costs over all assignments, with one tree per assignment.",
                     solve_cbs, {.goals = GoalChoice::ranked}, fixed({"w"})),
      make_algorithm("ecbs", "Finds at most w times the least sum of costs by focal search on both levels.", solve_cbs,
                     ecbs(), all_but({"w"})),
      make_algorithm("ecbs_ta",
                     "Finds at most w times the least sum of costs over all assignments, with one tree per assignment.",
                     solve_cbs, assigning(GoalChoice::ranked), fixed({"heuristic"})),
      make_algorithm("eecbs", "Finds at most w times the least sum of costs by explicit estimation search.", solve_cbs,
                     eecbs(), only({"goal_choice", "selection"})),
      make_algorithm("ita_cbs", "Finds the least sum of costs over all assignments, with a single tree.", solve_cbs,
                     {.goals = GoalChoice::by_node}, fixed({"w", "heuristic"})),
      make_algorithm("ita_ecbs",
                     "Finds at most w times the least sum of costs over all assignments, with a single tree.",
                     solve_cbs, assigning(GoalChoice::by_node), fixed({"heuristic"})),
      make_algorithm("lacam", "Finds a plan soon by a search over configurations, then improves it.", solve_lacam),
      make_algorithm("lns", "Replans groups of robots until there is no conflict, then to improve the plan.",
                     solve_lns),
      make_algorithm("pbs", "Plans robots in turn, by a search over priorities.", solve_pbs),
      make_algorithm("pibt", "Plans all robots tick by tick, by priority inheritance with backtracking.", solve_pibt),
      make_algorithm("prioritized", "Plans robots in turn by safe interval path planning.", solve_prioritized),
  };
}

}  // namespace

const std::vector<Algorithm>& algorithms() {
  static const std::vector<Algorithm> all = make_all();
  return all;
}

const Algorithm& find(const std::vector<Algorithm>& algorithms, const std::string& name) {
  const auto found = std::ranges::find(algorithms, name, &Algorithm::name);
  if (found == algorithms.end()) throw std::invalid_argument("there is no algorithm '" + name + "'");
  return *found;
}

}  // namespace mrpbench::mapf
