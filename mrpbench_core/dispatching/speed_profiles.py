"""Speed profiles over the order in which robots pass: robots that would wait drive slowly instead of stopping.

The earliest times follow from a temporal network of the moves, as in Hönig et al., "Multi-agent path finding with
kinematic constraints" (MAPF-POST), ICAPS 2016. Each robot then has a window of times at each vertex ahead: not before
it may go on from there, and not so late that another robot, or its own last move ahead, would begin later than at the
earliest time. The shortest line through these windows, in time over distance, has the most even speed; its first piece
is the speed of the robot now. Profiles are computed anew again and again, so only that piece is.

Times are *late times*: without the time that the robot needs for the moves on the way if nothing slows it down. So the
speeds that moves, turns and limits allow differ from move to move, and what a profile spreads evenly is the delay.
"""

import copy
from typing import NamedTuple

import numpy as np

from mrpbench_core.dispatching.dependency_graph import CLEARED, REACHED, DependencyGraph
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.planning.problem import Problem

PERIOD = 1.0
"""Simulated seconds between two computations."""
AHEAD = 32
"""Moves of each robot that a profile looks ahead."""
LEAST = 0.2
"""Share of the planned speed to which robots are slowed at most; a robot that has more time stops and waits."""
_NEAR = 1e-6
"""metres"""


class Network(NamedTuple):
    """The moves ahead of n robots, at most `AHEAD` of each, as columns; column 0 is what is left of the present one.

    A robot with fewer moves has moves of no duration and length after them.
    """

    duration: Float
    """Least seconds f8[n,m] of each move."""
    length: Float
    """metres f8[n,m]."""
    before: Int
    """i8[k]: the number, row by row, of a move that another one waits for."""
    after: Int
    """i8[k]: the number of that one, of another robot."""
    lag: Float
    """Seconds f8[k] from the beginning of `before`, without delay on it, until `after` may begin."""

    @property
    def begin(self) -> Float:
        """Seconds f8[n,m+1] until each robot begins each move, and ends the last one, if nothing slows it down."""
        return _accumulated(self.duration)


class SpeedProfiles:
    """Computes the speed of each robot.

    Args:
        problem: being executed.
        graph: has the current order.
        margin: seconds by which robots come later than they may go on at the earliest.
    """

    def __init__(self, problem: Problem, graph: DependencyGraph, margin: float) -> None:
        moves, roadmap = graph.moves, problem.roadmap
        self._graph, self._margin = graph, margin
        self._duration = roadmap.duration[problem.profile[moves.robot], moves.edge] * roadmap.tick
        self._head = roadmap.position[moves.head]
        offset = self._head - roadmap.position[moves.tail]
        self._length: Float = np.hypot(offset[:, 0], offset[:, 1])
        reach = (problem.radius + problem.radius.max(initial=0.0))[moves.robot]
        self._clearing = self._duration * np.minimum(1.0, reach / np.maximum(self._length, _NEAR))
        """Seconds f8[m] from the beginning of each move until its robot has left room for any other at its start."""
        self._stride = int(moves.segment.max(initial=0)) + 2
        self._place = moves.robot * self._stride + moves.segment

    def of(self, graph: DependencyGraph) -> "SpeedProfiles":
        """The same for a copy of the graph."""
        twin = copy.copy(self)
        twin._graph = graph
        return twin

    def speed(self, counts: Int, position: Float) -> Float:
        """The speed f8[n] m/s that each robot should not exceed now, inf = any.

        Args:
            counts: counts i8[2,n] of leading segments reached and cleared.
            position: f8[n,2] metres.
        """
        network = self.network(counts, position)
        late = late_times(network)
        latest = latest_arrivals(network, late)
        distance = _accumulated(network.length)
        slope = first_slope(distance, late, latest)
        slowed = np.flatnonzero(slope > _NEAR)
        column = (network.length[slowed] > _NEAR).argmax(axis=1)
        pace = network.duration[slowed, column] / network.length[slowed, column]
        speed: Float = np.full(len(slope), np.inf)
        speed[slowed] = np.maximum(1 / (pace + slope[slowed]), LEAST / pace)
        return speed

    def network(self, counts: Int, position: Float) -> Network:
        """The moves ahead, given the same arguments, and who waits for whom as far as it is not over."""
        moves, order, group = self._graph.moves, self._graph.order, self._graph.group_of_moves
        robots = np.arange(len(position))
        present = np.searchsorted(self._place, robots * self._stride + counts[REACHED])
        count = np.clip(moves.first[1:] - present, 0, AHEAD)
        ahead = np.arange(int(count.max(initial=1)))
        move, inside = present[:, None] + ahead, ahead < count[:, None]
        move[~inside] = 0
        duration, length = np.zeros(move.shape), np.zeros(move.shape)
        duration[inside], length[inside] = self._duration[move[inside]], self._length[move[inside]]
        some = np.flatnonzero(count)
        at = present[some]
        away = self._head[at] - position[some]
        whole = self._length[at]
        share = np.where(whole > _NEAR, np.minimum(np.hypot(away[:, 0], away[:, 1]) / np.maximum(whole, _NEAR), 1), 1.0)
        if len(some):
            duration[some, 0] *= share
            length[some, 0] *= share
        row = np.where(order.completed, REACHED, CLEARED)
        waits = counts[row, moves.robot[order.before]] <= moves.segment[order.before]
        waits &= group[order.before] != group[order.after]  # robots of a rotation go together
        for end in (order.before, order.after):
            column = end - present[moves.robot[end]]
            waits &= (column >= 0) & (column < count[moves.robot[end]])
        before, after, completed = (column[waits] for column in order)
        lag = np.where(completed, self._duration[before], self._clearing[before])
        driven = np.zeros(len(self._duration))
        driven[at] = self._duration[at] * (1 - share)
        lag = np.maximum(lag - driven[before], 0.0) + self._margin
        number = moves.robot * len(ahead) + np.arange(len(moves.robot)) - present[moves.robot]
        return Network(duration, length, number[before], number[after], lag)


