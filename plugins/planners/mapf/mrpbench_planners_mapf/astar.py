"""Decentralised A*: each robot plans alone, as in the baseline of MRP-Bench."""

from typing import ClassVar

from mrpbench_core.api.planner import Promise
from mrpbench_core.model.planning.problem import Feature
from mrpbench_planners_mapf.recipe import SUPPORTED, NativePlanner, native_planner


@native_planner("astar")
class Astar(NativePlanner):
    """Finds the shortest path of each robot alone: the paths may conflict, which the benchmark counts.

    `lower_bound` is the sum of costs of these paths: no conflict-free plan is cheaper. The result is `unsolvable` if a
    robot cannot reach its goal.
    """

    supports: ClassVar[frozenset[Feature]] = SUPPORTED | {Feature.RESOURCES}
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.DETERMINISTIC})
