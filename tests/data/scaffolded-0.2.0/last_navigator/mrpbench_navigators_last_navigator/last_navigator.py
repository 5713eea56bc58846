"""LastNavigator: from waypoint to waypoint."""

import math
from collections.abc import Sequence

import attrs
import numpy as np
from mrpbench_core.api import Controller, Navigator, NavigatorSession, option
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.motion import Mode, Motion
from mrpbench_core.model.execution.observation import FleetObservation, Observation, ScanBatch
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class LastNavigator(Navigator):
    """Drives each robot along its released waypoints. It has no recoveries, and robots do not move in step."""

    xy_tolerance: float = option(
        0.1, help="distance at which a waypoint is reached", unit="m", validator=attrs.validators.gt(0)
    )
    yaw_tolerance: float = option(
        0.25, help="error of yaw at which the last waypoint is reached, radians", validator=attrs.validators.gt(0)
    )

    def start(
        self, fleet: Fleet, world: World, routes: Sequence[Route], controller: Controller, period: float, seed: int
    ) -> NavigatorSession:
        """Begin at the start of the routes; nothing is random."""
        del seed
        return LastNavigatorSession(self, fleet, world, routes, controller, period)


class LastNavigatorSession(NavigatorSession):
    """Drives one fleet."""

    def __init__(
        self,
        options: LastNavigator,
        fleet: Fleet,
        world: World,
        routes: Sequence[Route],
        controller: Controller,
        period: float,
    ) -> None:
        self.options = options
        self.controllers = [controller.start(robot, world, period) for robot in fleet.robots]
        self.reached = np.zeros(len(fleet), np.int32)
        self.adopt(routes)

    def adopt(self, routes: Sequence[Route], cut: Int32 | None = None) -> None:
        """Follow new routes, which begin with the released part of the old ones, but for `cut` i4[n] segments."""
        if cut is not None:
            self.reached = np.maximum(self.reached - cut, 0)
        self.routes = tuple(routes)

    def step(self, now: float, observation: FleetObservation, orders: Orders) -> Motion:
        """Return twists for one control period; a vertex is cleared when the robot has reached the next one."""
        twist = np.zeros((len(self.routes), 2))
        mode = np.full(len(self.routes), Mode.WAITING, np.uint8)
        scans = self.scans_by_robot(observation)
        for robot, released in enumerate(orders.released.tolist()):
            pose = observation.estimate.pose[robot]
            while self.reached[robot] < released and self.is_reached(robot, observation):
                self.reached[robot] += 1
            seen = self.observation(robot, released, now, observation, scans.get(robot))
            turn = math.remainder(seen.yaw - pose[2], math.tau) if math.isfinite(seen.yaw) else 0.0
            if self.reached[robot] < released or abs(turn) > self.options.yaw_tolerance:
                mode[robot] = Mode.FOLLOWING
                twist[robot] = self.controllers[robot].command(seen) or (0.0, 0.0)
        return Motion(twist=twist, reached=self.reached, cleared=self.reached, mode=mode)

    def is_reached(self, robot: int, observation: FleetObservation) -> bool:
        """Tell whether a robot is at the end of the segment under way."""
        route, ahead = self.routes[robot], self.reached[robot] + 1
        away = math.dist(observation.estimate.pose[robot, :2], route.waypoint[ahead, :2])
        return away <= self.options.xy_tolerance and bool(observation.level[robot] == route.level[ahead])

    def observation(
        self, robot: int, released: int, now: float, observation: FleetObservation, scan: ScanBatch | None
    ) -> Observation:
        """Return what the controller of one robot gets: where it is, and its way to the last released waypoint."""
        route, reached = self.routes[robot], int(self.reached[robot])
        here, ahead = route.waypoint[reached, :2], route.waypoint[min(reached + 1, released), :2]
        along, offset = ahead - here, observation.estimate.pose[robot, :2] - here
        share = np.clip(offset @ along / (along @ along), 0.0, 1.0) if along.any() else 0.0
        rest = route.waypoint[min(reached + 1, released) : released + 1, :2]
        return Observation(
            now=now,
            pose=observation.estimate.pose[robot],
            twist=observation.odometry.twist[robot],
            path=np.vstack([here + share * along, rest]),
            yaw=float(route.waypoint[released, 2]),
            speed=float(route.speed[reached]) if reached < len(route.speed) else math.inf,
            tolerance=self.options.xy_tolerance,
            scan=scan,
        )

    def scans_by_robot(self, observation: FleetObservation) -> dict[int, ScanBatch]:
        """Return the newest scan of each robot that has one."""
        return {
            robot: ScanBatch(stamp=batch.stamp, robot=batch.robot[[row]], ranges=batch.ranges[[row]])
            for batch in observation.scans
            for row, robot in enumerate(batch.robot.tolist())
        }
