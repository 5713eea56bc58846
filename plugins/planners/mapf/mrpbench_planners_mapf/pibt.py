"""Priority inheritance with backtracking: a plan for thousands of robots in little time, or none."""

from typing import ClassVar

from mrpbench_core.api.planner import Promise
from mrpbench_planners_mapf.recipe import native_planner
from mrpbench_planners_mapf.unit_moves import UnitMoves


@native_planner("pibt")
class Pibt(UnitMoves):
    """Moves every robot tick by tick to where robots of higher priority leave room (Okumura et al., AIJ 2022).

    For roadmaps on which every move takes one tick. Incomplete: robots may move in circles, so the planner gives up
    after `steps` ticks. With `swap`, two robots that meet in a narrow passage change places where that is possible
    (Okumura, IJCAI 2023).
    """

    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.DETERMINISTIC})
