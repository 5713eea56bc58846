#include "lacam/joint_moves.hpp"

#include <algorithm>

namespace mrpbench::mapf::lacam {

namespace {

/// The sums of the two least and of the two greatest radii.
std::pair<double, double> reaches(const Instance& instance) {
  std::vector<double> radius;
  for (const Robot& robot : instance.robots()) radius.push_back(robot.radius);
  std::ranges::sort(radius);
  if (radius.size() < 2 || !instance.footprints()) return {0.0, 0.0};
  return {radius[0] + radius[1] - 1e-9, radius[radius.size() - 1] + radius[radius.size() - 2] - 1e-9};
}

void sort_and_unite(std::vector<JointMoves::Excluded>& row) {
  std::ranges::sort(row, {}, &JointMoves::Excluded::element);
  std::size_t kept = 0;
  for (const JointMoves::Excluded& it : row) {
    if (kept > 0 && row[kept - 1].element == it.element) {
      row[kept - 1].distance = std::min(row[kept - 1].distance, it.distance);
      row[kept - 1].delayed |= it.delayed;
    } else {
      row[kept++] = it;
    }
  }
  row.resize(kept);
}

}  // namespace

JointMoves::JointMoves(const Instance& instance, const Relations& relations, const Moves& moves, Limits& limits)
    : instance_(instance), moves_(moves), moving_(instance.size()) {
  const int elements = instance.roadmap().element_count();
  for (std::size_t resource = 0; resource < instance.resources().size(); ++resource) {
    if (instance.resources()[resource].capacity > 1) roomy_.push_back(static_cast<std::int32_t>(resource));
  }
  const double reach = reaches(instance).second;
  std::size_t counted = 0;
  first_.push_back(0);
  for (int element = 0; element < elements; ++element) {
    limits.check();
    add_excluded(relations, element, reach);
    limits.charge_growth(counted, excluded_.capacity() * sizeof(Excluded));
  }
  limits.charge(static_cast<std::size_t>(elements) * (sizeof(std::size_t) + 2 * sizeof(std::int32_t)));
  standing_.assign(elements, -1);
  claimed_.assign(elements, -1);
}

void JointMoves::add_excluded(const Relations& relations, int element, double reach) {
  std::vector<Excluded> row;
  for (const Near& near : relations.row(element)) {
    if (near.distance < reach) row.push_back({near.element, near.distance, false});
  }
  for (const std::int32_t resource : instance_.resources_of(element)) {
    const Resource& it = instance_.resources()[resource];
    if (it.capacity > 1) continue;
    for (const int other : it.elements) row.push_back({other, -1.0, it.setup > 0});
  }
  sort_and_unite(row);
  excluded_.insert(excluded_.end(), row.begin(), row.end());
  first_.push_back(excluded_.size());
}

Move JointMoves::move(int robot, int from, int to) const {
  if (from == to) return {robot, from, -1, to};
  return {robot, from, moves_.vertex_count() + moves_.edge(robot, from, to), to};
}

bool JointMoves::excludes(int one, int element, int other, int other_element) const {
  const auto row = excluded(element);
  const auto place = std::ranges::lower_bound(row, other_element, {}, &Excluded::element);
  return place != row.end() && place->element == other_element && applies(*place, one, other);
}

/// Tell whether a robot at `vertex` is in the way of the move or at its end.
bool JointMoves::is_in_way(const Move& move, int other, int vertex) const {
  return excludes(move.robot, move.to, other, vertex) ||
         (move.edge >= 0 && excludes(move.robot, move.edge, other, vertex));
}

/// Tell whether the move must be in a later round than the move of a robot that leaves `vertex`.
bool JointMoves::delays(const Move& move, int vertex) const {
  const auto is_delayed = [&](int element) {
    const auto row = excluded(element);
    const auto place = std::ranges::lower_bound(row, vertex, {}, &Excluded::element);
    return place != row.end() && place->element == vertex && place->delayed;
  };
  return is_delayed(move.to) || (move.edge >= 0 && is_delayed(move.edge));
}

bool JointMoves::fit_together(const Move& one, const Move& other) const {
  if (is_in_way(one, other.robot, other.to) || delays(one, other.from) || delays(other, one.from)) return false;
  if (other.edge < 0) return true;
  return !excludes(one.robot, one.to, other.robot, other.edge) &&
         (one.edge < 0 || !excludes(one.robot, one.edge, other.robot, other.edge));
}

bool JointMoves::fit_in_turn(const Move& one, const Move& other) const {
  return !is_in_way(one, other.robot, other.from) && !is_in_way(other, one.robot, one.to);
}

bool JointMoves::is_allowed(Configuration at) {
  for (int robot = 0; robot < instance_.size(); ++robot) standing_[at[robot]] = robot;
  bool allowed = true;
  for (int robot = 0; robot < instance_.size(); ++robot) {
    allowed &= standing_[at[robot]] == robot;
    for (const Excluded& it : excluded(at[robot])) {
      const std::int32_t other = standing_[it.element];
      allowed &= other < 0 || other == robot || !applies(it, robot, other);
    }
  }
  for (const std::int32_t resource : roomy_) {
    int users = 0;
    for (int robot = 0; robot < instance_.size(); ++robot) users += uses(at[robot], resource);
    allowed &= users <= instance_.resources()[resource].capacity;
  }
  for (int robot = 0; robot < instance_.size(); ++robot) standing_[at[robot]] = -1;
  return allowed;
}

bool JointMoves::rounds(Configuration from, Configuration to, std::vector<std::vector<Move>>& rounds) {
  rounds.clear();
  std::vector<Move> left;
  for (int robot = 0; robot < instance_.size(); ++robot) {
    standing_[from[robot]] = robot;
    if (from[robot] != to[robot]) left.push_back(move(robot, from[robot], to[robot]));
  }
  while (!left.empty()) {
    std::vector<Move> round = left;
    choose(round);
    if (round.empty()) break;
    for (const Move& it : round) standing_[it.from] = -1;
    for (const Move& it : round) standing_[it.to] = it.robot;
    std::erase_if(left, [&](const Move& it) { return standing_[it.to] == it.robot; });
    rounds.push_back(std::move(round));
  }
  for (int robot = 0; robot < instance_.size(); ++robot) standing_[from[robot]] = standing_[to[robot]] = -1;
  return left.empty();
}

/// Keep those of the moves that can be made now, as many as possible.
void JointMoves::choose(std::vector<Move>& round) {
  for (const Move& it : round) {
    moving_[it.robot] = it;
    claimed_[it.edge] = claimed_[it.to] = it.robot;
  }
  while (drop_blocked(round) || drop_crowded(round)) {
  }
  for (const Move& it : round) claimed_[it.edge] = claimed_[it.to] = -1;
}

void JointMoves::drop(std::vector<Move>& round, int robot) {
  const Move& it = moving_[robot];
  claimed_[it.edge] = claimed_[it.to] = -1;
  std::erase_if(round, [&](const Move& one) { return one.robot == robot; });
}

/// Drop a move for which another robot is in the way; false if there is none.
bool JointMoves::drop_blocked(std::vector<Move>& round) {
  for (const Move& it : round) {
    if (const int robot = late(it); robot >= 0) {
      drop(round, robot);
      return true;
    }
  }
  return false;
}

/// This robot, or another one, if only one of the two can move in this round; -1 if this one can.
int JointMoves::late(const Move& move) const {
  for (const std::int32_t element : {move.edge, move.to}) {
    for (const Excluded& it : excluded(element)) {
      const std::int32_t there = standing_[it.element];
      if (there >= 0 && there != move.robot && applies(it, move.robot, there)) {
        const bool leaves = claimed_[moving_[there].to] == there && moving_[there].from == it.element;
        if (!leaves || it.delayed) return move.robot;
      }
      const std::int32_t other = claimed_[it.element];
      if (other < 0 || other == move.robot || !applies(it, move.robot, other)) continue;
      if (!fit_in_turn(move, moving_[other])) return move.robot;
      if (!fit_in_turn(moving_[other], move)) return other;
      return std::max(move.robot, other);
    }
  }
  return -1;
}

/// Drop a move into a resource that is full, in which robots count that leave it in this round; false if there is none.
bool JointMoves::drop_crowded(std::vector<Move>& round) {
  for (const std::int32_t resource : roomy_) {
    int users = 0, last = -1;
    for (int vertex = 0; vertex < moves_.vertex_count(); ++vertex) {
      users += standing_[vertex] >= 0 && uses(vertex, resource);
    }
    for (const Move& it : round) {
      if (uses(it.from, resource) || !(uses(it.edge, resource) || uses(it.to, resource))) continue;
      ++users;
      last = it.robot;
    }
    if (users <= instance_.resources()[resource].capacity || last < 0) continue;
    drop(round, last);
    return true;
  }
  return false;
}

bool JointMoves::misses_no_plan() const {
  const Roadmap& roadmap = instance_.roadmap();
  for (int robot = 0; robot < instance_.size(); ++robot) {
    const std::span<const Tick> duration = roadmap.duration(instance_.robots()[robot].profile);
    const bool unit = std::ranges::none_of(duration, [](Tick ticks) { return ticks > 1; });
    if (!instance_.robots()[robot].committed.empty()) return false;
    for (int edge = 0; edge < roadmap.edge_count(); ++edge) {
      if (duration[edge] < 0 || roadmap.tail(edge) == roadmap.head(edge)) continue;
      const int element = roadmap.vertex_count() + edge;
      if (moves_.edge(robot, roadmap.tail(edge), roadmap.head(edge)) != edge) return false;  // lanes side by side
      if (!uses_as_much(element, roadmap.head(edge))) return false;
      if (!unit && !excludes_as_much(element, roadmap.head(edge))) return false;
    }
  }
  return true;
}

bool JointMoves::uses_as_much(int element, int other) const {
  return std::ranges::all_of(instance_.resources_of(other), [&](int resource) { return uses(element, resource); });
}

bool JointMoves::excludes_as_much(int element, int other) const {
  const double least = reaches(instance_).first;
  const auto row = excluded(element);
  return std::ranges::all_of(excluded(other), [&](const Excluded& it) {
    const auto place = std::ranges::lower_bound(row, it.element, {}, &Excluded::element);
    const bool found = place != row.end() && place->element == it.element;
    return found && (place->distance <= it.distance || place->distance < least);
  });
}

}  // namespace mrpbench::mapf::lacam
