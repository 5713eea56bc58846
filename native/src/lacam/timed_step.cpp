#include "lacam/timed_step.hpp"

namespace mrpbench::mapf::lacam {

TimedStep::TimedStep(const Instance& instance, const Moves& moves, JointMoves& joint, DistanceTables& tables, bool swap,
                     std::uint64_t seed)
    : instance_(instance),
      moves_(moves),
      joint_(joint),
      random_(seed),
      now_(instance.roadmap().element_count(), -1),
      claimed_(instance.roadmap().element_count(), -1),
      displacing_(instance.size()) {
  if (swap) swap_.emplace(instance, moves, tables);
  for (int robot = 0; robot < instance.size(); ++robot) distance_.push_back(&tables[robot]);
}

bool TimedStep::operator()(const std::int32_t* from, const std::int32_t* order, std::int32_t* to) {
  from_ = from;
  to_ = to;
  const int robots = instance_.size();
  for (int robot = 0; robot < robots; ++robot) now_[from[robot]] = robot;
  bool complete = settle_fixed();
  for (int k = 0; complete && k < robots; ++k) complete = to[order[k]] >= 0 || move(order[k], 0);
  for (int robot = 0; robot < robots; ++robot) {
    now_[from[robot]] = -1;
    if (to[robot] >= 0) unsettle(move_of(robot));
  }
  return complete && joint_.rounds(from, to, rounds_);
}

/// What is asked for, unless it conflicts.
bool TimedStep::settle_fixed() {
  std::vector<int> displaced;
  for (int robot = 0; robot < instance_.size(); ++robot) {
    if (to_[robot] < 0) continue;
    const Move move = move_of(robot);
    if (!fits(move, displaced)) return false;
    settle(move);
  }
  return true;
}

void TimedStep::settle(const Move& move) {
  to_[move.robot] = move.to;
  if (move.edge >= 0) claimed_[move.edge] = claimed_[move.to] = move.robot;
}

void TimedStep::unsettle(const Move& move) {
  if (move.edge < 0) return;
  for (const std::int32_t element : {move.edge, move.to}) {
    if (claimed_[element] == move.robot) claimed_[element] = -1;
  }
}

bool TimedStep::move(int robot, int depth) {
  const std::int32_t here = from_[robot];
  if (depth > kDeepest) {
    to_[robot] = here;
    return false;
  }
  std::vector<Candidate> candidates = rank(robot);
  const int partner = swap_ ? swap_->partner(robot, here, candidates.front().vertex, now_, to_) : -1;
  if (partner >= 0) std::ranges::reverse(candidates);
  std::vector<int> displaced;
  for (const Candidate& candidate : candidates) {
    const Move move = joint_.move(robot, here, candidate.vertex);
    to_[robot] = -1;
    if (!fits(move, displaced)) continue;
    settle(move);
    if (!displace(move, displaced, depth)) {
      unsettle(move);
      continue;
    }
    if (partner >= 0 && candidate.vertex == candidates.front().vertex && to_[partner] < 0) {
      const Move pull = joint_.move(partner, from_[partner], here);
      if (fits(pull, displaced) && displaced.empty()) settle(pull);
    }
    return true;
  }
  // All that was tried is taken by now; the robot that displaces this one has to look elsewhere.
  to_[robot] = here;
  return false;
}

/// Neighbours that are nearer to the goal, then the present vertex, then the others; of these the fastest way first,
/// equals in random order.
std::vector<TimedStep::Candidate> TimedStep::rank(int robot) {
  DistanceTable& distance = *distance_[robot];
  const std::int32_t here = from_[robot];
  const std::span<const Tick> duration = instance_.roadmap().duration(instance_.robots()[robot].profile);
  std::vector<Candidate> candidates;
  std::uint64_t ties = random_();
  const auto add = [&](std::uint64_t kind, std::uint64_t ticks, std::int32_t vertex) {
    candidates.push_back({kind << 40 | ticks << 4 | (ties & 15), vertex});
    ties = ties >> 4 | ties << 60;
  };
  for (const std::int32_t vertex : moves_.successors(robot, here)) {
    const auto to_go = static_cast<std::uint64_t>(std::min(distance(vertex), kLatestTime));
    const auto ticks = static_cast<std::uint64_t>(duration[moves_.edge(robot, here, vertex)]);
    add(distance(vertex) < distance(here) ? 0 : 2, ticks + to_go, vertex);
  }
  add(1, 0, here);
  std::ranges::sort(candidates, {}, &Candidate::key);
  return candidates;
}

/// Can the move be made beside all that are settled? Lists the robots that it displaces, which are not.
bool TimedStep::fits(const Move& move, std::vector<int>& displaced) const {
  displaced.clear();
  for (const std::int32_t element : {move.from, move.edge, move.to}) {
    if (element < 0) continue;
    for (const JointMoves::Excluded& it : joint_.excluded(element)) {
      const std::int32_t mover = claimed_[it.element];
      if (mover >= 0 && mover != move.robot && !fits_beside(move, mover)) return false;
      const std::int32_t there = now_[it.element];
      if (there < 0 || there == move.robot || element == move.from || !joint_.applies(it, move.robot, there)) continue;
      if (to_[there] >= 0) {
        if (!fits_beside(move, there)) return false;
      } else if (std::ranges::find(displaced, there) == displaced.end()) {
        displaced.push_back(there);
      }
    }
  }
  return fits_roomy(move, displaced);
}

/// Those that are displaced go before, or with, the robot that displaces them.
bool TimedStep::fits_beside(const Move& move, int other) const {
  const Move beside = move_of(other);
  if (joint_.fit_together(move, beside) || joint_.fit_in_turn(move, beside)) return true;
  return !displacing_[other] && joint_.fit_in_turn(beside, move);
}

bool TimedStep::fits_roomy(const Move& move, std::vector<int>& displaced) const {
  for (const std::int32_t resource : joint_.roomy()) {
    const auto enters = [&](const Move& it) { return joint_.uses(it.edge, resource) || joint_.uses(it.to, resource); };
    if (joint_.uses(move.from, resource) || !enters(move)) continue;
    int settled = 0;
    std::vector<int> inside;
    for (int robot = 0; robot < instance_.size(); ++robot) {
      if (robot == move.robot) continue;
      if (to_[robot] >= 0) {
        settled += enters(move_of(robot));
      } else if (joint_.uses(from_[robot], resource)) {
        inside.push_back(robot);
      }
    }
    const int capacity = instance_.resources()[resource].capacity;
    if (settled >= capacity) return false;
    for (int k = 0; k < settled + static_cast<int>(inside.size()) + 1 - capacity; ++k) {
      if (std::ranges::find(displaced, inside[k]) == displaced.end()) displaced.push_back(inside[k]);
    }
  }
  return true;
}

/// Let all these go elsewhere; false if one of them cannot.
bool TimedStep::displace(const Move& move, const std::vector<int>& displaced, int depth) {
  displacing_[move.robot] = true;
  const bool done = std::ranges::all_of(displaced, [&](int other) {
    if (to_[other] < 0 && !this->move(other, depth + 1)) return false;
    return fits_beside(move_of(other), move.robot);
  });
  displacing_[move.robot] = false;
  return done;
}

}  // namespace mrpbench::mapf::lacam
