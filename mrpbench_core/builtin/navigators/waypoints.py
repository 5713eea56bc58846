"""The navigator: drives each robot along what is released to it, checks its progress, and says how far it got.

The checks are those of Nav2 (Macenski et al., "The Marathon 2: A Navigation System", IROS 2020), by its names.
"""

from collections.abc import Sequence
from typing import Literal

import attrs
import numpy as np
from attrs.validators import ge, gt

from mrpbench_core.api import Controller, FleetControllerSession, Navigator, NavigatorSession, option
from mrpbench_core.builtin.navigators.follower import Follower
from mrpbench_core.model.arrays import Float
from mrpbench_core.model.execution import Event, FleetObservation, Motion, Observation, Orders, Route, ScanBatch
from mrpbench_core.model.fleet import Fleet
from mrpbench_core.model.world import World


@attrs.frozen(kw_only=True)
class Waypoints(Navigator):
    """Follows the released part of each path and stops at its end."""

    waypoints: Literal["pass", "stop"] = option(
        "pass", help="drive through released waypoints on the way, or stop at each as the original benchmark did"
    )
    waypoint_tolerance: float = option(
        0.10,
        help="a waypoint on the way is reached within this distance, or when passed that close",
        unit="m",
        validator=gt(0),
    )
    xy_goal_tolerance: float = option(
        0.10, help="distance within which the end of the path is reached (Nav2: 0.25)", unit="m", validator=gt(0)
    )
    yaw_goal_tolerance: float = option(
        0.25,
        help="error of yaw within which the end of the path is reached, if it prescribes one, radians",
        validator=gt(0),
    )
    required_movement_radius: float = option(
        0.5, help="a robot under way makes progress when it moves this far", unit="m", validator=gt(0)
    )
    movement_time_allowance: float = option(
        10.0, help="time in which it must; waiting for release does not count", unit="s", validator=gt(0)
    )
    max_recoveries: int = option(
        6, help="how often a robot without progress tries again before it gives up", validator=ge(0)
    )

    def start(
        self, fleet: Fleet, world: World, routes: Sequence[Route], controller: Controller, period: float, seed: int
    ) -> NavigatorSession:
        """Begin at the start of the routes; nothing here is random."""
        del seed
        widest = float(fleet.radii.max(initial=0.0))
        followers = [
            Follower(route, self, robot.radius + widest) for route, robot in zip(routes, fleet.robots, strict=True)
        ]
        return _Session(followers, controller.start_fleet(fleet.robots, world, period))


class _Session(NavigatorSession):
    def __init__(self, followers: Sequence[Follower], controllers: FleetControllerSession) -> None:
        self._followers = followers
        self._controllers = controllers

    def adopt(self, routes: Sequence[Route]) -> None:
        for follower, route in zip(self._followers, routes, strict=True):
            follower.adopt(route)

    def step(self, now: float, observation: FleetObservation, orders: Orders) -> Motion:
        pose = observation.estimate.pose
        released = orders.released.tolist()
        events: list[Event] = []
        seen: dict[int, Observation] = {}
        scans = _by_robot(observation.scans)
        twists: Float = observation.odometry.twist
        for robot, (follower, here, speed) in enumerate(
            zip(self._followers, pose.tolist(), twists[:, 0].tolist(), strict=True)
        ):
            x, y, yaw = here
            for kind in follower.update(now, x, y, yaw, speed, released[robot]):
                events.append(Event(stamp=now, kind=kind, robot=robot))
                if kind == "no_progress":
                    self._controllers.sessions[robot].clear()
            path = follower.path(x, y, yaw)
            if path is not None:
                seen[robot] = Observation(
                    now=now,
                    pose=pose[robot],
                    twist=twists[robot],
                    path=path,
                    yaw=follower.yaw,
                    speed=follower.speed,
                    scan=scans.get(robot),
                )
        twist = np.zeros((len(self._followers), 2))
        for robot, command in self._controllers.command(seen).items():
            if command is not None:
                twist[robot, 0], twist[robot, 1] = command  # a bare number is refused, not taken for both
        return Motion(
            twist=twist,
            reached=np.array([follower.reached for follower in self._followers], np.int32),
            cleared=np.array([follower.cleared for follower in self._followers], np.int32),
            mode=np.array([follower.mode for follower in self._followers], np.uint8),
            events=tuple(events),
        )


def _by_robot(batches: Sequence[ScanBatch]) -> dict[int, ScanBatch]:
    """The newest scan of each robot, one row each."""
    return {
        robot: ScanBatch(stamp=batch.stamp, robot=batch.robot[row : row + 1], ranges=batch.ranges[row : row + 1])
        for batch in batches
        for row, robot in enumerate(batch.robot.tolist())
    }
