"""A session of the navigator `waypoints`. Each control period checks progress, commands, detours and recovers."""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.api.navigator import NavigatorSession
from mrpbench_core.builtin.navigators.controller_server import ControllerServer
from mrpbench_core.builtin.navigators.detours import Detours
from mrpbench_core.builtin.navigators.obstructions import obstruction
from mrpbench_core.builtin.navigators.progress_checker import ProgressChecker
from mrpbench_core.builtin.navigators.recovery_manager import RecoveryManager
from mrpbench_core.builtin.navigators.rotations import Rotations
from mrpbench_core.builtin.navigators.route_follower import RouteFollower
from mrpbench_core.model.common.arrays import Bool, Byte, Float, Int, Int32
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.motion import Event, Mode, Motion
from mrpbench_core.model.execution.observation import FleetObservation, Observations
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.worlds.world import World

_FOLLOWING, _WAITING, _RECOVERING, _ABORTED = (
    np.uint8(mode) for mode in (Mode.FOLLOWING, Mode.WAITING, Mode.RECOVERING, Mode.ABORTED)
)


@attrs.frozen(kw_only=True)
class WaypointsSession(NavigatorSession):
    """Drives a fleet along its routes."""

    follower: RouteFollower
    controllers: ControllerServer
    progress_checker: ProgressChecker
    detours: Detours
    recoveries: RecoveryManager
    rotations: Rotations
    xy_goal_tolerance: float
    fleet: Fleet
    world: World

    def adopt(self, routes: Sequence[Route], cut: Int32 | None = None) -> None:
        """Follow new routes; robots that gave up try again."""
        self.follower.adopt(routes, cut)
        if cut is not None:
            self.rotations.cut(cut)
        self.detours.cancel_all()
        self.recoveries.reset()

    def step(self, now: float, observation: FleetObservation, orders: Orders) -> Motion:
        """Command all robots for one control period."""
        pose, measured = observation.estimate.pose, observation.odometry.twist
        follower, recoveries = self.follower, self.recoveries
        follower.update(pose, measured, orders.released, observation.level)
        self.rotations.update(now, orders)
        rotating = self.rotations.rotating
        self.detours.shorten(pose, rotating)
        foot = follower.foot(pose)
        under_way = follower.under_way(pose) & ~recoveries.aborted
        able = ~recoveries.aborted & ~recoveries.recovering
        following = follower.driven(pose, foot) & able & ~rotating
        speed = np.minimum(follower.speed, orders.speed) if len(orders.speed) else follower.speed
        twist, events = self._drive(now, observation, foot, speed, following.nonzero()[0])
        stuck = self.progress_checker.check(now, pose, under_way & ~recoveries.recovering & ~rotating, speed)
        stuck |= self.rotations.command(now, pose, able, twist)
        failed = self.controllers.have_failed(now, following)
        for robot in (stuck | failed).nonzero()[0].tolist():
            kind = "no_progress" if stuck[robot] else "no_command"
            reason = "" if stuck[robot] else self.controllers.failure_reason(robot)
            events.append(Event(stamp=now, kind=kind, robot=robot, detail=reason))
            if not recoveries.begin(robot, now, pose, events):
                path = follower.corners[follower.begin[robot] : follower.end[robot]]
                cause = obstruction(self.fleet, self.world, robot, pose, observation.level, path)
                detail = cause or f"{kind}: {reason}".removesuffix(": ")
                events.append(Event(stamp=now, kind="aborted", robot=robot, detail=detail))
            self.detours.cancel(robot)
            twist[robot] = 0.0
        events += recoveries.step(now, pose, measured, twist)
        return Motion(
            twist=twist,
            reached=follower.reached,
            cleared=follower.cleared,
            mode=_modes(under_way, recoveries.recovering, recoveries.aborted),
            events=tuple(events),
        )

    def _drive(
        self, now: float, observation: FleetObservation, foot: Float, speed: Float, robots: Int
    ) -> tuple[Float, list[Event]]:
        """The controllers' commands for the whole fleet f8[n,2], zero where there is none, within `speed` f8[n]."""
        twist = np.zeros((len(foot), 2))
        follower = self.follower
        rows = slice(None) if len(robots) == len(foot) else robots
        on_routes = Observations(
            now=now,
            robot=robots,
            pose=observation.estimate.pose[rows],
            twist=observation.odometry.twist[rows],
            foot=foot[rows],
            points=follower.corners,
            begin=follower.begin[rows],
            end=follower.end[rows],
            yaw=follower.yaw[rows],
            speed=speed[rows],
            tolerance=self.xy_goal_tolerance,
            scans=observation.scans,
            fleet_pose=observation.estimate.pose,
        )
        command = self.controllers.command(self.detours.apply(on_routes))
        missing = np.isnan(command[:, 0])
        events = self.detours.request(on_routes, missing)
        twist[robots] = np.where(missing[:, None], 0.0, command)
        return twist, events


def _modes(under_way: Bool, recovering: Bool, aborted: Bool) -> Byte:
    mode = np.where(under_way, _FOLLOWING, _WAITING)
    mode[recovering] = _RECOVERING
    mode[aborted] = _ABORTED
    return mode
