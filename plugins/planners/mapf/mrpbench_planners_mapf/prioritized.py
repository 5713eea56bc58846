"""Prioritised planning by safe interval path planning."""

from typing import ClassVar

from mrpbench_core.api.planner import Promise
from mrpbench_core.model.planning.problem import Feature
from mrpbench_planners_mapf.recipe import SUPPORTED, WINDOWED, RobustPlanner, native_planner


@native_planner("prioritized")
class Prioritized(RobustPlanner):
    """Plans one robot after another, each on its earliest path around the robots before it.

    Fast, but incomplete. When a robot finds no path, it moves to the front of the order and all robots are planned
    again, up to `restarts` times; an order that was tried before is shuffled. From the hundredth restart on, randomly
    chosen robots also start late, because no order can plan robots that park in each other's way. After all restarts
    the planner gives up, and `statistics["failed_robot"]` names the robot. `lower_bound` is the cost of all robots if
    each were alone.
    """

    supports: ClassVar[frozenset[Feature]] = SUPPORTED | WINDOWED | {Feature.RESOURCES, Feature.GOAL_SEQUENCES}
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.ROBUST, Promise.DETERMINISTIC})
