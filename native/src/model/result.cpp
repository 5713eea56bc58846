#include "mrpbench_mapf/model/result.hpp"

namespace mrpbench::mapf {

void Result::note(double seconds, double cost, double bound) {
  constexpr double kApart = 1.02;  // times the seconds of the point before
  const std::size_t size = history.size();
  if (size > 1 && seconds < kApart * history[size - 2].seconds) history.pop_back();
  history.push_back({seconds, cost, bound});
}

void Result::no_plan_for(int robot) {
  statistics.failed_robot = robot;
  status = Status::unsolvable;
}

void Result::stop(Status limit) {
  if (status == Status::solved) {
    clock_bound = limit == Status::timeout;
  } else {
    status = limit;
    paths.clear();
  }
}

std::vector<Segment> segments(const Instance& instance, int robot, const Path& path) {
  std::vector<Segment> result = instance.robots()[robot].committed;
  const std::size_t known = instance.beginning(robot).occupied.size() - 1;
  Tick now = result.empty() ? 0 : result.back().leave;
  const auto wait_until = [&](Tick tick) {
    if (tick > now) result.push_back({-1, now, tick});
    now = tick;
  };
  for (std::size_t step = known; step + 1 < path.size(); step += 2) {
    const Occupation& move = path[step + 1];
    wait_until(enter_tick(move));
    result.push_back({move.element - instance.roadmap().vertex_count(), now, leave_tick(move)});
    now = leave_tick(move);
  }
  if (path.back().end != kForeverHalf) wait_until(leave_tick(path.back()));
  return result;
}

}  // namespace mrpbench::mapf
