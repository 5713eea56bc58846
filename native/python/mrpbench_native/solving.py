"""The solvers in one call, without other packages of mrpbench: NumPy in, NumPy out."""

import numbers
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import mrpbench_native.mapf as mapf
from mrpbench_native.algorithms import options_of
from mrpbench_native.instances import Robots, SolverRoadmap, build_instance
from mrpbench_native.roadmaps import Arrays, DirectedGraph, Grid

_BYTES_PER_VERTEX = 48
"""Least memory of a roadmap, before a solver begins to count."""


@dataclass(frozen=True)
class Solution:
    """The result of a solver."""

    status: str
    """solved | timeout | out_of_memory | unsolvable (proved) | gave_up (by a solver that is incomplete)."""
    paths: tuple[NDArray[np.int64], ...] = ()
    """One for each robot if there is a plan. On a grid i8[t+1,2]: row and column at every tick from 0 until the robot
    stays at its goal. On a graph i8[k,2]: each vertex that the robot visits, and the tick of its arrival there."""
    cost: int | None = None
    """Sum over robots of the tick from which each stays at its goal."""
    makespan: int | None = None
    """The latest of these ticks."""
    lower_bound: float = float("nan")
    """Proved lower bound on the cost, NaN if none."""
    seconds: float = 0.0
    """Wall time of the solver, distance tables included."""
    cpu_seconds: float = 0.0
    """CPU time of this process; on a busy machine a fairer measure than `seconds`."""
    clock_bound: bool = False
    """The clock ended the search for a better plan."""
    statistics: Mapping[str, int] = field(default_factory=dict)
    history: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 3)))
    """f8[h,3]: seconds, cost of the best plan until then, lower bound."""


def solve(
    roadmap: DirectedGraph | Grid | NDArray[np.bool_],
    starts: ArrayLike,
    goals: ArrayLike | Sequence[ArrayLike],
    *,
    algorithm: str = "eecbs",
    time_limit: float = 60.0,
    memory_limit: int = 4 << 30,
    **options: Any,
) -> Solution:
    """Find paths without conflicts for several robots.

    Two robots must not be at one vertex at the same time, nor pass each other on an edge; they stay at their goals.

    Args:
        roadmap: a `DirectedGraph`, a `Grid`, or bool[rows, columns], true where free.
        starts: on a grid int[n,2], row and column of each robot; on a graph int[n].
        goals: likewise; or a list with several candidates for each robot, of which it takes one that no other robot
            takes (robots stay, so no two can end at one place). `cbs`, `cbs_ta` and `ita_cbs` make the choice of least
            cost, `ecbs`, `eecbs`, `ecbs_ta` and `ita_ecbs` one within `w` times that cost, the others any feasible one.
        algorithm: one of `ALGORITHMS`.
        time_limit: seconds of wall time, at least 0; infinite = no limit.
        memory_limit: bytes that the solver may allocate. It counts the roadmap, tables, nodes and plans before it
            allocates them, and ends as `out_of_memory`, or with the best plan until then. It does not count the memory
            of Python (some 50 bytes for each cell of a grid) and of the paths that are returned.
        options: of the algorithm, such as `w` of `eecbs`; `options_of(algorithm)` lists them.

    Raises:
        ValueError: the roadmap, a place, the algorithm, a limit or an option is not valid.

    Example:
        >>> solution = solve(np.ones((8, 8), bool), [[0, 0], [0, 7]], [[7, 7], [7, 0]], algorithm="cbs")
        >>> solution.status, solution.cost
        ('solved', 28)
    """
    place = roadmap if isinstance(roadmap, DirectedGraph | Grid) else Grid(roadmap)
    known = options_of(algorithm)
    _require_limits(time_limit, memory_limit)
    if unknown := sorted(set(options) - set(known)):
        raise ValueError(f"{algorithm} has no option {unknown[0]!r}; it has: {', '.join(known) or 'none'}")
    arrays = place.arrays
    first = place.vertex(starts, "starts")
    candidates = _goal_sets(place, goals)
    if arrays.vertices * _BYTES_PER_VERTEX > memory_limit:
        return Solution(status="out_of_memory")
    instance = _instance(arrays, first, candidates)
    began, began_cpu = time.perf_counter(), time.process_time()
    answer = mapf.solve(instance, algorithm, options, wall_s=float(time_limit), memory_bytes=int(memory_limit))
    seconds, cpu_seconds = time.perf_counter() - began, time.process_time() - began_cpu
    return replace(_solution(arrays, first, answer), seconds=seconds, cpu_seconds=cpu_seconds)