def late_times(network: Network) -> Float:
    """The late time f8[n,m+1] at which each robot can begin each move, and end the last one, at the earliest.

    These are longest paths, by the algorithm of Bellman and Ford. The order has no cycle, so it ends.
    """
    begin = network.begin
    late = np.zeros_like(begin)
    starts = begin[:, :-1].ravel()
    lag = starts[network.before] + network.lag - starts[network.after]
    order = np.argsort(network.after, kind="stable")
    before, after, lag = network.before[order], network.after[order], lag[order]
    target, first = np.unique(after, return_index=True)
    if not len(target):
        return late
    while True:
        moves = late[:, :-1].ravel()
        least = np.maximum.reduceat(moves[before] + lag, first)
        raised = least > moves[target] + 1e-9
        if not raised.any():
            return late
        moves[target[raised]] = least[raised]
        late[:, :-1] = moves.reshape(late[:, :-1].shape)
        np.maximum.accumulate(late, axis=1, out=late)


def latest_arrivals(network: Network, late: Float) -> Float:
    """The late time f8[n,m+1] at which each robot may come to each vertex, so that nothing begins later than at `late`.

    The last one is that at which the robot ends its last move at the earliest. A robot that comes to a vertex before
    it may go on from there has to stop.
    """
    starts, moves = network.begin[:, :-1].ravel(), late[:, :-1].ravel()
    latest = np.full(late.shape, np.inf)
    latest[:, -1] = late[:, -1]
    bound = moves[network.after] + starts[network.after] - starts[network.before] - network.lag
    rows, columns = np.divmod(network.before, max(1, network.duration.shape[1]))
    np.minimum.at(latest, (rows, columns + 1), bound)
    arrivals: Float = np.minimum.accumulate(latest[:, ::-1], axis=1)[:, ::-1]
    return arrivals


def first_slope(distance: Float, late: Float, latest: Float) -> Float:
    """The slope f8[n] of the first piece of each shortest line through windows of late times, in s/m.

    The line begins at the first of `late` and ends at the last one. Where it has to be lower at a vertex than it has to
    be right after, the robot stops, and the line leads to the first of these.

    Args:
        distance: metres f8[n,k] along the path, ascending.
        late: the least time f8[n,k] after each place, ascending.
        latest: the greatest time f8[n,k] at each place, ascending.
    """
    ahead = distance > _NEAR
    start = np.where(ahead, -np.inf, late).max(axis=1, initial=0.0)[:, None]
    apart = np.where(ahead, distance, 1.0)
    low = np.maximum.accumulate(np.where(ahead, np.maximum(late - start, 0.0) / apart, 0.0), axis=1)
    high = np.minimum.accumulate(np.where(ahead, np.maximum(latest - start, 0.0) / apart, np.inf), axis=1)
    low_before = np.hstack([np.zeros_like(start), low[:, :-1]])
    bends: Bool = low >= high
    rows, at = np.arange(len(low)), bends.argmax(axis=1)
    slope: Float = np.where(bends.any(axis=1), np.maximum(high[rows, at], low_before[rows, at]), 0.0)
    return slope


def _accumulated(values: Float) -> Float:
    return np.hstack([np.zeros((len(values), 1)), np.cumsum(values, axis=1)])
