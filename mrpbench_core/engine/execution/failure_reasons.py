"""Says why each robot did not arrive in an execution."""

import math
from collections import defaultdict
from collections.abc import Callable, Collection, Mapping, Sequence
from functools import cached_property

import attrs
import numpy as np

from mrpbench_core.engine.execution.faults import FaultState, approaches
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.execution.motion import Motion
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.planning.dependencies import Dependencies
from mrpbench_core.model.planning.plan import Paths, Plan
from mrpbench_core.model.planning.problem import Problem


@attrs.frozen(kw_only=True)
class FailureReasons:
    """The fleet at the end of an execution, of which `reasons` explains why robots did not arrive."""

    problem: Problem
    plan: Plan
    """In force."""
    names: Sequence[str]
    faults: FaultState
    orders: Orders
    motion: Motion
    pose: Float
    """f8[n,3] true."""
    granted: Collection[tuple[int, str]]
    """(robot, resource) pairs that robots may use."""
    holders: Mapping[str, Sequence[int]]
    """Robots that hold each resource."""
    arrived: Bool
    """bool[n]."""
    gave_up: Mapping[int, str]
    """Why robots gave up."""
    driving: Collection[int] = ()
    """Robots that drive or turn."""
    mistaken: Collection[int] = ()
    """Robots that are reported to have arrived, and stand elsewhere."""
    given_up: Collection[int] = ()
    """Robots whose tasks are given up."""
    cut_off: Collection[int] = ()
    """Robots to whose goals no way is left."""
    dispatcher_waits_for: Callable[[int], Sequence[int] | None]
    """Of the session; see `mrpbench_core.api.dispatcher`."""

    @cached_property
    def dependencies(self) -> Dependencies:
        """Of the plan, for dispatchers that do not say for whom a robot waits."""
        return Dependencies(self.problem, self.plan)

    def reasons(self) -> dict[int, str]:
        """Return the reason for each robot that did not arrive: its own, or the robot for which it waits."""
        missing = np.flatnonzero(~self.arrived).tolist()
        direct = {robot: text for robot in range(len(self.names)) if (text := self._direct(robot))}
        waiting = [robot for robot in missing if robot not in direct]
        in_way = self._in_way(waiting)
        waits = {robot: self._waits_for(robot, in_way[robot]) for robot in waiting}
        return {robot: direct.get(robot) or self._chain(robot, waits, direct) for robot in missing}

    def _direct(self, robot: int) -> str:
        """Why a robot does not go on, whatever the others do; "" = nothing keeps it."""
        if fault := self.faults.of_robot(robot):
            for_good = " for good" if math.isinf(fault.end) else ""
            what = "stopped" if fault.kind == "stop" else "became silent"
            text = f"{what}{for_good} at {fault.begin:.1f} s"
            return f"{text} and {self._failure(robot)}" if robot in self.gave_up and not for_good else text
        if robot in self.given_up:
            return "stopped, and its task was given up"
        if robot in self.gave_up:
            return self._failure(robot)
        if robot in self.mistaken:
            return f"is reported to have arrived, and stands at {self._place(robot)}"
        if robot in self.cut_off:
            obstacles = [
                f"{self.names[event.robot]} " * (event.robot >= 0) + event.what for event in self.faults.obstacles
            ]
            return f"has no way left to its goal: {' and '.join(obstacles)}"
        for other, name in self.orders.requests:
            if other == robot and (robot, name) not in self.granted and name in self.faults.broken:
                return f"waits for {name}, which is out of order"
        for blockage in self.faults.blockages:
            if (ends := self._next_move(robot)) is None:
                break
            reach = self.problem.radius[[robot]] + blockage.radius
            here, tail = np.array(blockage.place), np.array([self.pose[robot, :2]])
            if approaches(here, tail, ends[1:], reach)[0]:
                return f"stands before {blockage.what.removeprefix('the ')}"
        return self._under_way(robot) if robot in self.driving else ""

    def _failure(self, robot: int) -> str:
        return f"gave up at {self._place(robot)}: {self.gave_up[robot]}".removesuffix(": ")

    def _place(self, robot: int) -> str:
        x, y = self.pose[robot, :2]
        return f"({x:.1f}, {y:.1f})"

    def _chain(self, robot: int, waits: Mapping[int, list[int]], direct: Mapping[int, str]) -> str:
        """The robot for which one waits, and the one at the end of the chain; a breadth-first search."""
        names, came_from = self.names, {robot: robot}
        queue = [robot]
        for here in queue:
            if here in direct:
                first = here
                while came_from[first] != robot:
                    first = came_from[first]
                through = "" if first == here else f"{names[first]}, and so for "
                return f"waits for {through}{names[here]}, which {direct[here]}"
            for other in waits.get(here, []):
                if other not in came_from:
                    came_from[other] = here
                    queue.append(other)
        if waits[robot]:
            return f"waits for {names[waits[robot][0]]}"
        return self._under_way(robot)

    def _under_way(self, robot: int) -> str:
        return f"was under way at {self._place(robot)}, with {self._left[robot]:.1f} m of its path left"

    def _in_way(self, robots: Sequence[int]) -> Mapping[int, list[int]]:
        """The robots that stand where each of some robots has to drive next, the nearest first."""
        moves = {robot: ends for robot in robots if (ends := self._next_move(robot)) is not None}
        ahead, (start, end) = np.array([*moves], np.int64), np.array([*moves.values()]).reshape(-1, 2, 2).swapaxes(0, 1)
        radius, x = self.problem.radius, self.pose[:, 0]
        reach, by_x = radius.max(initial=0.0) + radius[ahead], np.argsort(x)
        low = np.searchsorted(x[by_x], np.minimum(start[:, 0], end[:, 0]) - reach)
        size = np.searchsorted(x[by_x], np.maximum(start[:, 0], end[:, 0]) + reach, side="right") - low
        row = np.repeat(np.arange(len(ahead)), size)
        other = by_x[np.arange(len(row)) + np.repeat(low - np.cumsum(size) + size, size)]
        gap = point_segment_distance(self.pose[other, :2], start[row], end[row])
        near = np.flatnonzero(gap < radius[other] + radius[ahead[row]])
        near = near[np.lexsort((other[near], gap[near]))]
        standing: dict[int, list[int]] = defaultdict(list)
        for robot, there in zip(ahead[row[near]].tolist(), other[near].tolist(), strict=True):
            standing[robot].append(there)
        return standing

    def _waits_for(self, robot: int, in_way: Sequence[int]) -> list[int]:
        """The robots that may keep one from going on: in its way, in its door or lift, or due to pass before it."""
        others = [
            holder
            for other, name in self.orders.requests
            if other == robot and (robot, name) not in self.granted
            for holder in self.holders.get(name, ())
        ]
        others += in_way
        awaited = self.dispatcher_waits_for(robot)
        others += self._due_before(robot) if awaited is None else awaited
        return [other for other in dict.fromkeys(others) if other != robot]

    def _due_before(self, robot: int) -> list[int]:
        """The robots that pass before a robot in the plan, and have not passed."""
        move = self.dependencies.next_move(robot, int(self.orders.released[robot]))
        if move is None:
            return []
        known = self.faults.last_view or self.motion
        return [
            other
            for other, needed, reached in self.dependencies.of(move)
            if (known.reached if reached else known.cleared)[other] < needed
        ]

    def _next_move(self, robot: int) -> Float | None:
        """The ends f8[2,2] of the first move that a robot has not completed."""
        edges, (first, end) = Paths.of(self.plan.paths).edge, self._ahead[:, robot].tolist()
        while first < end and edges[first] < 0:
            first += 1
        roadmap = self.problem.roadmap
        return None if first == end else roadmap.position[roadmap.edges[edges[first]]]

    @cached_property
    def _ahead(self) -> Int:
        """Where segments i8[2,n] that robots have not completed begin and end."""
        first = Paths.of(self.plan.paths).first
        return np.stack([np.minimum(first[:-1] + self.motion.reached, first[1:]), first[1:]])

    @cached_property
    def _left(self) -> Float:
        """Metres f8[n] of each path that are not driven."""
        position, edges = self.problem.roadmap.position, self.problem.roadmap.edges
        way = np.append(np.linalg.norm(position[edges[:, 1]] - position[edges[:, 0]], axis=1), 0.0)  # a wait is -1
        driven = np.append(0.0, np.cumsum(way[Paths.of(self.plan.paths).edge]))
        left: Float = driven[self._ahead[1]] - driven[self._ahead[0]]
        return left
