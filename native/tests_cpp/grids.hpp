// Small instances for the tests.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mrpbench_mapf/model/result.hpp"

namespace mrpbench::mapf {

/// Two-way unit lanes between the neighbouring cells of a raster of width x height; vertex = y * width + x.
inline Roadmap grid(int width, int height, Tick duration = 1) {
  std::vector<int> tail, head;
  std::vector<Point> position;
  const auto lane = [&](int a, int b) {
    tail.insert(tail.end(), {a, b});
    head.insert(head.end(), {b, a});
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int v = y * width + x;
      position.push_back({static_cast<double>(x), static_cast<double>(y)});
      if (x + 1 < width) lane(v, v + 1);
      if (y + 1 < height) lane(v, v + width);
    }
  }
  std::vector<Tick> durations(tail.size(), duration);
  return Roadmap(width * height, std::move(tail), std::move(head), std::move(durations), std::move(position));
}

inline int edge_between(const Roadmap& roadmap, int tail, int head) {
  for (const int edge : roadmap.out(tail)) {
    if (roadmap.head(edge) == head) return edge;
  }
  return -1;
}

inline Robot robot(int start, int goal) {
  Robot it;
  it.start = start;
  it.goals = {goal};
  return it;
}

inline Instance instance(Roadmap roadmap, std::vector<Robot> robots, Rules rules = {}) {
  return Instance(std::move(roadmap), std::move(robots), rules, {});
}

inline Limits unlimited() {
  return Limits(std::numeric_limits<double>::infinity(), 1LL << 40);
}

inline Cost sum_of_costs(const Result& result) {
  Cost cost = 0;
  for (const Path& path : result.paths) cost += arrival(path);
  return cost;
}

}  // namespace mrpbench::mapf
