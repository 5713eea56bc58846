#include "lns/repair.hpp"

#include <algorithm>
#include <numeric>

namespace mrpbench::mapf::lns {

namespace {

Tick whenever(int) {
  return kLatestTime;
}

bool is_roomy(const Resource& resource) {
  return resource.capacity > 1;
}

}  // namespace

Repair::Repair(Schedule& schedule, int neighbourhood, std::uint64_t seed)
    : schedule_(schedule),
      neighbourhood_(schedule, schedule.tables(), seed + 1),
      size_(neighbourhood),
      random_(seed),
      has_roomy_resources_(std::ranges::any_of(schedule.instance().resources(), is_roomy)),
      partners_(schedule.instance().size()),
      seen_(schedule.instance().size()) {}

bool Repair::run(const Patience& patience, std::int64_t& iterations) {
  const std::int64_t before = schedule_.expansions();
  if (!begin(patience.in_the_way)) return false;
  const std::int64_t begun = schedule_.expansions();
  const double most = patience.effort * static_cast<double>(begun - before);
  for (std::int64_t k = 0; !is_done(); ++k, ++iterations) {
    if (k >= patience.iterations || static_cast<double>(schedule_.expansions() - begun) >= most) return false;
    advance();
  }
  return true;
}

bool Repair::begin(int most_in_the_way) {
  std::vector<int> order(schedule_.instance().size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int robot) { return schedule_.least(robot); });
  Cost sum = 0;
  for (const int robot : order) sum += schedule_.least(robot);
  const auto detour = static_cast<Tick>(1 + sum / std::max<Cost>(1, schedule_.instance().size()));
  int in_the_way = 0;
  for (const int robot : order) {
    const Tick latest = std::min(kLatestTime, schedule_.least(robot) + detour);
    if (!plan_first(robot, latest, in_the_way, most_in_the_way)) return false;
  }
  count_conflicts({});
  return true;
}

/// Between all robots; the paths of `robots` are the fresh ones.
void Repair::count_conflicts(const std::vector<int>& robots) {
  pairs_ = 0;
  for (int robot = 0; robot < schedule_.instance().size(); ++robot) {
    const auto place = std::ranges::find(robots, robot);
    const bool is_fresh = place != robots.end();
    const Path& path = is_fresh ? schedule_.fresh()[place - robots.begin()] : schedule_.paths()[robot];
    conflicts_of(robot, path, partners_[robot]);
    pairs_ += static_cast<int>(partners_[robot].size());
  }
  pairs_ /= 2;
}

/// Plan a path without conflicts with the planned robots or, if there is none, with as few conflicts as possible.
bool Repair::plan_first(int robot, Tick latest, int& in_the_way, int most_in_the_way) {
  const auto in_time = [&](int) { return latest; };
  bool found = schedule_.plan({robot}, Others::hard, in_time);
  if (!found) {
    schedule_.reject({robot});
    found = ++in_the_way <= most_in_the_way && schedule_.plan({robot}, Others::soft, in_time);
    if (!found) schedule_.reject({robot});
  }
  if (found) schedule_.accept({robot});
  return found;
}

/// The robots with which this path conflicts, each once.
int Repair::conflicts_of(int robot, const Path& path, std::vector<int>& partners) {
  partners.clear();
  ++count_;
  for (const Occupation& occupation : path) {
    schedule_.limits().check();
    schedule_.traffic().conflicts_of(robot, occupation, [&](int other) {
      if (seen_[other] != count_) partners.push_back(other);
      seen_[other] = count_;
    });
  }
  return static_cast<int>(partners.size());
}

void Repair::link(int robot, const std::vector<int>& partners) {
  for (const int other : partners) {
    partners_[other].push_back(robot);
    partners_[robot].push_back(other);
  }
  pairs_ += static_cast<int>(partners.size());
}

void Repair::unlink(int robot) {
  for (const int other : partners_[robot]) {
    std::erase(partners_[other], robot);
    --pairs_;
  }
  partners_[robot].clear();
}

void Repair::advance() {
  schedule_.limits().check_clock();
  const int heuristic = roulette_.spin(random_);
  robots_ = choose(heuristic);
  random_.shuffle(robots_);
  const int before = pairs_;
  if (has_roomy_resources_) {
    replan_and_count();
    roulette_.reward(heuristic,
                     std::max(0.0, static_cast<double>(before - pairs_) / static_cast<double>(robots_.size())));
    return;
  }
  std::vector<std::vector<int>> old;
  for (const int robot : robots_) {
    old.push_back(partners_[robot]);
    unlink(robot);
  }
  const bool found = schedule_.plan(robots_, Others::soft, whenever);
  std::vector<int> partners;
  for (std::size_t k = 0; found && k < robots_.size(); ++k) {
    conflicts_of(robots_[k], schedule_.fresh()[k], partners);
    // Conflicts within the group are seen from both sides: count them with the one that was planned first.
    std::erase_if(partners, [&](int other) {
      return std::find(robots_.begin(), robots_.begin() + static_cast<std::ptrdiff_t>(k), other) !=
             robots_.begin() + static_cast<std::ptrdiff_t>(k);
    });
    link(robots_[k], partners);
  }
  roulette_.reward(heuristic,
                   std::max(0.0, static_cast<double>(before - pairs_) / static_cast<double>(robots_.size())));
  if (found && pairs_ <= before) {
    schedule_.accept(robots_);
    return;
  }
  schedule_.reject(robots_);
  for (const int robot : robots_) unlink(robot);
  for (std::size_t k = 0; k < robots_.size(); ++k) {
    for (const int other : old[k]) {
      if (std::ranges::find(partners_[robots_[k]], other) != partners_[robots_[k]].end()) continue;
      link(robots_[k], {other});
    }
  }
}

/// Plan the group anew and count all conflicts: with resources, whether two robots conflict also depends on the others.
void Repair::replan_and_count() {
  const int before = pairs_;
  const bool found = schedule_.plan(robots_, Others::soft, whenever);
  if (found) count_conflicts(robots_);
  if (found && pairs_ <= before) {
    schedule_.accept(robots_);
    return;
  }
  schedule_.reject(robots_);
  count_conflicts({});
}

const std::vector<int>& Repair::choose(int heuristic) {
  std::vector<int> in_conflict;
  for (int robot = 0; robot < schedule_.instance().size(); ++robot) {
    if (!partners_[robot].empty()) in_conflict.push_back(robot);
  }
  const int robot = in_conflict[random_.below(in_conflict.size())];
  if (heuristic == 0) return neighbourhood_.in_conflict(robot, partners_, size_);
  return heuristic == 1 ? neighbourhood_.at_goal(robot, size_) : neighbourhood_.any(size_);
}

}  // namespace mrpbench::mapf::lns
