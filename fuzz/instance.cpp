// Makes problems of bytes (libFuzzer): an invalid one is refused by std::invalid_argument, and what a valid one tells
// of itself is in its arrays. `fuzz/native.sh` builds it with clang, AddressSanitizer and UndefinedBehaviorSanitizer.
#include "mrpbench_mapf/model/instance.hpp"

#include <fuzzer/FuzzedDataProvider.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <vector>

using namespace mrpbench::mapf;

namespace {

/// Mostly an index below `count`, sometimes any number.
int index(FuzzedDataProvider& data, int count) {
  if (data.ConsumeProbability<float>() < 0.02F) return data.ConsumeIntegral<std::int32_t>();
  return data.ConsumeIntegralInRange<int>(0, std::max(count - 1, 0));
}

Tick ticks(FuzzedDataProvider& data) {
  if (data.ConsumeProbability<float>() < 0.02F) return data.ConsumeIntegralInRange<Tick>(-1, kLatestTime);
  return data.ConsumeIntegralInRange<Tick>(1, 3);
}

Instance problem(FuzzedDataProvider& data) {
  const int vertices = data.ConsumeIntegralInRange<int>(1, 12), edges = data.ConsumeIntegralInRange<int>(0, 30);
  const int profiles = data.ConsumeIntegralInRange<int>(1, 2);
  std::vector<int> tail(edges), head(edges);
  for (int e = 0; e < edges; ++e) tail[e] = index(data, vertices), head[e] = index(data, vertices);
  std::vector<Tick> duration(static_cast<std::size_t>(profiles) * edges);
  for (Tick& it : duration) it = ticks(data);
  std::vector<Point> position(vertices);
  for (int v = 0; v < vertices; ++v) position[v] = {v % 4 * 1.0, v / 4 * 1.0};
  Roadmap roadmap(vertices, tail, head, duration, position);

  std::vector<Robot> robots(data.ConsumeIntegralInRange<int>(0, 4));
  for (Robot& it : robots) {
    it.profile = index(data, profiles);
    it.start = index(data, vertices);
    it.ready = data.ConsumeBool() ? 0 : ticks(data);
    it.goals.resize(data.ConsumeIntegralInRange<int>(0, 2));
    for (int& goal : it.goals) goal = index(data, vertices);
    it.committed.resize(data.ConsumeBool() ? 0 : data.ConsumeIntegralInRange<int>(0, 2));
    for (Segment& segment : it.committed)
      segment = {data.ConsumeBool() ? -1 : index(data, edges), ticks(data) - 1, ticks(data)};
  }
  std::vector<Resource> resources(data.ConsumeBool() ? 0 : data.ConsumeIntegralInRange<int>(0, 2));
  for (Resource& it : resources) {
    it.capacity = data.ConsumeIntegralInRange<int>(-1, 2);
    it.setup = ticks(data) - 1;
    it.elements.resize(data.ConsumeIntegralInRange<int>(0, 3));
    for (int& element : it.elements) element = index(data, vertices + edges);
  }
  const Rules rules{.following_forbidden = data.ConsumeBool(), .disappear_at_goal = data.ConsumeBool()};
  return Instance(std::move(roadmap), std::move(robots), rules, {}, std::move(resources));
}

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  FuzzedDataProvider data(bytes, size);
  try {
    const Instance instance = problem(data);
    const Roadmap& roadmap = instance.roadmap();
    for (int v = 0; v < roadmap.vertex_count(); ++v) {
      for (const int edge : roadmap.out(v)) require(roadmap.tail(edge) == v);
      for (const int edge : roadmap.in(v)) require(roadmap.head(edge) == v);
    }
    for (int robot = 0; robot < instance.size(); ++robot) {
      const Beginning& it = instance.beginning(robot);
      require(!it.occupied.empty() && it.vertex >= 0 && it.vertex < roadmap.vertex_count() && it.free_at >= 0);
    }
    for (int element = 0; element < roadmap.element_count(); ++element) {
      for (const int it : instance.resources_of(element)) {
        require(it >= 0 && static_cast<std::size_t>(it) < instance.resources().size());
      }
    }
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
