// A directed graph with integer edge durations per motion profile, in flat arrays.
#pragma once

#include <span>
#include <vector>

#include "mrpbench_mapf/model/time.hpp"

namespace mrpbench::mapf {

struct Point {
  double x;
  double y;
};

class Roadmap {
 public:
  /// `duration` has one row of `tail.size()` ticks per profile, -1 = forbidden. `position` (metres) may be empty; then
  /// only heuristics without geometry work. Throws std::invalid_argument for invalid data.
  Roadmap(int vertex_count, std::vector<int> tail, std::vector<int> head, std::vector<Tick> duration,
          std::vector<Point> position = {});

  int vertex_count() const { return vertex_count_; }
  int edge_count() const { return static_cast<int>(tail_.size()); }
  int element_count() const { return vertex_count_ + edge_count(); }
  int profile_count() const { return profile_count_; }
  int tail(int edge) const { return tail_[edge]; }
  int head(int edge) const { return head_[edge]; }
  /// Edges out of (into) a vertex, without self-loops: waiting does not need an edge.
  std::span<const int> out(int vertex) const { return row(out_first_, out_edge_, vertex); }
  std::span<const int> in(int vertex) const { return row(in_first_, in_edge_, vertex); }
  /// Vertices from which or to which an edge leads, sorted, each once.
  std::vector<int> neighbours(int vertex) const;
  std::span<const Tick> duration(int profile) const {
    return {duration_.data() + static_cast<std::size_t>(profile) * tail_.size(), tail_.size()};
  }
  std::span<const Point> position() const { return position_; }
  /// Memory in bytes.
  std::size_t bytes() const;

 private:
  static std::span<const int> row(const std::vector<int>& first, const std::vector<int>& edge, int vertex) {
    return {edge.data() + first[vertex], edge.data() + first[vertex + 1]};
  }
  void validate() const;
  void index(const std::vector<int>& end, std::vector<int>& first, std::vector<int>& edge) const;

  int vertex_count_;
  int profile_count_;
  std::vector<int> tail_, head_;
  std::vector<Tick> duration_;
  std::vector<Point> position_;
  std::vector<int> out_first_, out_edge_, in_first_, in_edge_;
};

}  // namespace mrpbench::mapf
