// Problems as Python gives them: one dict of arrays for the roadmap, the robots, the exclusions and the resources each.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"

namespace mrpbench::bindings {

inline mapf::Tick tick(std::int64_t value) {
  if (value < -1 || value > mapf::kLatestTime) throw std::invalid_argument("times are at most 2^28 ticks");
  return static_cast<mapf::Tick>(value);
}

inline mapf::Roadmap roadmap_of(const nb::dict& given) {
  const NamedArrays arrays(given, "roadmap");
  const auto position = arrays.table<double>("position");
  const auto edges = arrays.table<std::int32_t>("edges");
  const auto duration = arrays.table<std::int32_t>("duration");
  if (position.shape(1) != 2 || edges.shape(1) != 2) throw nb::type_error("positions and edges have two columns");
  arrays.require(duration.shape(1) == edges.shape(0), "duration", "needs a column for each edge");
  std::vector<int> tail, head;
  tail.reserve(edges.shape(0));
  head.reserve(edges.shape(0));
  for (std::size_t e = 0; e < edges.shape(0); ++e) {
    tail.push_back(edges.data()[2 * e]);
    head.push_back(edges.data()[2 * e + 1]);
  }
  std::vector<mapf::Point> points;
  points.reserve(position.shape(0));
  for (std::size_t v = 0; v < position.shape(0); ++v) {
    points.push_back({position.data()[2 * v], position.data()[2 * v + 1]});
  }
  return mapf::Roadmap(static_cast<int>(position.shape(0)), std::move(tail), std::move(head),
                       {duration.data(), duration.data() + duration.size()}, std::move(points));
}

inline std::vector<mapf::Robot> robots_of(const nb::dict& given) {
  const NamedArrays arrays(given, "robots");
  const auto start = arrays.vector<std::int32_t>("start");
  const std::size_t count = start.size();
  const auto profile = arrays.vector<std::int32_t>("profile", count);
  const auto radius = arrays.vector<double>("radius", count);
  const auto ready = arrays.vector<std::int64_t>("ready", count);
  const auto rank = arrays.vector<std::int32_t>("rank", count);
  const auto goal = arrays.vector<std::int32_t>("goal");
  const auto goal_first = arrays.bounds("goal_first", count, goal.size());
  const auto via_goal = arrays.vector<std::int32_t>("via_goal");
  const auto via_sets = std::max<std::size_t>(arrays.vector<std::int64_t>("via_goal_first").size(), 1) - 1;
  const auto via_goal_first = arrays.bounds("via_goal_first", via_sets, via_goal.size());
  const auto via_first = arrays.bounds("via_first", count, via_sets);
  const auto edge = arrays.vector<std::int32_t>("committed_edge");
  const auto enter = arrays.vector<std::int64_t>("committed_enter", edge.size());
  const auto leave = arrays.vector<std::int64_t>("committed_leave", edge.size());
  const auto committed_first = arrays.bounds("committed_first", count, edge.size());
  std::vector<mapf::Robot> robots(count);
  for (std::size_t r = 0; r < count; ++r) {
    robots[r].profile = profile.data()[r];
    robots[r].radius = radius.data()[r];
    robots[r].start = start.data()[r];
    robots[r].ready = tick(ready.data()[r]);
    robots[r].rank = rank.data()[r];
    robots[r].goals.assign(goal.data() + goal_first.data()[r], goal.data() + goal_first.data()[r + 1]);
    for (auto k = via_first.data()[r]; k < via_first.data()[r + 1]; ++k) {
      robots[r].via.emplace_back(via_goal.data() + via_goal_first.data()[k],
                                 via_goal.data() + via_goal_first.data()[k + 1]);
    }
    for (auto k = committed_first.data()[r]; k < committed_first.data()[r + 1]; ++k) {
      robots[r].committed.push_back({edge.data()[k], tick(enter.data()[k]), tick(leave.data()[k])});
    }
  }
  return robots;
}

inline mapf::Exclusions exclusions_of(const nb::dict& given) {
  const NamedArrays arrays(given, "exclusions");
  return {copy<std::int64_t>(arrays.vector<std::int64_t>("first")),
          copy<std::int32_t>(arrays.vector<std::int32_t>("element")), copy<double>(arrays.vector<double>("distance"))};
}

inline std::vector<mapf::Resource> resources_of(const nb::dict& given) {
  const NamedArrays arrays(given, "resources");
  const auto capacity = arrays.vector<std::int32_t>("capacity");
  const auto setup = arrays.vector<std::int64_t>("setup", capacity.size());
  const auto element = arrays.vector<std::int32_t>("element");
  const auto first = arrays.bounds("first", capacity.size(), element.size());
  std::vector<mapf::Resource> resources(capacity.size());
  for (std::size_t r = 0; r < resources.size(); ++r) {
    resources[r] = {capacity.data()[r],
                    tick(setup.data()[r]),
                    {element.data() + first.data()[r], element.data() + first.data()[r + 1]}};
  }
  return resources;
}

/// A roadmap for several instances.
struct KnownRoadmap {
  std::shared_ptr<mapf::DistanceCache> distances;

  explicit KnownRoadmap(const nb::dict& given)
      : distances(std::make_shared<mapf::DistanceCache>(std::make_shared<const mapf::Roadmap>(roadmap_of(given)))) {}
};

inline void construct_on(mapf::Instance* self, const KnownRoadmap& roadmap, const nb::dict& robots,
                         const nb::dict& exclusions, const nb::dict& resources, bool following_forbidden,
                         bool disappear_at_goal, std::int64_t k, std::optional<std::int64_t> horizon) {
  new (self)
      mapf::Instance(roadmap.distances->roadmap(), robots_of(robots),
                     {following_forbidden, disappear_at_goal, tick(k), horizon ? tick(*horizon) : mapf::kForever},
                     exclusions_of(exclusions), resources_of(resources), roadmap.distances);
}

inline void construct(mapf::Instance* self, const nb::dict& roadmap, const nb::dict& robots, const nb::dict& exclusions,
                      const nb::dict& resources, bool following_forbidden, bool disappear_at_goal, std::int64_t k,
                      std::optional<std::int64_t> horizon) {
  new (self)
      mapf::Instance(roadmap_of(roadmap), robots_of(robots),
                     {following_forbidden, disappear_at_goal, tick(k), horizon ? tick(*horizon) : mapf::kForever},
                     exclusions_of(exclusions), resources_of(resources));
}

}  // namespace mrpbench::bindings