def _require_limits(time_limit: object, memory_limit: object) -> None:
    if not isinstance(time_limit, numbers.Real) or not float(time_limit) >= 0:
        raise ValueError(f"time_limit: seconds from 0 are needed, not {time_limit!r}")
    if not isinstance(memory_limit, numbers.Integral) or not 0 <= int(memory_limit) < 2**63:
        raise ValueError(f"memory_limit: a whole number of bytes from 0 is needed, not {memory_limit!r}")


def _goal_sets(place: DirectedGraph | Grid, goals: Any) -> list[NDArray[np.int32]]:
    """The candidates of each robot."""
    try:
        each = list(goals)
        dimensions = {np.ndim(goal) for goal in each}
    except (TypeError, ValueError) as error:
        raise ValueError("goals: one for each robot, or a list of candidates for each") from error
    single = 1 if isinstance(place, Grid) else 0
    if dimensions <= {single}:
        return list(place.vertex(each, "goals")[:, None]) if each else []
    if dimensions != {single + 1}:
        raise ValueError("goals: one for each robot, or a list of candidates for each")
    return [np.unique(place.vertex(candidates, f"goals of robot {robot}")) for robot, candidates in enumerate(each)]


def _instance(arrays: Arrays, starts: NDArray[np.int32], goals: list[NDArray[np.int32]]) -> mapf.Instance:
    if len(goals) != len(starts):
        raise ValueError(f"goals: {len(goals)} for {len(starts)} robots")
    position = np.zeros((arrays.vertices, 2)) if arrays.cell is None else arrays.cell.astype(float, order="C")
    return build_instance(SolverRoadmap(position, arrays.edges, arrays.duration[None]), Robots(starts, goals))


def _solution(arrays: Arrays, starts: NDArray[np.int32], answer: mapf.Answer) -> Solution:
    found = Solution(
        status=answer.status,
        lower_bound=answer.lower_bound,
        clock_bound=answer.clock_bound,
        statistics=answer.statistics,
        history=answer.history,
    )
    if len(answer.first) != len(starts) + 1:
        return found
    visits = [
        _visits(arrays, int(start), answer.edge[first:last], answer.leave[first:last])
        for start, (first, last) in zip(starts, pairwise(answer.first.tolist()), strict=True)
    ]
    arrival = [int(visited[-1, 1]) for visited in visits]
    paths = tuple(visits if arrays.cell is None else (_every_tick(arrays.cell, visited) for visited in visits))
    return replace(found, paths=paths, cost=sum(arrival), makespan=max(arrival, default=0))


def _visits(arrays: Arrays, start: int, edge: NDArray[np.int32], leave: NDArray[np.int64]) -> NDArray[np.int64]:
    """Vertex and tick of arrival i8[k,2]; waits are left out."""
    moves = edge >= 0
    vertices = np.concatenate([[start], arrays.edges[edge[moves], 1]])
    return np.column_stack([vertices, np.concatenate([[0], leave[moves]])]).astype(np.int64)


def _every_tick(cell: NDArray[np.int64], visits: NDArray[np.int64]) -> NDArray[np.int64]:
    """Row and column i8[t+1,2] at every tick."""
    ticks = np.arange(visits[-1, 1] + 1)
    path: NDArray[np.int64] = cell[visits[np.searchsorted(visits[:, 1], ticks, side="right") - 1, 0]]
    return path
