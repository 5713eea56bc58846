// How a conflict is best resolved: by what branches, and how many of them cost more.
#pragma once

#include "mrpbench_mapf/cbs/corridor.hpp"
#include "mrpbench_mapf/cbs/rectangle.hpp"
#include "mrpbench_mapf/cbs/target.hpp"

namespace mrpbench::mapf {

class Reasoning {
 public:
  /// The constraints of branches are kept in `constraints`.
  Reasoning(Workbench& bench, Arena<Constraint>& constraints)
      : bench_(bench), constraints_(constraints), corridors_(bench), rectangles_(bench.limits) {}

  /// Fill in what `conflict` says about its resolution, unless that was done before.
  void examine(const Situation& situation, Conflict& conflict);

 private:
  bool examine_target(const Situation& situation, Conflict& conflict);
  bool examine_passing(const Situation& situation, Conflict& conflict);
  void examine_crossing(const Situation& situation, Conflict& conflict);
  Half earliest_done(const Situation& situation, const Conflict& conflict, int robot, int crossing);
  bool examine_corridor(const Situation& situation, Conflict& conflict);
  bool examine_corridor_to(const Situation& situation, Conflict& conflict, int passing, int ending);
  void examine_rectangle(const Situation& situation, Conflict& conflict);
  void rate(const Situation& situation, Conflict& conflict);
  void use(Conflict& conflict, Conflict::Kind kind, std::span<const Constraint> one, std::span<const Constraint> other);

  Workbench& bench_;
  Arena<Constraint>& constraints_;
  Corridors corridors_;
  Rectangles rectangles_;
};

}  // namespace mrpbench::mapf
