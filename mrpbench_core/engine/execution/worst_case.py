"""The adversary of `delays.worst_case`: it stops one robot, once, before the move where that costs the fleet most.

Where robots keep the order of the plan, a move begins when the moves before it have been made. So each robot arrives at
the end of a longest path through the graph of all moves. The time of a path is linear in the delays of the moves on it;
the latest of all paths, and the sum over robots of how late they arrive, are therefore convex in these delays. A convex
function on the ways to divide k ticks is greatest where one move gets all of them. So no way to spread k ticks of stops
over robots and moves makes the arrivals later, in sum, than the best of the attacks that stop one robot for k ticks.

An attack on move m by d makes robot r late by max(0, d - slack(m, r)), where the slack is the time by which m may be
late before r is (the total float of the critical path method; Kelley and Walker, "Critical-Path Planning and
Scheduling", 1959). The slacks of all moves come from one pass over the graph, so all attacks are compared exactly.

That holds for the durations of the plan and the dispatcher `adg`. It leaves out the setup times of doors and lifts, and
control periods. Other dispatchers, relative speeds, faults and physics execute under the same attack.
"""

from collections import defaultdict

import numpy as np

from mrpbench_core.dispatching.rotations import cycle_of_moves
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_core.model.execution.motion import Event
from mrpbench_core.model.planning.occupations import occupations_of, resource_edges
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.type2_edges import Moves, Type2Edges, moves_of, type2_edges


class Adversary:
    """Stops one robot for `seconds` before one of its moves; without moves, none.

    Args:
        problem: of the run.
        plan: the first one.
        seconds: simulated, how long the robot stops.
    """

    def __init__(self, problem: Problem, plan: Plan, seconds: float) -> None:
        moves = moves_of(problem, plan)
        self._seconds, self._until = seconds, -np.inf
        self._robot, self._segment, self._ready = -1, -1, -1
        self.stopped: Bool = np.zeros(len(problem), bool)
        """bool[n]: the robot that stops."""
        if len(moves.robot):
            move = int(lateness(problem, plan, seconds).argmax())
            self._robot, self._segment = int(moves.robot[move]), int(moves.segment[move])
            is_first = move == moves.first[self._robot]
            self._ready = 0 if is_first else int(moves.segment[move - 1]) + 1

    def update(self, now: float, reached: Int | Int32, released: Int | Int32) -> tuple[Event, ...]:
        """Go to `now`; return the stop as an event when it begins: when nothing but the adversary holds the robot.

        Args:
            now: simulated seconds, which never decrease.
            reached: i[n] leading segments that each robot has completed.
            released: i[n] leading segments that it may complete.
        """
        robot, begins = self._robot, False
        if self._until == -np.inf and robot >= 0:
            begins = bool(reached[robot] >= self._ready and released[robot] > self._segment)
            self._until = now + self._seconds if begins else self._until
            self.stopped[robot] = begins
        elif now >= self._until - 1e-9:
            self.stopped[:] = False
        return (Event(stamp=now, kind="delay", robot=robot, detail=f"{self._seconds:g} s"),) if begins else ()


def lateness(problem: Problem, plan: Plan, seconds: float) -> Float:
    """Return, for each move f8[m] of a plan, the seconds by which all robots together arrive later if it begins late.

    Args:
        problem: of the plan.
        plan: whose order robots keep.
        seconds: by which the move begins late.
    """
    moves = moves_of(problem, plan)
    order = type2_edges(problem, moves, resource_edges(problem, occupations_of(problem, moves)))
    graph = _Graph(problem, moves, order)
    late: Float = graph.late(seconds)[graph.group]
    return late


