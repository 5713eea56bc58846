"""Rotations: cycles of moves in which each robot moves to the vertex that the next one leaves.

Rule 1 of `mrpbench_core.model.planning.conflicts` lets robots follow one another closely, so that a cycle of robots may
move at once. Each then waits for the next one to clear its vertex, so they have to be released together.

How close they come. Let a robot move from (0, 0) to (c, 0), and the next one of its rotation from (c, 0) to (c, c). If
both have driven s, they are hypot(c - s, s) apart, at least c / sqrt(2). Robots do not drive exactly in step:

- `Orders.in_step` asks the navigator that no robot leads the last one of its group by more than a distance L.
- Each robot may be off its segment sideways by w.

If the first robot leads by L, and both are off by w towards each other, they are hypot(c - w - s, s - L - w) apart, at
least (c - L - 2 w) / sqrt(2). So (L + 2 w) / sqrt(2) has to be left beyond the radii. The navigator `waypoints` keeps
L = 0.02 m and w = 0.01 m (its `rotations.py`): 0.0283 m. At a bend by another angle a, the same reasoning gives
L cos(a / 2) + 2 w sin(a / 2), which is never more than that.
"""

from itertools import combinations

import numpy as np

from mrpbench_core.api.dispatcher import DispatchError
from mrpbench_core.checking.strong_components import strong_components
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.planning.conflicts import TOLERANCE
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.type2_edges import Moves, Type2Edges


def rotations(problem: Problem, moves: Moves, order: Type2Edges, margin: float) -> list[tuple[int, ...]]:
    """Groups of moves that must start together, none in two groups.

    Raises:
        DispatchError: moves wait for one another that do not form a rotation, or whose robots would come closer than
            the sum of their radii and `margin` metres even if they move in step.
    """
    groups = cycles(moves, order)
    for group in groups:
        robots = moves.robot[list(group)]
        inside = np.isin(order.before, group) & np.isin(order.after, group)
        if order.completed[inside].any() or len(np.unique(robots)) < len(robots):
            raise DispatchError(
                f"{_robots_and_vertices(moves, group)} wait for one another: the plan relies on its timing"
            )
        _check_distances(problem, moves, group, margin)
    return groups


def cycles(moves: Moves, order: Type2Edges, chosen: Bool | None = None) -> list[tuple[int, ...]]:
    """Groups of moves that wait for one another, sorted; with `chosen` bool[m], of these only."""
    along = moves.robot[1:] == moves.robot[:-1]
    if chosen is not None:
        along &= chosen[1:] & chosen[:-1]
        order = order.subset(chosen[order.before] & chosen[order.after])
    before, after = _suspects(moves, order, np.flatnonzero(along))
    return strong_components(before.tolist(), after.tolist())


def cycle_of_moves(moves: Moves, order: Type2Edges) -> Int:
    """The first move i8[m] of the group of `cycles` that each move is part of, -1 for the others."""
    cycle: Int = np.full(len(moves.robot), -1)
    for group in cycles(moves, order):
        cycle[list(group)] = group[0]
    return cycle


def _suspects(moves: Moves, order: Type2Edges, along: Int) -> tuple[Int, Int]:
    """The arcs, also those from the moves `along` paths to the next ones, that can be part of a cycle.

    A cycle comes back to the time it left, so arcs that do not go forward in the plan's time cover all of it.
    """
    before, after = np.concatenate([order.before, along]), np.concatenate([order.after, along + 1])
    back = moves.enter[before] >= moves.enter[after]
    low, high = moves.enter[after[back]], moves.enter[before[back]]
    low, high = low[np.argsort(low)], np.maximum.accumulate(high[np.argsort(low)])
    opens = np.append(True, low[1:] > high[:-1])[: len(low)]
    closes = np.append(opens[1:], True)[: len(low)]
    low, high = low[opens], high[closes]
    span = np.searchsorted(low, moves.enter, side="right") - 1
    span = np.where((span >= 0) & (moves.enter <= np.append(high, -1)[span]), span, -1)
    inside = (span[before] >= 0) & (span[before] == span[after])
    before, after = before[inside], after[inside]
    while len(before):  # leave out arcs that begin where none ends, or end where none begins
        entered, left = np.zeros(len(moves.robot), bool), np.zeros(len(moves.robot), bool)
        entered[after], left[before] = True, True
        inside = entered[before] & left[after]
        if inside.all():
            break
        before, after = before[inside], after[inside]
    return before, after


def _check_distances(problem: Problem, moves: Moves, group: tuple[int, ...], margin: float) -> None:
    position, level = problem.roadmap.position, problem.roadmap.level
    for one, other in combinations(group, 2):
        ends = moves.tail[one], moves.head[one], moves.tail[other], moves.head[other]
        if not set(level[list(ends[:2])]) & set(level[list(ends[2:])]):
            continue
        gap = distance_in_step(*(position[end] for end in ends))
        needed = float(problem.radius[moves.robot[one]] + problem.radius[moves.robot[other]]) + margin
        if gap < needed - TOLERANCE:
            raise DispatchError(
                f"{_robots_and_vertices(moves, group)} rotate, and robots {moves.robot[one]} and "
                f"{moves.robot[other]} would come within {gap:.3f} m of one another and need {needed:.3f} m, "
                f"{margin:g} m of which are the dispatcher's group_margin: use larger cells, lanes farther apart "
                "or smaller robots"
            )


def distance_in_step(a: Float, b: Float, c: Float, d: Float) -> float:
    """Least distance in metres of two points that move from `a` to `b` and from `c` to `d` at equal shares of progress.

    Seen from one, the other moves along a straight segment too.
    """
    apart, change = c - a, (d - c) - (b - a)
    squared = float(change @ change)
    share = min(max(-float(apart @ change) / squared, 0.0), 1.0) if squared > 0 else 0.0
    return float(np.hypot(*(apart + share * change)))


def _robots_and_vertices(moves: Moves, group: tuple[int, ...]) -> str:
    robots = ", ".join(str(robot) for robot in np.unique(moves.robot[list(group)]))
    vertices = ", ".join(str(vertex) for vertex in np.unique(moves.head[list(group)]))
    return f"robots {robots} at vertices {vertices}"
