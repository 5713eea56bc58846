"""The navigator: drives each robot along what is released to it, checks its progress, and says how far it got.

Checks, recoveries and their order are those of Nav2 (Macenski et al., "The Marathon 2: A Navigation System", IROS
2020), by its names.
"""

from collections.abc import Sequence
from typing import Literal

import attrs
import numpy as np
from attrs.validators import ge, gt

from mrpbench_core.api import Controller, FleetControllerSession, Navigator, NavigatorSession, option
from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.api.recovery import Recovery
from mrpbench_core.builtin.navigators.detours import Detours
from mrpbench_core.builtin.navigators.followers import Followers
from mrpbench_core.builtin.navigators.progress import Progress
from mrpbench_core.builtin.navigators.rescue import Rescue
from mrpbench_core.builtin.recoveries.back_up import BackUp
from mrpbench_core.builtin.recoveries.clear import Clear
from mrpbench_core.builtin.recoveries.spin import Spin
from mrpbench_core.builtin.recoveries.wait import Wait
from mrpbench_core.model.arrays import Bool, Float
from mrpbench_core.model.execution import Event, FleetObservation, Mode, Motion, Observations, Orders, Route
from mrpbench_core.model.fleet import Fleet
from mrpbench_core.model.world import World

_FOLLOWING, _WAITING, _RECOVERING, _ABORTED = (
    np.uint8(mode) for mode in (Mode.FOLLOWING, Mode.WAITING, Mode.RECOVERING, Mode.ABORTED)
)


