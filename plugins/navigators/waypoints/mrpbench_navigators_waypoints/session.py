"""A session of the navigator `waypoints`. Each control period checks progress, commands, detours and recovers."""

from collections.abc import Sequence
from typing import Any

import attrs
import numpy as np

from mrpbench_core.api.navigator import NavigatorSession
from mrpbench_core.model.common.arrays import Bool, Byte, Float, Int, Int32
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.motion import Event, Mode, Motion
from mrpbench_core.model.execution.observation import FleetObservation, Observations
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.worlds.world import World
from mrpbench_navigators_waypoints.controller_server import ControllerServer
from mrpbench_navigators_waypoints.detours import Detours
from mrpbench_navigators_waypoints.obstructions import obstruction
from mrpbench_navigators_waypoints.progress_checker import ProgressChecker
from mrpbench_navigators_waypoints.recovery_manager import RecoveryManager
from mrpbench_navigators_waypoints.rotations import Rotations
from mrpbench_navigators_waypoints.route_follower import RouteFollower

_MODES = np.array([Mode.WAITING, Mode.FOLLOWING], np.uint8)
"""The mode of a robot that neither recovers nor has given up, by whether it is under way."""


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
        follower, recoveries, rotations = self.follower, self.recoveries, self.rotations
        follower.update(pose, measured, orders.released, observation.level)
        rotations.update(now, orders)
        self.detours.shorten(pose, rotations.rotating)
        foot = follower.foot(pose)
        under_way, following = follower.under_way(pose), follower.driven(pose, foot)
        checked = under_way
        if recoveries or rotations:
            able = ~recoveries.aborted & ~recoveries.recovering
            under_way = under_way & ~recoveries.aborted
            following = following & able & ~rotations.rotating
            checked = under_way & able & ~rotations.rotating
        speed = np.minimum(follower.speed, orders.speed) if len(orders.speed) else follower.speed
        twist, events = self._drive(now, observation, foot, speed, following.nonzero()[0])
        stuck = self.progress_checker.check(now, pose, checked, speed)
        if rotations:
            stuck = stuck | rotations.command(now, pose, able, twist)
        failed = self.controllers.have_failed(now, following)
        if failed or np.count_nonzero(stuck):
            self._recover(now, observation, stuck, failed, twist, events)
        events += recoveries.step(now, pose, measured, twist)
        return Motion(
            twist=twist,
            reached=follower.reached,
            cleared=follower.cleared,
            mode=_modes(under_way, recoveries),
            events=tuple(events),
        )

    def _recover(
        self,
        now: float,
        observation: FleetObservation,
        stuck: Bool,
        failed: list[int],
        twist: Float,
        events: list[Event],
    ) -> None:
        """Let robots that are `stuck` bool[n], or whose controllers have `failed`, recover or give up."""
        follower, pose = self.follower, observation.estimate.pose
        for robot in sorted({*stuck.nonzero()[0].tolist(), *failed}):
            kind = "no_progress" if stuck[robot] else "no_command"
            reason = "" if stuck[robot] else self.controllers.failure_reason(robot)
            events.append(Event(stamp=now, kind=kind, robot=robot, detail=reason))
            if not self.recoveries.begin(robot, now, pose, events):
                path = follower.corners[follower.begin[robot] : follower.end[robot]]
                cause = obstruction(self.fleet, self.world, robot, pose, observation.level, path)
                detail = cause or f"{kind}: {reason}".removesuffix(": ")
                events.append(Event(stamp=now, kind="aborted", robot=robot, detail=detail))
            self.detours.cancel(robot)
            twist[robot] = 0.0

    def _drive(
        self, now: float, observation: FleetObservation, foot: Float, speed: Float, robots: Int
    ) -> tuple[Float, list[Event]]:
        """The controllers' commands for the whole fleet f8[n,2], zero where there is none, within `speed` f8[n]."""
        twist, follower, pose = np.zeros((len(foot), 2)), self.follower, observation.estimate.pose
        rows: tuple[Any, ...] = (
            pose,
            observation.odometry.twist,
            foot,
            follower.begin,
            follower.end,
            follower.yaw,
            speed,
        )
        if len(robots) < len(foot):
            rows = tuple(row.take(robots, 0) for row in rows)  # which takes a quarter of the time of `row[robots]`
        on_routes = Observations(
            now=now,
            robot=robots,
            pose=rows[0],
            twist=rows[1],
            foot=rows[2],
            points=follower.corners,
            begin=rows[3],
            end=rows[4],
            yaw=rows[5],
            speed=rows[6],
            tolerance=self.xy_goal_tolerance,
            scans=observation.scans,
            fleet_pose=pose,
        )
        command, missing = self.controllers.command(self.detours.apply(on_routes))
        events = self.detours.request(on_routes, missing)
        twist[robots] = command
        if np.count_nonzero(missing):
            twist[robots[missing]] = 0.0
        return twist, events


def _modes(under_way: Bool, recoveries: RecoveryManager) -> Byte:
    mode = _MODES.take(under_way)
    if recoveries:
        mode[recoveries.recovering] = Mode.RECOVERING
        mode[recoveries.aborted] = Mode.ABORTED
    return mode
