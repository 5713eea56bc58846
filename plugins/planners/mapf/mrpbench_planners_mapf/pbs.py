"""Priority-based search: priorities are decided conflict by conflict."""

from typing import ClassVar

from mrpbench_core.api.planner import Promise
from mrpbench_core.model.planning.problem import Feature
from mrpbench_planners_mapf.recipe import SUPPORTED, WINDOWED, RobustPlanner, native_planner


@native_planner("pbs")
class Pbs(RobustPlanner):
    """Searches depth first over partial orders of robots (Ma et al., AAAI 2019).

    Each robot plans around those before it. Often near the optimum and much faster than an optimal planner. Incomplete:
    some problems have no solution under any priorities, and the planner then gives up; `statistics["failed_robot"]` is
    the robot that last found no path. `lower_bound` is the cost of all robots if each were alone.
    """

    supports: ClassVar[frozenset[Feature]] = SUPPORTED | WINDOWED | {Feature.RESOURCES, Feature.GOAL_SEQUENCES}
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.ROBUST, Promise.DETERMINISTIC})
