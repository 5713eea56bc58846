"""Priority inheritance with backtracking: a plan for thousands of robots in little time, or none."""

from typing import ClassVar

from mrpbench_core.api.planner import Promise
from mrpbench_core.model.planning.problem import Feature
from mrpbench_planners_mapf.configurations import ConfigurationPlanner
from mrpbench_planners_mapf.recipe import native_planner


@native_planner("pibt")
class Pibt(ConfigurationPlanner):
    """Moves every robot step by step to where robots of higher priority leave room (Okumura et al., AIJ 2022).

    Incomplete: robots may move in circles, so the planner gives up after `steps` steps. With `swap`, two robots that
    meet in a narrow passage change places where that is possible (Okumura, IJCAI 2023). A step takes a tick where all
    moves do. Elsewhere it is one move of each robot, and each move starts as soon as those before it allow.
    """

    supports: ClassVar[frozenset[Feature]] = ConfigurationPlanner.supports | {Feature.HORIZON}
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.DETERMINISTIC})
