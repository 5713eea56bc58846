#include "operation_lns.hpp"

#include <algorithm>
#include <barrier>
#include <chrono>
#include <cmath>
#include <thread>

#include "draws.hpp"

namespace mrpbench::discrete {
namespace {

constexpr int kLanes = 4;
constexpr std::int64_t kRounds = 16;
///< Of a lane, before lanes exchange what they have found.
constexpr double kTemperature = 0.001, kCooling = 0.999;
///< Simulated annealing: of the first round, and from round to round.

}  // namespace

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void OperationLns::improve(const Wishes& wishes, const Budget& budget, double until, std::uint64_t step,
                           OperationSearch& search) {
  std::int64_t done = 0;
  const auto over = [&] { return budget.iterations ? done >= *budget.iterations : steady_seconds() >= until; };
  if (over()) return;
  if (lanes_.empty()) lanes_.assign(kLanes, {search, {}});
  for (Lane& lane : lanes_) lane.search.plans.copy(search.plans);
  bool ended = false;
  const auto exchange = [&]() noexcept {
    merge(wishes, lanes_);
    done += kLanes * kRounds;
    ended = over();
  };
  const int threads = std::min(threads_, kLanes);
  std::barrier barrier(threads, exchange);
  const auto run = [&](int thread) {
    while (!ended) {
      for (int lane = thread; lane < kLanes; lane += threads) {
        const std::int64_t begin = done + lane * kRounds;
        const std::int64_t end = budget.iterations ? std::min(begin + kRounds, *budget.iterations) : begin + kRounds;
        work(wishes, budget, until, step, {begin, end}, lanes_[lane]);
      }
      barrier.arrive_and_wait();
    }
  };
  {
    std::vector<std::jthread> others;
    for (int thread = 1; thread < threads; ++thread) others.emplace_back(run, thread);
    run(0);
  }
  search.plans.copy(lanes_[0].search.plans);
}

/// Make rounds in a lane.
void OperationLns::work(const Wishes& wishes, const Budget& budget, double until, std::uint64_t step, Rounds rounds,
                        Lane& lane) {
  const std::uint64_t robots = wishes.weight.size();
  double temperature = kTemperature * std::pow(kCooling, rounds.begin);
  for (std::int64_t round = rounds.begin; round < rounds.end; ++round, temperature *= kCooling) {
    if (!budget.iterations && round % 8 == 0 && steady_seconds() >= until) return;
    const std::uint64_t draw = drawn(seed_, step, round);
    const double unit = static_cast<double>(mixed(draw) >> 11) * 0x1p-53;
    const double most = -temperature * std::log(std::max(unit, 1e-300));
    if (!lane.search.improve(wishes, static_cast<int>(draw % robots), most)) continue;
    Change change{lane.search.changed(), {}, most};
    for (const int robot : change.robots) change.plans.push_back(lane.search.plans.of(robot));
    lane.changes.push_back(std::move(change));
  }
}

/// Take a change over that another lane has found, unless plans exclude it or it costs too much by now.
bool OperationLns::take(const Wishes& wishes, const Change& change, OperationPlans& plans) {
  const std::size_t count = change.robots.size();
  std::vector<OperationPlan> old;
  double cost = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const int robot = change.robots[k];
    old.push_back(plans.of(robot));
    plans.remove(robot);
    cost += wishes.weight[robot] * (change.plans[k].value - old.back().value);
  }
  std::size_t placed = 0;
  while (placed < count && cost < change.most) {
    if (plans.hit(change.robots[placed], change.plans[placed]) != OperationPlans::nobody) break;
    plans.place(change.robots[placed], change.plans[placed]);
    ++placed;
  }
  if (placed == count) return true;
  for (std::size_t k = 0; k < placed; ++k) plans.remove(change.robots[k]);
  for (std::size_t k = 0; k < count; ++k) plans.place(change.robots[k], old[k]);
  return false;
}

/// Take what all lanes have found over into the first one, then into all.
void OperationLns::merge(const Wishes& wishes, std::vector<Lane>& lanes) {
  OperationPlans& first = lanes[0].search.plans;
  std::vector<std::int32_t> changed;
  for (const Change& change : lanes[0].changes)
    changed.insert(changed.end(), change.robots.begin(), change.robots.end());
  for (std::size_t i = 1; i < lanes.size(); ++i) {
    for (const Change& change : lanes[i].changes) {
      if (take(wishes, change, first)) changed.insert(changed.end(), change.robots.begin(), change.robots.end());
    }
  }
  for (std::size_t i = 1; i < lanes.size(); ++i) {
    std::vector<std::int32_t> differing = changed;
    for (const Change& change : lanes[i].changes) {
      differing.insert(differing.end(), change.robots.begin(), change.robots.end());
    }
    OperationPlans& own = lanes[i].search.plans;
    for (const int robot : differing) own.remove(robot);
    for (const int robot : differing) own.place(robot, first.of(robot));
  }
  for (Lane& lane : lanes) lane.changes.clear();
}

}  // namespace mrpbench::discrete
