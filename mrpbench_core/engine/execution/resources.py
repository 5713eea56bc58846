"""Assigns doors, lifts and mutexes of a roadmap to the robots that request them, the longest requested first."""

from collections.abc import Mapping, Sequence, Set

import numpy as np

from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.planning.problem import Problem


class ExecutionError(Exception):
    """The execution cannot go on; the message says why."""


class Resources:
    """The resources of one execution: a robot holds one from when there is room until it no longer requests it."""

    def __init__(self, problem: Problem) -> None:
        self._resources = {resource.name: resource for resource in problem.roadmap.resources}
        self._number = {name: index for index, name in enumerate(self._resources)}
        self._robots = len(problem)
        self._held: dict[str, list[int]] = {name: [] for name in self._resources}
        self.holders: Mapping[str, Sequence[int]] = self._held
        """The robots that hold each resource."""
        self.ready: tuple[tuple[int, str], ...] = ()
        """(robot, resource) pairs that robots may use."""
        self._requests: Sequence[tuple[int, str]] = ()

    def assign(self, now: float, requests: Sequence[tuple[int, str]], broken: Set[str] = frozenset()) -> None:
        """Take back what is no longer requested, and assign what there is room for, the longest requested first.

        Args:
            now: simulated seconds.
            requests: (robot, resource) pairs.
            broken: resources that are not assigned to more robots.

        Raises:
            ExecutionError: the dispatcher requests a resource that does not exist.
        """
        self._requests = requests
        for name, holders in self._held.items():
            if holders:
                keep = [robot for robot in holders if (robot, name) in requests]
                self._left(now, name, len(holders) - len(keep))
                holders[:] = keep
        for robot, name in requests:
            if name not in self._resources:
                raise ExecutionError(f"the dispatcher asked for {name!r}, which the roadmap does not have")
            holders = self._held[name]
            used = len(holders) + self._in_setup(now, name)
            if robot not in holders and name not in broken and used < self._resources[name].capacity:
                holders.append(robot)

    def _left(self, now: float, name: str, robots: int) -> None:
        """Note that so many robots have left a resource."""

    def _in_setup(self, now: float, name: str) -> int:  # noqa: ARG002 - for those that know
        """The number of places of a resource that robots have left and that cannot be used yet."""
        return 0

    def waits_for(self) -> Int32:
        """The number i4[n] of the resource that each robot has asked for and may not use yet, -1 = none."""
        waits: Int32 = np.full(self._robots, -1, np.int32)
        for robot, name in self._requests:
            if waits[robot] < 0 and (robot, name) not in self.ready:
                waits[robot] = self._number[name]
        return waits


class PlannedResources(Resources):
    """Resources by the plan's model of them: a robot may use what it holds, and setup takes its time."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem)
        self._tick = problem.roadmap.tick
        self._free_at: dict[str, list[float]] = {name: [] for name in self._resources}
        """Times at which places that robots have left can be used again."""

    def assign(  # noqa: D102 - as above
        self, now: float, requests: Sequence[tuple[int, str]], broken: Set[str] = frozenset()
    ) -> None:
        super().assign(now, requests, broken)
        self.ready = tuple((robot, name) for name, holders in self._held.items() for robot in holders)

    def _left(self, now: float, name: str, robots: int) -> None:
        self._free_at[name] += [now + self._resources[name].setup_ticks * self._tick] * robots

    def _in_setup(self, now: float, name: str) -> int:
        self._free_at[name] = later = [time for time in self._free_at[name] if time > now + 1e-9]
        return len(later)
