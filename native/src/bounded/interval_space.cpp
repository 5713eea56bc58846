#include "mrpbench_mapf/bounded/interval_space.hpp"

#include <algorithm>

#include "mrpbench_mapf/solvability.hpp"

namespace mrpbench::mapf {

IntervalConstraints::IntervalConstraints(const Roadmap& roadmap, const Reservations& certain, Limits& limits)
    : certain_(certain), vertex_count_(roadmap.vertex_count()) {
  limits.charge(static_cast<std::size_t>(roadmap.element_count()) * sizeof(std::int32_t));
  head_.assign(roadmap.element_count(), -1);
}

void IntervalConstraints::reset(int robot) {
  robot_ = robot;
  for (const std::int32_t element : touched_) head_[element] = -1;
  touched_.clear();
  entries_.clear();
}

void IntervalConstraints::add(const Constraint& constraint) {
  std::int32_t& head = head_[constraint.element];
  if (head < 0) touched_.push_back(constraint.element);
  entries_.push_back({constraint.range, head});
  head = static_cast<std::int32_t>(entries_.size()) - 1;
}

void IntervalConstraints::at_vertex(int vertex, std::vector<Range>& halves) const {
  list(vertex, halves);
  if (!certain_.empty()) certain_.at_vertex(robot_, vertex, halves);
  if (present_ != nullptr) present_->at_vertex(robot_, vertex, halves);
}

void IntervalConstraints::on_edge(int edge, Tick duration, std::vector<Range>& departures) const {
  list(vertex_count_ + edge, departures);
  if (!certain_.empty()) certain_.on_edge(robot_, edge, duration, departures);
  if (present_ != nullptr) present_->on_edge(robot_, edge, duration, departures);
}

void IntervalConstraints::list(int element, std::vector<Range>& ranges) const {
  for (std::int32_t k = head_[element]; k >= 0; k = entries_[k].next) ranges.push_back(entries_[k].range);
}

IntervalSpace::IntervalSpace(const Instance& instance, const BoundedOptions&, Limits& limits, Statistics& statistics)
    : instance_(instance),
      limits_(limits),
      tables_(instance, limits),
      relations_(instance, limits),
      certain_(instance, relations_, limits),
      present_(instance, relations_, limits),
      paths_(instance.size()),
      constraints_(instance.roadmap(), certain_, limits),
      sipp_(instance, limits, statistics) {
  reserve_beginnings(instance, certain_);
}

std::optional<int> IntervalSpace::find_hopeless() {
  if (const auto robot = find_cut_off_robot(instance_, tables_, limits_)) return robot;
  return find_clash(instance_, relations_, limits_);
}

void IntervalSpace::put(int robot, std::span<const Occupation> path) {
  paths_[robot] = path;
  stale_ = true;
}

const Reservations& IntervalSpace::present() {
  if (!stale_) return present_;
  present_.clear();
  for (int robot = 0; robot < robots(); ++robot) present_.add(robot, paths_[robot]);
  stale_ = false;
  return present_;
}

void IntervalSpace::bind(int robot) {
  robot_ = robot;
  constraints_.reset(robot);
}

Tick IntervalSpace::plan(const CostBound& bound, Tick known, Path& path) {
  constraints_.avoid(nullptr);
  if (!sipp_.search(robot_, tables_[robot_], constraints_, path, &present())) return kForever;
  const Tick least = std::max(known, arrival(path));
  if (!meets_others(path)) return least;
  constraints_.avoid(&present());
  if (sipp_.search(robot_, tables_[robot_], constraints_, around_) && arrival(around_) <= bound(least)) {
    path.swap(around_);
  }
  return least;
}

bool IntervalSpace::meets_others(std::span<const Occupation> path) {
  return std::ranges::any_of(path, [&](const Occupation& step) { return present().count(robot_, step) > 0; });
}

void IntervalSpace::find_conflicts(int robot, std::span<const Occupation> path, std::vector<IntervalConflict>& found) {
  for (std::size_t step = 0; step < path.size(); ++step) {
    limits_.check();
    present().conflicts_of(robot, path[step], [&](const auto& entry, Relation relation) {
      const Half time = std::max(path[step].begin, entry.begin);
      const PairConflict conflict{robot, entry.robot, static_cast<std::int32_t>(step), entry.step, time, relation, 1};
      found.push_back(
          {robot, entry.robot, time, split(conflict, path, paths_[entry.robot], instance_.roadmap().vertex_count())});
    });
  }
}

}  // namespace mrpbench::mapf
