#include "squares.hpp"

#include <algorithm>
#include <cmath>

namespace mrpbench::discrete {
namespace {

constexpr double kTouch = 1e-9;
enum State : std::uint8_t { undecided, deciding, stays, goes };
constexpr int kRow[] = {0, 1, 0, -1}, kColumn[] = {1, 0, -1, 0};

}  // namespace

Squares::Squares(const Grid& grid, double size, int counter) : grid_(grid), size_(size), counter_(counter) {
  owner_.assign(grid.size(), -1);
}

const std::vector<std::uint8_t>& Squares::advance(Bodies& bodies, const std::vector<std::uint8_t>& acts) {
  const std::size_t robots = bodies.pose.size();
  wants_ = acts;
  state_.assign(robots, undecided);
  for (std::size_t i = 0; i < robots; ++i) owner_[bodies.pose[i].cell] = static_cast<std::int32_t>(i);
  for (std::size_t i = 0; i < robots; ++i) {
    if (wants_[i] && bodies.begun[i] == Action::wait) wants_[i] = 0;
    if (!wants_[i]) state_[i] = stays;
  }
  for (std::size_t i = 0; i < robots; ++i) decide(bodies, static_cast<int>(i));
  for (std::size_t i = 0; i < robots; ++i) owner_[bodies.pose[i].cell] = -1;
  for (std::size_t i = 0; i < robots; ++i) {
    wants_[i] = state_[i] == goes;
    if (!wants_[i] || ++bodies.progress[i] < counter_) continue;
    bodies.pose[i] = grid_.after(bodies.pose[i], bodies.begun[i]);
    bodies.progress[i] = 0;
    bodies.begun[i] = Action::wait;
  }
  return wants_;
}

bool Squares::decide(const Bodies& bodies, int robot) {
  if (state_[robot] == stays || state_[robot] == goes) return state_[robot] == goes;
  if (bodies.begun[robot] != Action::forward) {  // turning does not translate
    state_[robot] = goes;
    return true;
  }
  const Pose pose = bodies.pose[robot];
  const int target = grid_.ahead(pose);
  if (target < 0) {
    state_[robot] = stays;
    return false;
  }
  state_[robot] = deciding;
  // Others can be in the way only in the two cells of this robot: their owners, and those who enter them.
  const auto refuse = [&] {
    state_[robot] = stays;
    return false;
  };
  const auto in_the_way = [&](int other) {
    if (other < 0 || other == robot) return false;
    if (clash(bodies, robot, other, false)) {  // it has to go first
      if (state_[other] == deciding) return true;
      if (state_[other] == undecided) decide(bodies, other);
    }
    return clash(bodies, robot, other, state_[other] == goes);
  };
  if (in_the_way(owner_[target])) return refuse();
  for (const int cell : {target, pose.cell}) {
    for (int heading = 0; heading < 4; ++heading) {
      const int behind = grid_.ahead(cell, (heading + 2) & 3);
      const int other = behind < 0 ? -1 : owner_[behind];
      if (other < 0 || bodies.begun[other] != Action::forward || bodies.pose[other].heading != heading) continue;
      if (in_the_way(other)) return refuse();
    }
  }
  state_[robot] = goes;
  return true;
}

bool Squares::clash(const Bodies& bodies, int robot, int other, bool other_moves) const {
  const Pose& a = bodies.pose[robot];
  const Pose& b = bodies.pose[other];
  const int p = grid_.place(a.cell), q = grid_.place(b.cell), width = grid_.width();
  const double step = 1.0 / counter_;
  const double done_a = bodies.progress[robot] * step;
  const double done_b = bodies.begun[other] == Action::forward ? bodies.progress[other] * step : 0;
  const double speed_b = other_moves && bodies.begun[other] == Action::forward ? step : 0;
  double begin = 0, end = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const int* const direction = axis == 0 ? kRow : kColumn;
    const int cells = axis == 0 ? q / width - p / width : q % width - p % width;
    const double gap = cells + direction[b.heading] * done_b - direction[a.heading] * done_a;
    const double speed = direction[b.heading] * speed_b - direction[a.heading] * step;
    if (speed == 0) {
      if (std::abs(gap) >= size_ - kTouch) return false;
      continue;
    }
    const double one = (-size_ + kTouch - gap) / speed, two = (size_ - kTouch - gap) / speed;
    begin = std::max(begin, std::min(one, two));
    end = std::min(end, std::max(one, two));
  }
  return begin <= end;
}

}  // namespace mrpbench::discrete
