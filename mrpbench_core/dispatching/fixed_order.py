"""Releases a plan in a fixed order in many executions at once."""

import numpy as np

from mrpbench_core.api.dispatcher import BatchSession
from mrpbench_core.dispatching.dependency_graph import DependencyGraph
from mrpbench_core.model.common.arrays import Bool, Int, Int32
from mrpbench_core.model.execution.orders import BatchOrders

_NEVER = 2**62


class FixedOrder(BatchSession):
    """Releases each move once what it depends on is met, as `OrderKeepingSession` does.

    Robots and rotations wait for one dependency at a time: while that is not met, the others do not matter.

    Args:
        graph: has the order; it needs no resources.
        released: i4[n] leading segments that are released already.
        lookahead: segments released at most beyond the one under way.
        executions: their number.
    """

    def __init__(self, graph: DependencyGraph, released: Int32, lookahead: int, executions: int) -> None:
        robots, moves = len(released), len(graph.robot)
        self._count, self._lookahead = executions * robots, lookahead
        self._released: Int = np.tile(released.astype(np.int64), executions)
        dependencies = _Dependencies(graph, executions, robots)
        first, last = np.array(graph.first, np.int64), np.array(graph.last, np.int64)
        ends = last + np.arange(robots)  # a robot has one more place than moves
        self._group: Int = np.full(moves + robots, moves)
        self._group[np.arange(moves) + graph.moves.robot] = graph.group_of_moves
        self._before: Int = np.zeros(moves + robots, np.int64)
        """The segments that are released when the move at each place is not."""
        self._before[1:][np.arange(moves) + graph.moves.robot] = graph.moves.segment + 1
        self._before[first + np.arange(robots)] = 0
        self._before[ends] = graph.lengths
        self._place: Int = np.tile(np.array(graph.frontier, np.int64) + np.arange(robots), executions)
        """The place of the first move of each robot that is not released."""
        self._free = self._before[self._place]
        self._waits = _Waits(dependencies, np.repeat(np.arange(executions) * robots, robots))
        self._rotations = _Rotations(graph, dependencies, executions, robots)

    def update(self, now: float, progress: Int) -> BatchOrders:  # noqa: ARG002 - times do not matter
        """Release the moves that no longer wait for anything."""
        counts = progress.reshape(-1)
        ahead = counts[: self._count] + (1 + self._lookahead)
        at = np.flatnonzero(self._waits.may_go(counts) & (self._free < ahead))
        while len(at):
            at = self._waits.going(counts, at, self._group[self._place[at]])
            self._place[at] += 1
            self._free[at] = self._before[self._place[at]]
            at = at[self._free[at] < ahead[at]]
        self._released = np.maximum(self._released, np.minimum(self._free, ahead))
        return BatchOrders(released=self._released.reshape(progress.shape[1:]), in_step=self._rotations.in_step(counts))


class _Dependencies:
    """What each group depends on, in rows of equal length, which are filled up with what is met."""

    def __init__(self, graph: DependencyGraph, executions: int, robots: int) -> None:
        row, number, group = graph.dependencies().T
        order = np.argsort(group, kind="stable")
        row, number, group = row[order], number[order], group[order]
        groups = len(graph.robot)
        column = np.arange(len(group)) - np.searchsorted(group, group)
        self.place: Int = np.zeros((groups + 1, int(column.max(initial=0)) + 1), np.int64)
        """The place i8[g+1,k] in the counts, for the first execution."""
        self.place[group, column] = row // robots * (executions * robots) + row % robots
        self.number: Int = np.zeros(self.place.shape, np.int64)
        """The number i8[g+1,k] that is needed there. The last group never goes."""
        self.number[group, column] = number
        self.number[groups] = _NEVER


class _Waits:
    """One dependency that is not met of each of k subjects, as far as that is known."""

    def __init__(self, dependencies: _Dependencies, offset: Int) -> None:
        self._dependencies, self._offset = dependencies, offset
        self._place: Int = np.zeros(len(offset), np.int64)
        self._number: Int = np.zeros(len(offset), np.int64)

    def may_go(self, counts: Int) -> Bool:
        """The subjects bool[k] whose known dependency is met."""
        free: Bool = counts[self._place] >= self._number
        return free

    def going(self, counts: Int, at: Int, group: Int) -> Int:
        """Those of the subjects `at` i8[j] whose `group` i8[j] depends on nothing more; note what others wait for."""
        place, number = self._dependencies.place[group] + self._offset[at][:, None], self._dependencies.number[group]
        unmet = counts[place] < number
        waits = unmet.any(axis=1)
        row = np.flatnonzero(waits)
        column, held = unmet[row].argmax(axis=1), at[row]
        self._place[held], self._number[held] = place[row, column], number[row, column]
        robots: Int = at[~waits]
        return robots


class _Rotations:
    """The rotations of a plan, in each execution."""

    def __init__(self, graph: DependencyGraph, dependencies: _Dependencies, executions: int, robots: int) -> None:
        groups = list(graph.rotations.values())
        self._count, self._robots = len(groups), robots
        self._first: Int = np.array([group[0] for group in groups], np.int64)
        size = max((len(group) for group in groups), default=0)
        self._robot: Int = np.zeros((len(groups), size), np.int64)
        self._segment: Int = np.full((len(groups), size), -1)
        for number, group in enumerate(groups):
            self._robot[number, : len(group)] = graph.moves.robot[list(group)]
            self._segment[number, : len(group)] = graph.moves.segment[list(group)]
        self._waits = _Waits(dependencies, np.repeat(np.arange(executions) * robots, len(groups)))
        self._open: Bool = np.ones(executions * len(groups), bool)
        """Neither released nor completed."""
        self._under_way: Int = np.empty(0, np.int64)

    def in_step(self, counts: Int) -> Int:
        """The members of those that are released and not completed; see `BatchOrders`."""
        if not self._count:
            return np.empty((0, 4), np.int64)
        at = np.flatnonzero(self._open & self._waits.may_go(counts))
        at = self._waits.going(counts, at, self._first[at % self._count])
        self._open[at] = False
        at = np.concatenate([self._under_way, at])
        execution, group = np.divmod(at, self._count)
        reached = counts[execution[:, None] * self._robots + self._robot[group]]
        goes = (reached <= self._segment[group]).any(axis=1)
        self._under_way, execution, group = at[goes], execution[goes], group[goes]
        number, column = np.nonzero(self._segment[group] >= 0)
        group = group[number]
        return np.stack([number, execution[number], self._robot[group, column], self._segment[group, column]], axis=1)
