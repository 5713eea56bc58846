// Problems as Python gives them: one dict of arrays for the roadmap, the robots, the exclusions and the resources each.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "mrpbench_mapf/model/instance.hpp"

namespace mrpbench::bindings {

template <class T>
using Table = nb::ndarray<const T, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

/// Arrays by name. An array must have the right type: a conversion would wrap numbers that are too large.
class NamedArrays {
 public:
  NamedArrays(const nb::dict& arrays, const char* owner) : arrays_(arrays), owner_(owner) {}

  template <class T>
  Vector<T> vector(const char* name) const {
    return get<Vector<T>>(name);
  }
  template <class T>
  Table<T> table(const char* name) const {
    return get<Table<T>>(name);
  }
  /// A vector of `size`.
  template <class T>
  Vector<T> vector(const char* name, std::size_t size) const {
    const auto found = vector<T>(name);
    require(found.size() == size, name, "has the wrong length");
    return found;
  }
  /// The bounds of `rows` lists that are stored one after another in `size` elements: list i is [first[i], first[i+1]).
  Vector<std::int64_t> bounds(const char* name, std::size_t rows, std::size_t size) const {
    const auto first = vector<std::int64_t>(name, rows + 1);
    bool sound = first.data()[0] == 0 && first.data()[rows] == static_cast<std::int64_t>(size);
    for (std::size_t i = 0; sound && i < rows; ++i) sound = first.data()[i] <= first.data()[i + 1];
    require(sound, name, "does not fit the lists that it bounds");
    return first;
  }
  void require(bool holds, const char* name, const char* fault) const {
    if (!holds) throw std::invalid_argument(full(name) + " " + fault);
  }

 private:
  std::string full(const char* name) const { return std::string(owner_) + "['" + name + "']"; }

  template <class Array>
  Array get(const char* name) const {
    if (!arrays_.contains(name)) throw nb::type_error((full(name) + " is missing").c_str());
    Array found;
    if (!nb::try_cast(arrays_[name], found, false)) {
      throw nb::type_error((full(name) + " has the wrong type or shape").c_str());
    }
    return found;
  }

  const nb::dict& arrays_;
  const char* owner_;
};

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
  const auto goal = arrays.vector<std::int32_t>("goal");
  const auto goal_first = arrays.bounds("goal_first", count, goal.size());
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
    robots[r].goals.assign(goal.data() + goal_first.data()[r], goal.data() + goal_first.data()[r + 1]);
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

inline void construct(mapf::Instance* self, const nb::dict& roadmap, const nb::dict& robots, const nb::dict& exclusions,
                      const nb::dict& resources, bool following_forbidden, bool disappear_at_goal) {
  new (self) mapf::Instance(roadmap_of(roadmap), robots_of(robots), {following_forbidden, disappear_at_goal},
                            exclusions_of(exclusions), resources_of(resources));
}

}  // namespace mrpbench::bindings
