"""Priority inheritance with backtracking: a plan for thousands of robots in little time, or none."""

from typing import ClassVar

import numpy as np

from mrpbench_core.api.planner import PlannerSession, Promise
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.planning.plan import Budget, PlanResult
from mrpbench_core.model.planning.problem import Feature, GoalSet, Problem
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

    def start(self) -> PlannerSession:
        """Begin a session in which robots that have had their goals for longest go first, as in the paper."""
        return PibtSession(self)


class PibtSession(PlannerSession):
    """Ranks robots by the call in which they got their goals, those of one call by their number.

    A rank does not change until the robot gets other goals. Where it depends on the distance to the goal, robots that
    meet give way in turns and come no nearer.
    """

    def __init__(self, planner: Pibt) -> None:
        self._planner = planner
        self._goals: tuple[tuple[GoalSet, ...], ...] = ()
        self._given: Int32 = np.zeros(0, np.int32)
        self._calls = 0

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Plan, with the robots that have had their goals for longest first."""
        rank = None
        if self._calls:
            other = [before != now for before, now in zip(self._goals, problem.goals, strict=True)]
            self._given[other] = self._calls
            rank = np.argsort(np.argsort(self._given, kind="stable"), kind="stable").astype(np.int32)
        else:
            self._given = np.zeros(len(problem), np.int32)
        self._goals = problem.goals
        self._calls += 1
        return self._planner.solve(problem, budget, rank)