@attrs.frozen(kw_only=True)
class Waypoints(Navigator):
    """Follows the released part of each path and stops at its end."""

    waypoints: Literal["pass", "stop"] = option(
        "pass",
        help="drive through released waypoints on the way, or stop at each and turn to the next as MRP-Bench did",
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
    stateful: bool = option(True, help="once at the end of the path, only the yaw is checked")
    required_movement_radius: float = option(
        0.5, help="a robot under way makes progress when it moves this far", unit="m", validator=gt(0)
    )
    movement_time_allowance: float = option(
        10.0, help="time in which it must; waiting for release does not count", unit="s", validator=gt(0)
    )
    failure_tolerance: float = option(
        0.3, help="how long the controller may know no admissible command", unit="s", validator=ge(0)
    )
    replan_period: float = option(
        1.0, help="how often a robot that does not get on asks for a way around; 0 = never", unit="s", validator=ge(0)
    )
    planner_tolerance: float = option(
        0.0,
        help="an occupied waypoint counts as reached beside it, within this distance (Nav2: 0.5); 0 = it does not",
        unit="m",
        validator=ge(0),
    )
    recoveries: tuple[Recovery, ...] = option(
        (Clear(), Spin(), Wait(), BackUp()), help="what a robot tries that does not get on, in turn"
    )
    max_recoveries: int = option(6, help="how often it tries between two waypoints before it gives up", validator=ge(0))

    def start(
        self, fleet: Fleet, world: World, routes: Sequence[Route], controller: Controller, period: float, seed: int
    ) -> NavigatorSession:
        """Begin at the start of the routes; nothing here is random."""
        del seed
        followers = Followers(routes, self, fleet.radii + fleet.radii.max(initial=0.0))
        controllers = controller.start_fleet(fleet.robots, world, period)
        return _Session(self, fleet, followers, controllers, type(controller).__name__, period)


class _Session(NavigatorSession):
    def __init__(
        self,
        options: Waypoints,
        fleet: Fleet,
        followers: Followers,
        controllers: FleetControllerSession,
        controller: str,
        period: float,
    ) -> None:
        self._followers, self._controllers, self._controller = followers, controllers, controller
        self._tolerance, self._failure_tolerance = options.xy_goal_tolerance, options.failure_tolerance
        self._progress = Progress(len(fleet), options.required_movement_radius, options.movement_time_allowance)
        self._detours = Detours(
            followers,
            controllers,
            round(options.replan_period / period),
            options.planner_tolerance,
            options.waypoint_tolerance,
        )
        named = [(_word(type(recovery)), recovery) for recovery in options.recoveries]
        self._rescue = Rescue(fleet.robots, named, options.max_recoveries, period, controllers, followers)
        self._commanded: Float = np.zeros(len(fleet))  # when each robot last had an admissible command

    def adopt(self, routes: Sequence[Route]) -> None:
        self._followers.adopt(routes)
        self._detours.cancel_all()
        self._rescue.forgive()

    def step(self, now: float, observation: FleetObservation, orders: Orders) -> Motion:
        pose, measured = observation.estimate.pose, observation.odometry.twist
        followers, rescue = self._followers, self._rescue
        followers.update(pose, measured[:, 0], orders.released, observation.level)
        self._detours.shorten(pose)
        foot = followers.foot(pose)
        under_way = followers.under_way(pose) & ~rescue.aborted
        following = followers.driven(pose, foot) & ~rescue.aborted & ~rescue.recovering
        twist, events = self._drive(now, observation, foot, following.nonzero()[0])
        stuck = self._progress.check(now, pose, under_way & ~rescue.recovering)
        silent = following & (now - self._commanded > self._failure_tolerance)
        self._commanded[~following | silent] = now
        for robot in (stuck | silent).nonzero()[0].tolist():
            if stuck[robot]:
                events.append(Event(stamp=now, kind="no_progress", robot=robot))
            else:
                excuse = self._controllers.excuse(robot)
                events.append(Event(stamp=now, kind="no_command", robot=robot, detail=excuse))
            events += rescue.begin(robot, now, pose)
            self._detours.cancel(robot)
            twist[robot] = 0.0
        events += rescue.step(now, pose, measured, twist)
        return Motion(
            twist=twist,
            reached=followers.reached,
            cleared=followers.cleared,
            mode=_modes(under_way, rescue.recovering, rescue.aborted),
            events=tuple(events),
        )

    def _drive(
        self, now: float, observation: FleetObservation, foot: Float, robots: np.ndarray
    ) -> tuple[Float, list[Event]]:
        """Commands of the controllers for the whole fleet f8[n,2], zero where there is none."""
        twist = np.zeros((len(foot), 2))
        followers = self._followers
        rows = slice(None) if len(robots) == len(foot) else robots
        seen = Observations(
            now=now,
            robot=robots,
            pose=observation.estimate.pose[rows],
            twist=observation.odometry.twist[rows],
            foot=foot[rows],
            points=followers.corners,
            begin=followers.begin[rows],
            end=followers.end[rows],
            yaw=followers.yaw[rows],
            speed=followers.speed[rows],
            tolerance=self._tolerance,
            scans=observation.scans,
            fleet_pose=observation.estimate.pose,
        )
        command = self._controllers.command(self._detours.lay(seen))
        self._check(command, robots)
        silent = np.isnan(command[:, 0])
        events = self._detours.look(seen, silent)
        twist[robots] = np.where(silent[:, None], 0.0, command)
        self._commanded[robots[~silent]] = now
        return twist, events

    def _check(self, command: object, robots: np.ndarray) -> None:
        """Blame the controller for what is no command."""
        who = f"the controller {self._controller}"
        if not isinstance(command, np.ndarray) or command.shape != (len(robots), 2):
            raise BrokenContractError(f"{who} returned {command!r} instead of f8[{len(robots)},2]")
        if np.isfinite(command).all():
            return
        wrong = ~np.isfinite(command).all(axis=1) & ~np.isnan(command).all(axis=1)
        if wrong.any():
            row = int(wrong.argmax())
            raise BrokenContractError(f"{who} returned {command[row].tolist()} for robot {robots[row]}")


def _modes(under_way: Bool, recovering: Bool, aborted: Bool) -> np.ndarray:
    mode = np.where(under_way, _FOLLOWING, _WAITING)
    mode[recovering] = _RECOVERING
    mode[aborted] = _ABORTED
    return mode


def _word(cls: type) -> str:
    """`back_up` for `BackUp`."""
    return "".join(f"_{letter.lower()}" if letter.isupper() else letter for letter in cls.__name__).lstrip("_")
