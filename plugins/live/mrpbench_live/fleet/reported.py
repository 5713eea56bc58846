"""The simulation of runs whose robots are outside: what they report counts as the truth."""

import math
import sys
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence

import numpy as np

from mrpbench_core.api import (
    Facilities,
    Fleet,
    Float,
    InputError,
    Inputs,
    Int16,
    ScanBatch,
    Simulation,
    State,
    World,
)
from mrpbench_live.fleet.overlaps import Overlaps
from mrpbench_live.fleet.pace import Pace
from mrpbench_live.fleet.tracking import Tracker, corners_between, corners_of, straight_ahead

GAP_M = 0.3
"""Metres between two reports of a robot from which on it may have driven around a corner unseen."""


def refuse_surroundings(simulator: str, world: World, movers: Sequence[float]) -> None:
    """Refuse what outside robots do not know of: doors, lifts and crowds.

    Raises:
        InputError: the run has some.
    """
    if Facilities(world).names:
        raise InputError(f"simulator: `{simulator}` has no doors and no lifts, and the world has")
    if movers:
        raise InputError(f"simulator: `{simulator}` has no crowds: leave out `crowds`")


class OutsideRobots(ABC):
    """Robots on a wire."""

    @abstractmethod
    def serve(self, due: float) -> None:
        """Listen until a time of `time.monotonic`."""

    @abstractmethod
    def reports(self) -> Iterator[tuple[int, float, float, float, float]]:
        """Yield the last report of each robot that has one: its index, x, y (metres), yaw (radians), speed (m/s)."""

    def route(self, robot: int) -> Float:  # noqa: ARG002
        """Return places f8[k,2] (metres) along which a robot drives, none if unknown.

        They begin with the last one that it had passed when this was asked before: it is asked after each report of a
        new place, and reports can be missing.
        """
        return np.empty((0, 2))

    def twist(self) -> Float | None:
        """Return m/s forward and rad/s f8[n,2] as robots report them; None: as the recorded robots drive."""
        return None

    @abstractmethod
    def close(self) -> None:
        """Leave the wire."""


class ReportedFleet(Simulation):
    """Recorded robots that drive from report to report within the limits of their models.

    Args:
        outside: the robots.
        pace: of the clock.
        fleet: their models.
        placements: f8[n,3] where they stand at the beginning.
        levels: i2[n] on which they stay.
        period: simulated seconds between control periods.
    """

    def __init__(
        self, outside: OutsideRobots, pace: Pace, fleet: Fleet, placements: Float, levels: Int16, period: float
    ) -> None:
        self._outside, self._pace, self._period = outside, pace, period
        self._steps = self._listened = 0
        self._tracker, self._overlaps = Tracker(fleet.robots, placements, period), Overlaps(fleet.robots)
        self._levels, self._closed = levels, False
        self._places: list[tuple[float, float]] = [(x, y) for x, y, _ in placements.tolist()]
        """Where each robot was by its last report."""
        self._state = State(
            pose=placements.copy(), twist=np.zeros((len(fleet), 2)), level=levels, contacts=np.empty((0, 2), np.int32)
        )

    @property
    def state(self) -> State:
        """The state after the last step."""
        return self._state

    def listen(self) -> None:
        """Listen until the control period is over, once in each.

        A navigator that listens before it says what robots have reached saves one period before they may go on.
        """
        if self._listened > self._steps:
            return
        self._listened = self._steps + 1
        now = self._listened * self._period
        if self._listened == 1:
            self._pace.due(0.0)
        self._outside.serve(self._pace.due(now))
        if change := self._pace.change(now):
            sys.stderr.write(f"at {now:.1f} s: {change}\n")

    def step(self, inputs: Inputs) -> State:
        """Listen, once in each period, and move the recorded robots; the commands are for simulators."""
        del inputs
        self.listen()
        self._steps += 1
        for robot, x, y, yaw, speed in self._outside.reports():
            self._report(robot, x, y, yaw, speed)
        self._tracker.step()
        pose, twist = self._tracker.pose, self._outside.twist()
        contacts = self._overlaps.of(pose, self._levels)
        self._state = State(
            pose=pose, twist=self._tracker.twist if twist is None else twist, level=self._levels, contacts=contacts
        )
        return self._state

    def _report(self, robot: int, x: float, y: float, yaw: float, speed: float) -> None:
        """Let a recorded robot follow a report, along the route of its robot if reports are missing before it."""
        before, self._places[robot] = self._places[robot], (x, y)
        if before == (x, y):
            self._tracker.report(robot, x, y, yaw, speed)
            return
        route = corners_of(self._outside.route(robot))
        if math.dist(before, (x, y)) > GAP_M:
            for corner in corners_between(route, before, (x, y)):
                heading = math.atan2(corner[1] - before[1], corner[0] - before[0])
                self._tracker.report(robot, *corner, heading)
                before = corner
        self._tracker.report(robot, x, y, yaw, speed, straight_ahead(route, (x, y), yaw))

    def scans(self) -> tuple[ScanBatch, ...]:
        """Return nothing: lidars are on the robots."""
        return ()

    def close(self) -> None:
        """Leave the wire once."""
        if not self._closed:
            self._closed = True
            self._outside.close()
