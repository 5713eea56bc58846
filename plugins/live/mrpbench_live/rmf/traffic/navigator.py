"""The navigator `rmf`: reads how far outside robots are."""

from collections.abc import Sequence
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import (
    Controller,
    Fleet,
    FleetObservation,
    Int32,
    Mode,
    Motion,
    Navigator,
    NavigatorSession,
    Orders,
    Route,
    World,
)
from mrpbench_live.rmf.traffic.shared import traffic_of
from mrpbench_live.rmf.traffic.traffic import Traffic

SLACK = 1e-6
"""metres."""
STANDING = 0.01
"""m/s below which a robot stands."""


@attrs.frozen(kw_only=True)
class RmfProgress(Navigator):
    """Reads the progress of the robots of `simulator: rmf`. The configured `controller` is not asked.

    A robot has reached what it reports as reached, and has cleared a segment when it is so far from its start that any
    other robot fits there.
    """

    live: ClassVar[bool] = True

    def start(
        self, fleet: Fleet, world: World, routes: Sequence[Route], controller: Controller, period: float, seed: int
    ) -> NavigatorSession:
        """Begin with robots that stand at the starts.

        Raises:
            InputError: the simulator is another one.
        """
        del world, controller, period, seed
        return _Progress(traffic_of("navigator"), fleet, routes)


class _Progress(NavigatorSession):
    """Counts what robots have done."""

    def __init__(self, traffic: Traffic, fleet: Fleet, routes: Sequence[Route]) -> None:
        self._traffic = traffic
        radii = fleet.radii
        self._clearance: list[float] = (radii + radii.max(initial=0.0)).tolist()
        self._reached: Int32 = np.zeros(len(fleet), np.int32)
        self._cleared: Int32 = np.zeros(len(fleet), np.int32)
        self._take(routes)

    def adopt(self, routes: Sequence[Route], cut: Int32 | None = None) -> None:
        gone = np.zeros(len(self._reached), np.int32) if cut is None else cut
        self._reached = (self._reached - gone).astype(np.int32)
        self._cleared = np.maximum(self._cleared - gone, 0).astype(np.int32)
        self._take(routes)

    def _take(self, routes: Sequence[Route]) -> None:
        self._places = [route.waypoint[:, :2] for route in routes]
        self._is_move = [route.is_move.tolist() for route in routes]

    def step(self, now: float, observation: FleetObservation, orders: Orders) -> Motion:
        del now, observation  # what robots report is newer
        reached = np.minimum(self._traffic.reached(self._reached), orders.released).astype(np.int32)
        cleared = self._cleared.copy()
        mode = np.full(len(reached), Mode.FOLLOWING, np.uint8)
        for robot, it in enumerate(self._traffic.participants.robots):
            moves, released = self._is_move[robot], int(orders.released[robot])
            while reached[robot] < released and not moves[reached[robot]]:
                reached[robot] += 1
            assert it.pose is not None
            cleared[robot] = self._cleared_by(robot, int(cleared[robot]), int(reached[robot]), it.pose)
            if reached[robot] >= released and abs(it.speed) < STANDING:
                mode[robot] = Mode.WAITING
        self._reached, self._cleared = reached, cleared
        return Motion(twist=np.zeros((len(reached), 2)), reached=reached, cleared=cleared, mode=mode)

    def _cleared_by(self, robot: int, cleared: int, reached: int, pose: tuple[float, float, float]) -> int:
        """The leading segments whose starts a robot has left; a wait is left with the move after it."""
        places, moves, clearance = self._places[robot], self._is_move[robot], self._clearance[robot] - SLACK
        while True:
            move = next((segment for segment in range(cleared, len(moves)) if moves[segment]), None)
            if move is None or move > reached:
                return cleared
            start, end = places[move], places[move + 1]
            is_through = move < reached and np.hypot(*(end - start)) >= clearance
            if not is_through and np.hypot(pose[0] - start[0], pose[1] - start[1]) < clearance:
                return cleared
            cleared = move + 1