class _Graph:
    """The moves of a plan; those of a rotation begin together and are one node, whose number is that of the first."""

    def __init__(self, problem: Problem, moves: Moves, order: Type2Edges) -> None:
        count, self._robots = len(moves.robot), len(problem)
        self._duration, clearing = _durations(problem, moves)
        along = np.flatnonzero(moves.robot[1:] == moves.robot[:-1])
        self.group: Int = np.arange(count)
        cyclic = cycle_of_moves(moves, order)
        for first in np.unique(cyclic[cyclic >= 0]).tolist():
            members = np.flatnonzero(cyclic == first)
            inside = (cyclic[order.before] == first) & (cyclic[order.after] == first)
            if len(np.unique(moves.robot[members])) == len(members) and not order.completed[inside].any():
                self.group[members] = first
        # A cycle that is not a rotation has no order that can be kept.
        between = (cyclic[order.before] < 0) | (cyclic[order.before] != cyclic[order.after])
        before, after = order.before[between], order.after[between]
        needs = np.where(order.completed[between], self._duration[before], clearing[before])
        arcs = np.concatenate([along, before]), np.concatenate([along + 1, after])
        self._next: dict[int, list[tuple[int, float]]] = defaultdict(list)
        for one, other, weight in zip(
            self.group[arcs[0]].tolist(),
            self.group[arcs[1]].tolist(),
            np.concatenate([self._duration[along], needs]).tolist(),
            strict=True,
        ):
            self._next[one].append((other, weight))
        self._last = {int(moves.first[robot + 1]) - 1: robot for robot in moves.robot.tolist()}

    def late(self, seconds: float) -> Float:
        """The seconds f8[m] by which all robots arrive later, at the index of each node."""
        nodes = self._sorted()
        begin = dict.fromkeys(nodes, 0.0)
        left = dict.fromkeys(nodes, 0)
        for node in nodes:
            for other, weight in self._next[node]:
                begin[other] = max(begin[other], begin[node] + weight)
                left[other] += 1
        ends: dict[int, list[tuple[int, float]]] = defaultdict(list)
        arrival = np.full(self._robots, np.inf)
        for move, robot in self._last.items():
            ends[int(self.group[move])].append((robot, float(self._duration[move])))
            arrival[robot] = begin[int(self.group[move])] + self._duration[move]
        late: Float = np.zeros(len(self.group))
        until: dict[int, Float] = {}  # seconds f8[n] from the beginning of a node to the end of each robot's path
        for node in reversed(nodes):
            longest = np.full(self._robots, -np.inf)
            for other, weight in self._next[node]:
                np.maximum(longest, until[other] + weight, out=longest)
                left[other] -= 1
                if not left[other]:
                    del until[other]
            for robot, duration in ends[node]:
                longest[robot] = max(longest[robot], duration)
            until[node] = longest
            late[node] = np.maximum(begin[node] + seconds + longest - arrival, 0.0).sum()
        return late

    def _sorted(self) -> list[int]:
        """The nodes, each after those that it waits for."""
        waiting: dict[int, int] = dict.fromkeys(self.group.tolist(), 0)
        for arcs in list(self._next.values()):
            for other, _ in arcs:
                waiting[other] += 1
        order = [node for node, count in waiting.items() if not count]
        for node in order:
            for other, _ in self._next[node]:
                waiting[other] -= 1
                if not waiting[other]:
                    order.append(other)
        return order


def _durations(problem: Problem, moves: Moves) -> tuple[Float, Float]:
    """Seconds f8[m] that each move takes, and after which its robot has cleared the start; see `ScheduleLoop`."""
    duration: Float = np.zeros(len(moves.robot))
    for robot in range(len(problem)):
        rows = slice(moves.first[robot], moves.first[robot + 1])
        duration[rows] = problem.duration(robot)[moves.edge[rows]] * problem.roadmap.tick
    position = problem.roadmap.position
    length = np.hypot(*(position[moves.head] - position[moves.tail]).T)
    reach = problem.radius[moves.robot] + problem.radius.max(initial=0.0)
    return duration, duration * np.minimum(1.0, reach / np.maximum(length, 1e-9))
