"""Large neighbourhood search: replans groups of robots, first for fewer conflicts and then for less cost."""

from typing import ClassVar

from mrpbench_core.api.planner import Promise
from mrpbench_core.model.planning.problem import Feature
from mrpbench_planners_mapf.recipe import SUPPORTED, RobustPlanner, native_planner


@native_planner("lns")
class Lns(RobustPlanner):
    """Repairs a plan with conflicts (Li et al., AAAI 2022), then improves it (Li et al., IJCAI 2021).

    Improvement ends when all robots arrive as early as if they were alone, after `limits.iterations` groups, or when
    the time is over. Incomplete if the first plan comes from repairing alone, and where moves take several ticks;
    there, LaCAM plans if repairing takes long. LaCAM cannot plan for robots that are late (`k`).
    """

    supports: ClassVar[frozenset[Feature]] = SUPPORTED | {Feature.RESOURCES}
    without_k: ClassVar[tuple[str, ...]] = ("initial",)
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.ROBUST, Promise.DETERMINISTIC})
