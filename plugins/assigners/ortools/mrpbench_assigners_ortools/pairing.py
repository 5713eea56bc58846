"""Shared by both solvers: allowed pairs, and sum and bottleneck in terms of one least-sum problem."""

from abc import abstractmethod
from collections.abc import Callable
from typing import ClassVar, Literal

import attrs
import numpy as np

from mrpbench_core.api import Assigner, AssignmentError, option
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.planning.assignment import Assignment, AssignmentProblem

Pair = tuple[int, int]
"""Robot and task."""


@attrs.frozen(kw_only=True)
class Pairing(Assigner):
    """An assigner that finds a set of pairs with the least sum or the least largest cost."""

    optimal: ClassVar[bool] = True

    objective: Literal["sum", "bottleneck"] = option(
        "sum", help="objective: the sum of costs, or the largest cost and then the sum"
    )

    @abstractmethod
    def solve(self, costs: Float, *, bottleneck: bool) -> list[Pair] | None:
        """Return min(n, m) pairs with finite cost that minimise the sum (or the largest), None if there are none."""

    def assign(self, problem: AssignmentProblem) -> Assignment:
        """Return the best assignment."""
        costs = problem.costs
        if self.objective == "bottleneck":
            pairs = _feasible(self.solve(costs, bottleneck=True))
            largest = max((costs[pair] for pair in pairs), default=0.0)
            costs = np.where(costs <= largest, costs, np.inf)
        pairs = _feasible(self.solve(costs, bottleneck=False))
        task = np.full(len(costs), -1)
        for robot, chosen in pairs:
            task[robot] = chosen
        value: Callable[[list[float]], float] = sum if self.objective == "sum" else lambda paid: max(paid, default=0.0)
        return Assignment(task=task, cost=value([float(costs[pair]) for pair in pairs]))


def _feasible(pairs: list[Pair] | None) -> list[Pair]:
    if pairs is None:
        raise AssignmentError("no assignment gives every robot, or every task, a pair that is not forbidden")
    return pairs


def groups(costs: Float) -> tuple[list[list[Pair]], list[list[Pair]]]:
    """The allowed pairs grouped by each of the scarcer (robots or tasks), which need one each, and by the others."""
    allowed = np.isfinite(costs)
    by_robot = [[(i, j) for j in np.flatnonzero(row).tolist()] for i, row in enumerate(allowed)]
    by_task = [[(i, j) for i in np.flatnonzero(column).tolist()] for j, column in enumerate(allowed.T)]
    return (by_robot, by_task) if len(by_robot) <= len(by_task) else (by_task, by_robot)


def largest_magnitude(costs: Float) -> float:
    """The largest absolute value of the allowed costs (1 if all are zero): solvers get costs divided by it."""
    return float(np.abs(costs[np.isfinite(costs)]).max(initial=0.0)) or 1.0
