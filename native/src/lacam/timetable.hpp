// When the moves of a sequence of configurations start: each as soon as all moves before it that it must not meet are
// over, so that only their order matters. Hönig, Kumar, Cohen, Ma, Xu, Ayanian and Koenig, "Multi-agent path finding
// with kinematic constraints", ICAPS 2016.
#pragma once

#include "lacam/joint_moves.hpp"

namespace mrpbench::mapf::lacam {

class Timetable {
 public:
  /// All robots do what is certain, see `Beginning`.
  Timetable(const Instance& instance, const Relations& relations, const JointMoves& joint);

  /// These move together, and after all that were added before.
  void add(const std::vector<Move>& round);
  /// All robots stay where they are now.
  std::vector<Path> paths() &&;

 private:
  /// The last time that a robot was on an element, or used a resource.
  struct Past {
    std::int32_t robot;
    Half begin, end;
  };

  Tick duration(const Move& move) const;
  Tick after_past(const Move& move) const;
  Tick after_round(const Move& move, const std::vector<Move>& round, const std::vector<Tick>& departure) const;
  /// The last half-tick at which too many others use a resource for `robot` to do so as well.
  Half full_until(int robot, int resource) const;
  void close(int robot, const Occupation& occupation);
  static void note(std::vector<Past>& pasts, Past past);

  const Instance& instance_;
  const Relations& relations_;
  const JointMoves& joint_;
  std::vector<Path> paths_;
  std::vector<Tick> free_at_;             // by robot: earliest next departure
  std::vector<std::vector<Past>> past_;   // by element
  std::vector<std::vector<Past>> users_;  // by resource, setup included
};

}  // namespace mrpbench::mapf::lacam
