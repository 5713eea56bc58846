#include "lacam/configuration_space.hpp"

#include <set>
#include <stdexcept>
#include <string>

#include "lacam/configuration_step.hpp"
#include "lacam/timed_step.hpp"
#include "lacam/timetable.hpp"
#include "mrpbench_mapf/infeasibility/solvability.hpp"
#include "mrpbench_mapf/single_agent/reservations.hpp"

namespace mrpbench::mapf::lacam {

namespace {

/// One motion profile whose moves take one tick, no footprints, resources or commitments, following allowed.
bool has_unit_steps(const Instance& instance) {
  if (instance.size() == 0) return true;
  if (instance.footprints() || !instance.resources().empty() || instance.rules().following_forbidden) return false;
  const int profile = instance.robots().front().profile;
  const auto simple = [&](const Robot& robot) {
    return robot.profile == profile && robot.ready == 0 && robot.committed.empty();
  };
  if (!std::ranges::all_of(instance.robots(), simple)) return false;
  return std::ranges::none_of(instance.roadmap().duration(profile), [](Tick ticks) { return ticks > 1; });
}

}  // namespace

ConfigurationSpace::ConfigurationSpace(const Instance& instance, Limits& limits)
    : instance_(instance), limits_(limits), moves_(instance, limits) {
  if (has_unit_steps(instance)) return;
  relations_.emplace(instance, limits);
  joint_.emplace(instance, *relations_, moves_, limits);
}

bool ConfigurationSpace::misses_no_plan() const {
  return is_unit() || joint_->misses_no_plan();
}

std::optional<std::vector<std::int32_t>> ConfigurationSpace::start() {
  std::vector<std::int32_t> at;
  for (int robot = 0; robot < instance_.size(); ++robot) at.push_back(instance_.beginning(robot).vertex);
  if (joint_ && (!joint_->is_allowed(at.data()) || !beginnings_agree())) return std::nullopt;
  return at;
}

bool ConfigurationSpace::beginnings_agree() const {
  if (std::ranges::all_of(instance_.robots(), [](const Robot& robot) { return robot.committed.empty(); })) return true;
  Reservations reservations(instance_, *relations_, limits_);
  for (int robot = 0; robot < instance_.size(); ++robot) {
    std::vector<Occupation> path = instance_.beginning(robot).occupied;
    path.back().end = kForeverHalf;
    for (const Occupation& occupation : path) {
      if (reservations.count(robot, occupation) > 0) return false;
    }
    reservations.add(robot, path);
  }
  return true;
}

std::unique_ptr<ConfigurationGenerator> ConfigurationSpace::generator(DistanceTables& tables, const GuidePaths* guides,
                                                                      bool swap, std::uint64_t seed, Limits& limits) {
  if (joint_) return std::make_unique<TimedStep>(instance_, moves_, *joint_, tables, swap, seed);
  return std::make_unique<ConfigurationStep>(instance_, moves_, tables, guides, swap, seed, limits);
}

int ConfigurationSpace::steps_within(Tick horizon) const {
  Tick shortest = horizon + 1;
  std::set<int> profiles;
  for (const Robot& robot : instance_.robots()) profiles.insert(robot.profile);
  for (const int profile : profiles) {
    for (const Tick ticks : instance_.roadmap().duration(profile)) {
      if (ticks > 0) shortest = std::min(shortest, ticks);
    }
  }
  return horizon / shortest + (horizon % shortest != 0);
}

std::vector<Path> ConfigurationSpace::paths_of(const std::vector<Configuration>& sequence) {
  if (!joint_) return unit_paths_of(sequence);
  Timetable timetable(instance_, *relations_, *joint_);
  std::vector<std::vector<Move>> rounds;
  for (std::size_t step = 0; step + 1 < sequence.size(); ++step) {
    joint_->rounds(sequence[step], sequence[step + 1], rounds);
    for (const std::vector<Move>& round : rounds) timetable.add(round);
  }
  return std::move(timetable).paths();
}

std::vector<Path> ConfigurationSpace::unit_paths_of(const std::vector<Configuration>& sequence) const {
  const auto ticks = static_cast<Tick>(sequence.size());
  std::vector<Path> paths(instance_.size());
  for (int robot = 0; robot < instance_.size(); ++robot) {
    Path& path = paths[robot];
    std::size_t moves = 0;
    for (Tick tick = 0; tick + 1 < ticks; ++tick) moves += sequence[tick][robot] != sequence[tick + 1][robot];
    path.reserve(2 * moves + 1);
    path.push_back(at_vertex(sequence.front()[robot], 0, 0));
    for (Tick tick = 0; tick + 1 < ticks; ++tick) {
      const std::int32_t tail = sequence[tick][robot], head = sequence[tick + 1][robot];
      if (tail == head) continue;
      path.back().end = 2 * tick;
      path.push_back(on_edge(moves_.vertex_count() + moves_.edge(robot, tail, head), tick, tick + 1));
      path.push_back(at_vertex(head, tick + 1, tick + 1));
    }
    path.back().end = kForeverHalf;
  }
  return paths;
}

bool ConfigurationSpace::prove_unsolvable(DistanceTables& tables, Limits& limits, Result& result) const {
  std::optional<int> culprit = find_cut_off_robot(instance_, tables, limits);
  if (!culprit) culprit = is_unit() ? find_shared_place(instance_, limits) : find_clash(instance_, *relations_, limits);
  if (culprit) {
    result.no_plan_for(*culprit);
  } else {
    result.lower_bound = static_cast<double>(tables.sum_of_costs(instance_));
  }
  return culprit.has_value();
}

bool is_suitable(const Instance& instance) {
  if (instance.rules().disappear_at_goal || instance.rules().k > 0) return false;
  return std::ranges::all_of(instance.robots(), [](const Robot& robot) { return robot.goals.size() == 1; });
}

void require_suitable(const Instance& instance, const char* solver) {
  if (!is_suitable(instance)) {
    throw std::invalid_argument(std::string(solver) + " needs robots with one goal each, where they stay, and k = 0");
  }
}

}  // namespace mrpbench::mapf::lacam
