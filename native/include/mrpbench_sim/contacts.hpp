// Discs that push each other, and are pushed out of what is solid: the rules of the core's `kinematic` simulator.
#pragma once

#include <compare>
#include <vector>

#include "mrpbench_sim/neighbours.hpp"

namespace mrpbench::sim {

/// Metres: discs never overlap anything solid, nor each other, by more than this.
constexpr double kTolerance = 1e-4;

/// A robot and what it touched: a disc of higher index, or -1 for what does not move.
struct Touch {
  int robot, other;
  auto operator<=>(const Touch&) const = default;
};

/// Robots (the first of the radii) and movers, which push but cannot be pushed.
class Contacts {
 public:
  Contacts(std::vector<Segment> segments, std::vector<double> radius, int robots);

  /// Replace the door leaves, which are solid.
  void set_leaves(std::span<const Segment> leaves) { neighbours_.set_leaves(leaves); }

  /// Resolve overlaps of discs that moved from `before` to `centres`, in place; touches are appended, some repeatedly.
  void separate(std::span<const Point> before, std::span<Point> centres, std::vector<Touch>& touches);

 private:
  struct Shift {
    int robot;
    Point by;
  };

  struct Inside {
    int wall;
    double depth;
  };

  void activate(bool all);
  bool push(int robot, std::span<const Point> before, std::span<const Point> centres, Point& shift,
            std::vector<Touch>& touches) const;
  Inside deepest_wall(int robot, Point centre) const;
  bool stuck(int robot, std::span<const Point> centres) const;
  void take_back(std::span<const Point> before, std::span<Point> centres);

  Neighbours neighbours_;
  std::vector<int> active_;
  std::vector<char> is_active_, is_back_;
  std::vector<Shift> shifts_;
};

}  // namespace mrpbench::sim
