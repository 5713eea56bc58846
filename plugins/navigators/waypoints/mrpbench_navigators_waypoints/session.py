"""A session of the navigator `waypoints`. Each control period checks progress, commands, detours and recovers."""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.api.navigator import NavigatorSession
from mrpbench_core.model.common.arrays import Bool, Float, Int32, read_only
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.motion import Event, Motion
from mrpbench_core.model.execution.observation import FleetObservation, Observations
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.worlds.world import World
from mrpbench_navigators_waypoints.approaches import Approaches
from mrpbench_navigators_waypoints.controller_server import ControllerServer
from mrpbench_navigators_waypoints.detours import Detours
from mrpbench_navigators_waypoints.obstructions import obstruction
from mrpbench_navigators_waypoints.recovery_manager import RecoveryManager
from mrpbench_navigators_waypoints.rotations import Rotations
from mrpbench_navigators_waypoints.route_follower import RouteFollower, Targets


@attrs.frozen(kw_only=True)
class WaypointsSession(NavigatorSession):
    """Drives a fleet along its routes."""

    follower: RouteFollower
    controllers: ControllerServer
    detours: Detours
    recoveries: RecoveryManager
    approaches: Approaches
    rotations: Rotations
    fleet: Fleet
    world: World

    def adopt(self, routes: Sequence[Route], cut: Int32 | None = None) -> None:
        """Follow new routes; robots that gave up try again."""
        self.follower.adopt(routes, cut)
        if cut is not None:
            self.rotations.cut(cut)
        self.detours.cancel_all()
        self.recoveries.reset()
        self.approaches.reset()

    def step(self, now: float, observation: FleetObservation, orders: Orders) -> Motion:
        """Command all robots for one control period."""
        pose, measured = observation.estimate.pose, observation.odometry.twist
        follower, recoveries, rotations = self.follower, self.recoveries, self.rotations
        self.controllers.observe(now, observation.scans, pose)
        follower.update(pose, measured, orders.released, observation.level)
        if orders.in_step or rotations:
            rotations.update(now, orders)
        if self.detours:
            self.detours.shorten(pose)
        targets = follower.survey(now, pose, measured, orders.speed)
        twist, events = self._drive(now, observation, targets)
        stuck = targets.stuck
        if rotations:
            able = ~recoveries.aborted & ~recoveries.recovering
            stuck = rotations.command(now, pose, able, twist) | (False if stuck is None else stuck)
        failed = self.controllers.have_failed(now)
        if failed or stuck is not None:
            self._recover(now, observation, stuck, failed, twist, events)
        if targets.blocked:
            for robot in self.approaches.find(targets.rows["robot"][targets.blocked].tolist(), pose, twist):
                recoveries.approach(robot, now, pose, events)
        if recoveries:
            events += recoveries.step(now, pose, measured, twist)
        return Motion(
            twist=read_only(twist),
            reached=follower.reached,
            cleared=follower.cleared,
            mode=follower.modes(),
            events=tuple(events),
        )

    def _recover(
        self,
        now: float,
        observation: FleetObservation,
        stuck: Bool | None,
        failed: list[int],
        twist: Float,
        events: list[Event],
    ) -> None:
        """Let robots that are `stuck` bool[n], or whose controllers have `failed`, recover or give up."""
        follower, pose = self.follower, observation.estimate.pose
        without_progress = set() if stuck is None else set(stuck.nonzero()[0].tolist())
        for robot in sorted(without_progress.union(failed)):
            if follower.is_near_path_end(robot, *pose[robot, :2].tolist()):
                follower.skip_path_end(robot)
                continue
            kind = "no_progress" if robot in without_progress else "no_command"
            reason = "" if robot in without_progress else self.controllers.failure_reason(robot)
            events.append(Event(stamp=now, kind=kind, robot=robot, detail=reason))
            if not self.recoveries.begin(robot, now, pose, events):
                path = follower.corners[follower.begin[robot] : follower.end[robot]]
                cause = obstruction(self.fleet, self.world, robot, pose, observation.level, path)
                detail = cause or f"{kind}: {reason}".removesuffix(": ")
                events.append(Event(stamp=now, kind="aborted", robot=robot, detail=detail))
            self.detours.cancel(robot)
            twist[robot] = 0.0

    def _drive(self, now: float, observation: FleetObservation, targets: Targets) -> tuple[Float, list[Event]]:
        """The controllers' commands for the whole fleet f8[n,2], zero where there is none."""
        pose, rows = observation.estimate.pose, targets.rows
        on_routes = Observations(
            now=now,
            points=self.follower.corners,
            tolerance=self.follower.tables.tolerance,
            scans=observation.scans,
            fleet_pose=pose,
            **rows,
        )
        command, missing = self.controllers.command(self.detours.apply(on_routes))
        asking, twist, robots = targets.blocked, np.zeros((len(pose), 2)), rows["robot"]
        twist[robots] = command
        if missing is not None:
            twist[robots[missing]] = 0.0
            asking = sorted({*asking, *(row for row in targets.due if missing[row])})
        return twist, self.detours.request(on_routes, asking) if asking else []
