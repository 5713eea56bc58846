"""Orders of robots that were executed the other way round than planned."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.type2_edges import Type2Edges, moves_of, type2_edges
from mrpbench_core.model.runs.plans import RecordedPlan, spans

NO_EDGES = Type2Edges(*(np.empty(0, kind) for kind in (np.int64, np.int64, bool)))


class Switch(NamedTuple):
    """A robot passed another one that comes first in the plan."""

    time: float
    """Simulated second of the sample at which it had done so."""
    robot: int
    other: int
    """The robot that comes first in the plan."""


def switches(problem: Problem, plans: Sequence[RecordedPlan], time: Float, reached: Int) -> list[Switch]:
    """Return the switches of an execution, in the order of time.

    The current plan has robot i before robot j at a place if a type-2 edge leads from a move of i to a move of j
    (Hönig et al., RA-L 2019). The order is switched if j completed its move before i came to that place, whatever
    dispatcher allowed it. Consecutive places of the same two robots count once. Resources are left out.

    Args:
        problem: of the run.
        plans: of this execution, see `read_plans`.
        time: f8[T].
        reached: i4[T,n] segments that robots have completed.
    """
    changes: list[Switch] = []
    for plan, span in spans(plans, time):
        if plan.plan is not None:
            changes += _of_plan(problem, plan.plan, time[span], reached[span])
    return sorted(changes)


def _of_plan(problem: Problem, plan: Plan, time: Float, reached: Int) -> list[Switch]:
    moves = moves_of(problem, plan)
    before, after, _ = type2_edges(problem, moves, NO_EDGES)
    order = np.lexsort((before, moves.robot[before], moves.robot[after]))
    before, after = before[order], after[order]
    shared = moves.tail[before] == moves.head[after]
    came = _first(reached, moves.robot[before], moves.segment[before] + ~shared)
    passed = _first(reached, moves.robot[after], moves.segment[after] + 1)
    switched = (passed < came) & (passed > 0)
    pair = moves.robot[before] * len(problem) + moves.robot[after]
    begins = switched & ~(np.append(False, switched[:-1]) & np.append(False, pair[1:] == pair[:-1])[: len(pair)])
    rows = zip(
        time[passed[begins]].tolist(),
        moves.robot[after[begins]].tolist(),
        moves.robot[before[begins]].tolist(),
        strict=True,
    )
    return [Switch(*row) for row in rows]


def _first(reached: Int, robot: Int, count: Int) -> Int:
    """The first sample i8[k] at which each `robot` i8[k] has completed `count` i8[k] segments; T if there is none."""
    first = np.full(len(robot), len(reached))
    for one in np.unique(robot).tolist():
        rows = robot == one
        first[rows] = np.searchsorted(reached[:, one], count[rows])
    return first
