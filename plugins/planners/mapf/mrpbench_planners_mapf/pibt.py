"""Priority inheritance with backtracking: a plan for thousands of robots in little time, or none."""

from typing import ClassVar

import numpy as np

from mrpbench_core.api.planner import PlannerSession, Promise
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.planning.plan import Budget, PlanResult
from mrpbench_core.model.planning.problem import Feature, Goals, Problem
from mrpbench_planners_mapf.configurations import ConfigurationPlanner
from mrpbench_planners_mapf.native import KnownRoadmap
from mrpbench_planners_mapf.recipe import WINDOWED, native_planner


@native_planner("pibt")
class Pibt(ConfigurationPlanner):
    """Moves every robot step by step to where robots of higher priority leave room (Okumura et al., AIJ 2022).

    Incomplete: robots may move in circles, so the planner gives up after `steps` steps. With `swap`, two robots that
    meet in a narrow passage change places where that is possible (Okumura, IJCAI 2023). A step takes a tick where all
    moves do. Elsewhere it is one move of each robot, and each move starts as soon as those before it allow.
    """

    supports: ClassVar[frozenset[Feature]] = ConfigurationPlanner.supports | WINDOWED
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.DETERMINISTIC})

    def start(self) -> PlannerSession:
        """Begin a session in which robots that have been on their way for longest go first, as in the paper."""
        return PibtSession(self)


class PibtSession(PlannerSession):
    """Ranks robots by the number of calls in which they were not at their goals, then by their number.

    The count begins anew when a robot gets another goal. If the order depended on distances, robots that meet would
    give way in turns and come no nearer. If it forgot those that arrive, they would be pushed away before they have
    rested there. A robot that stays at its goal counts no further, so that it gives way to others in the end.
    """

    def __init__(self, planner: Pibt) -> None:
        self._planner = planner
        self._roadmap = KnownRoadmap(planner.solvers)
        self._goals: Goals = ()
        self._under_way: Int = np.zeros(0, np.int64)

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Plan, with the robots that have been on their way for longest first."""
        rank = None
        if self._goals:
            there = zip(problem.start.tolist(), self._goals, problem.goals, strict=True)
            away, same = np.array([(start not in now[-1], now == before) for start, before, now in there]).T
            self._under_way = np.where(same, self._under_way + away, 0)
            rank = np.argsort(np.argsort(-self._under_way, kind="stable")).astype(np.int32)
        else:
            self._under_way = np.zeros(len(problem), np.int64)
        self._goals = problem.goals
        return self._planner.solve(problem, budget, rank, self._roadmap)
