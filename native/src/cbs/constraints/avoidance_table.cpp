#include "mrpbench_mapf/cbs/constraints/avoidance_table.hpp"

namespace mrpbench::mapf {

AvoidanceTable::AvoidanceTable(const Space& space, Limits& limits) : vertices_(space.vertex_count()) {
  const int robots = space.instance().size();
  if (space.classical()) {
    ticks_.emplace(vertices_, robots, limits);
  } else {
    reservations_.emplace(space.instance(), space.relations(), limits);
    paths_.resize(robots);
  }
}

void AvoidanceTable::add(int robot, const TimedPath& path) {
  if (ticks_) return ticks_->add(robot, path);
  paths_[robot] = path;
  stale_ = true;
}

void AvoidanceTable::remove(int robot) {
  if (ticks_) return ticks_->remove(robot);
  paths_[robot] = {};
  stale_ = true;
}

void AvoidanceTable::refresh() {
  if (!stale_) return;
  stale_ = false;
  reservations_->clear();
  for (std::size_t robot = 0; robot < paths_.size(); ++robot) {
    reservations_->add(static_cast<int>(robot), paths_[robot].occupied);
  }
}

int AvoidanceTable::moving_on_lanes(int robot, const Move& move, Tick at) const {
  const Tick arrive = at + move.duration;
  return reservations_->count(robot, on_edge(vertices_ + move.edge, at, arrive)) +
         reservations_->count(robot, at_vertex(move.head, arrive, arrive));
}

}  // namespace mrpbench::mapf
