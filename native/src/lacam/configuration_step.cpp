#include "lacam/configuration_step.hpp"

#include <algorithm>

namespace mrpbench::mapf::lacam {

ConfigurationStep::ConfigurationStep(const Instance& instance, const Moves& moves, DistanceTables& tables,
                                     const GuidePaths* guides, bool swap, std::uint64_t seed, Limits& limits)
    : moves_(moves),
      robots_(instance.size()),
      guide_paths_(guides),
      random_(seed),
      most_candidates_(moves.most_successors() + 1) {
  if (swap) swap_.emplace(instance, moves, tables);
  limits.charge(static_cast<std::size_t>(robots_) * most_candidates_ * sizeof(Candidate) +
                static_cast<std::size_t>(moves.vertex_count()) * 2 * sizeof(std::int32_t));
  candidates_.resize(static_cast<std::size_t>(robots_) * most_candidates_);
  now_.assign(moves.vertex_count(), -1);
  next_.assign(moves.vertex_count(), -1);
  for (int robot = 0; robot < robots_; ++robot) distance_.push_back(&tables[robot]);
}

bool ConfigurationStep::operator()(const std::int32_t* from, const std::int32_t* order, std::int32_t* to) {
  from_ = from;
  to_ = to;
  for (int robot = 0; robot < robots_; ++robot) now_[from[robot]] = robot;
  bool complete = reserve_fixed();
  for (int k = 0; complete && k < robots_; ++k) complete = to[order[k]] >= 0 || move(order[k], 0);
  for (int robot = 0; robot < robots_; ++robot) {
    now_[from[robot]] = -1;
    if (to[robot] >= 0) next_[to[robot]] = -1;
  }
  return complete;
}

/// What is asked for, unless it conflicts.
bool ConfigurationStep::reserve_fixed() {
  for (int robot = 0; robot < robots_; ++robot) {
    const std::int32_t vertex = to_[robot];
    if (vertex < 0) continue;
    const std::int32_t there = now_[vertex];
    if (next_[vertex] >= 0 || (there >= 0 && there != robot && to_[there] == from_[robot])) return false;
    next_[vertex] = robot;
  }
  return true;
}

bool ConfigurationStep::move(int robot, int depth) {
  if (depth > kDeepest) {
    settle(robot, from_[robot]);
    return false;
  }
  Candidate* candidates = &candidates_[static_cast<std::size_t>(robot) * most_candidates_];
  const int count = rank(robot, candidates);
  const std::int32_t here = from_[robot];
  const int partner = swap_ ? swap_->partner(robot, here, candidates[0].vertex, now_, to_) : -1;
  if (partner >= 0) std::reverse(candidates, candidates + count);
  for (int k = 0; k < count; ++k) {
    const std::int32_t vertex = candidates[k].vertex;
    if (next_[vertex] >= 0) continue;
    const std::int32_t there = now_[vertex];
    if (there >= 0 && to_[there] == here) continue;  // they would swap places
    settle(robot, vertex);
    if (there >= 0 && there != robot && to_[there] < 0 && !move(there, depth + 1)) continue;
    if (k == 0 && partner >= 0 && to_[partner] < 0 && next_[here] < 0) settle(partner, here);
    return true;
  }
  // All that was tried is taken by now; the robot that inherited from here has to look elsewhere.
  settle(robot, here);
  return false;
}

/// Neighbours and the present vertex, nearest to the goal first, equals in random order.
int ConfigurationStep::rank(int robot, Candidate* candidates) {
  DistanceTable& distance = *distance_[robot];
  std::uint64_t ties = random_();
  int count = 0;
  const std::int32_t guided = guide_paths_ == nullptr ? -1 : guide_paths_->next(robot, from_[robot]);
  const auto add = [&](std::int32_t vertex) {
    const auto tie = static_cast<std::uint32_t>(ties & 15);
    ties = ties >> 4 | ties << 60;
    const Candidate candidate{
        vertex == guided ? 0 : (static_cast<std::uint32_t>(std::min(distance(vertex), kLatestTime - 1)) + 1) << 4 | tie,
        vertex};
    int place = count++;
    for (; place > 0 && candidates[place - 1].key > candidate.key; --place) candidates[place] = candidates[place - 1];
    candidates[place] = candidate;
  };
  for (const std::int32_t vertex : moves_.successors(robot, from_[robot])) add(vertex);
  add(from_[robot]);
  return count;
}

}  // namespace mrpbench::mapf::lacam
