"""The planner of token passing: a robot with another goal plans around the paths of all others, which stay as they are.

Ma, Li, Kumar and Koenig, "Lifelong Multi-Agent Path Finding for Online Pickup and Delivery Tasks", AAMAS 2017.
"""

from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.checking.well_formed import ill_formed
from mrpbench_core.model.common.arrays import Bool, Int
from mrpbench_core.model.planning.plan import Budget, Paths, Plan, PlanResult
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_core.model.planning.type2_edges import moves_of
from mrpbench_core.model.planning.window import ends_at_goals
from mrpbench_planners_mapf.native import solve
from mrpbench_planners_mapf.prioritized import Prioritized
from mrpbench_planners_mapf.recipe import WINDOWED


@attrs.frozen(kw_only=True)
class TokenPassing(Planner):
    """Plans only the robots that have another goal, one after another, each on its earliest path around the paths in
    force of all others (Ma et al., AAMAS 2017). Needs tasks that come over time and are well-formed: each robot starts
    where no errand may be, and between any two starts and places of errands there is a way past robots that rest at the
    others. Together with the assigner `token_passing` it then finishes every task. It needs `replanning.parking: home`,
    because a robot that rests elsewhere may block that way.

    Where this fails, as it may without well-formed tasks or while robots make room, `prioritized` also plans robots
    whose paths were kept.
    """

    supports: ClassVar[frozenset[Feature]] = Prioritized.supports - WINDOWED - {Feature.GOAL_SEQUENCES}
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.DETERMINISTIC})
    reads_remaining: ClassVar[bool] = True
    needs_homes: ClassVar[bool] = True

    def skip_tasks(self, problem: Problem, places: Int | None) -> str | None:
        """Return why the tasks are not well-formed, or None."""
        unknown = "the task source does not say where errands may be"
        fault = unknown if places is None else ill_formed(problem, places)
        return None if fault is None else f"needs well-formed tasks: {fault}"

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Plan the robots whose current paths do not lead to their goals."""
        reduced = problem
        if problem.remaining:
            remaining = Paths.of(problem.remaining)
            size = np.where(_leads_to_goals(problem), remaining.size, 0)
            remaining_paths = remaining.part(np.zeros_like(size), size)
            commitments = (
                Paths.of(problem.commitments).then(remaining_paths) if problem.commitments else remaining_paths
            )
            reduced = attrs.evolve(problem, commitments=commitments, remaining=())
        # Robots whose paths are kept plan first, because nothing is left for them to plan.
        return solve(reduced, budget, Prioritized.algorithm, {"order": "shortest_first", "seed": budget.seed})


def _leads_to_goals(problem: Problem) -> Bool:
    """Tell of each robot, bool[n], whether its current path leads to its goal, along edges that it may use."""
    paths = Paths.of(problem.remaining)
    if problem.commitments:
        paths = Paths.of(problem.commitments).then(paths)
    moves = moves_of(problem, Plan(paths=paths))
    leads = ends_at_goals(problem, moves)
    leads[moves.robot[problem.roadmap.duration[problem.profile[moves.robot], moves.edge] < 0]] = False
    return leads
