#include "lns/neighbourhood.hpp"

#include <algorithm>

namespace mrpbench::mapf::lns {

Neighbourhood::Neighbourhood(const Schedule& schedule, DistanceTables& tables, std::uint64_t seed)
    : schedule_(schedule),
      roadmap_(schedule.instance().roadmap()),
      tables_(tables),
      random_(seed),
      is_chosen_(schedule.instance().size()),
      seen_(roadmap_.vertex_count()) {}

void Neighbourhood::clear(int size) {
  size_ = std::min(size, schedule_.instance().size());
  for (const int robot : chosen_) is_chosen_[robot] = false;
  chosen_.clear();
}

void Neighbourhood::add(int robot) {
  if (full() || is_chosen_[robot]) return;
  is_chosen_[robot] = true;
  chosen_.push_back(robot);
}

const std::vector<int>& Neighbourhood::around_late(int late, int size) {
  clear(size);
  add(late);
  int robot = late;
  for (int tries = 0; tries < 10 && !full(); ++tries) {
    walk(robot);
    robot = chosen_[random_.below(chosen_.size())];
  }
  return chosen_;
}

/// From a random point of the robot's path go on at random, but only where it could still arrive earlier than it does:
/// a robot that is met there keeps it from doing so.
void Neighbourhood::walk(int robot) {
  const Path& path = schedule_.paths()[robot];
  const Tick end = arrival(path);
  const Occupation& point = path[2 * random_.below((path.size() + 1) / 2)];  // a vertex: every second one is
  int vertex = point.element;
  Tick now = enter_tick(point);
  DistanceTable& distance = tables_[robot];
  const std::span<const Tick> duration = roadmap_.duration(schedule_.instance().robots()[robot].profile);
  while (!full() && now < end) {
    const std::span<const int> out = roadmap_.out(vertex);
    int way = -2;  // -1 = wait
    int ways = 0;
    const auto offer = [&](int edge, Tick then, int there) {
      const Tick h = distance(there);
      if (h != kForever && then + h < end && random_.below(++ways) == 0) way = edge;
    };
    for (const int edge : out) {
      if (duration[edge] > 0) offer(edge, now + duration[edge], roadmap_.head(edge));
    }
    offer(-1, now + 1, vertex);
    if (way == -2) return;
    const Tick then = now + (way < 0 ? 1 : duration[way]);
    if (way >= 0) {
      schedule_.traffic().conflicts_of(robot, on_edge(roadmap_.vertex_count() + way, now, then),
                                       [&](int other) { add(other); });
      vertex = roadmap_.head(way);
    }
    meet(robot, vertex, then, then);
    now = then;
  }
}

void Neighbourhood::meet(int robot, int vertex, Tick from, Tick to) {
  schedule_.traffic().conflicts_of(robot, at_vertex(vertex, from, to), [&](int other) { add(other); });
}

const std::vector<int>& Neighbourhood::at_crossing(int size) {
  clear(size);
  ++search_;
  queue_.assign(1, random_.below(roadmap_.vertex_count()));
  seen_[queue_.front()] = search_;
  for (std::size_t next = 0; next < queue_.size() && !full(); ++next) {
    const int vertex = queue_[next];
    const std::span<const int> out = roadmap_.out(vertex);
    const std::span<const Visit> visits = schedule_.traffic().at(vertex);
    if (out.size() > 2 && !visits.empty()) {
      const std::size_t first = random_.below(visits.size());
      const std::size_t number = std::min<std::size_t>(visits.size(), 1 + size_ / 2);
      for (std::size_t k = 0; k < number; ++k) add(visits[(first + k) % visits.size()].robot);
    }
    for (const int edge : out) {
      const int head = roadmap_.head(edge);
      if (seen_[head] == search_) continue;
      seen_[head] = search_;
      queue_.push_back(head);
    }
  }
  return chosen_;
}

const std::vector<int>& Neighbourhood::any(int size) {
  clear(size);
  fill();
  return chosen_;
}

void Neighbourhood::fill() {
  while (!full()) add(random_.below(schedule_.instance().size()));
}

const std::vector<int>& Neighbourhood::in_conflict(int robot, const std::vector<std::vector<int>>& partners, int size) {
  clear(size);
  add(robot);
  // A random walk gathers those that are closely knit; it may go in circles.
  int at = robot;
  for (int steps = 0; steps < 8 * size_ && !full(); ++steps) {
    if (partners[at].empty()) break;
    at = partners[at][random_.below(partners[at].size())];
    add(at);
  }
  for (int tries = 0; tries < 10 && !full(); ++tries) walk(chosen_[random_.below(chosen_.size())]);
  return chosen_;
}

const std::vector<int>& Neighbourhood::at_goal(int robot, int size) {
  clear(size);
  add(robot);
  const Path& path = schedule_.paths()[robot];
  meet(robot, path.back().element, arrival(path), kForever);
  for (std::size_t step = 0; step < path.size() && !full(); step += 2) {
    for (const Visit& visit : schedule_.traffic().at(path[step].element)) {
      if (visit.end == kForeverHalf) add(visit.robot);
    }
  }
  for (int tries = 0; tries < 10 && !full(); ++tries) walk(chosen_[random_.below(chosen_.size())]);
  return chosen_;
}

}  // namespace mrpbench::mapf::lns
