"""The navigator `waypoints`: drives each robot along the released part of its path, and reports its progress.

Checks, recoveries and their order are those of Nav2, by its names (Macenski et al., "The Marathon 2: A Navigation
System", IROS 2020).
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

import attrs
import numpy as np
from attrs.validators import ge, gt, optional

from mrpbench_core.api import Controller, Navigator, NavigatorSession, option
from mrpbench_core.api.nav2 import controller_server, not_used, parameter, resolve_options
from mrpbench_core.api.recovery import Recovery
from mrpbench_core.files.nav2_file import Nav2File
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.worlds.world import World
from mrpbench_navigators_waypoints.approaches import Approaches
from mrpbench_navigators_waypoints.checkers import from_nav2, parameters_of, several_in
from mrpbench_navigators_waypoints.controller_server import ControllerServer
from mrpbench_navigators_waypoints.detours import Detours
from mrpbench_navigators_waypoints.recoveries.back_up import BackUp
from mrpbench_navigators_waypoints.recoveries.clear import Clear
from mrpbench_navigators_waypoints.recoveries.spin import RotateToPath, Spin
from mrpbench_navigators_waypoints.recoveries.wait import Wait
from mrpbench_navigators_waypoints.recovery_manager import RecoveryManager, RecoveryOptions
from mrpbench_navigators_waypoints.rotations import Rotations
from mrpbench_navigators_waypoints.route_follower import ProgressRules, RouteFollower
from mrpbench_navigators_waypoints.route_tables import USUAL, ArrivalRules
from mrpbench_navigators_waypoints.session import WaypointsSession

_KEEPING, _CUTTING = USUAL, 0.50
"""Metres from a waypoint on the way at which robots that keep to their routes, and robots that cut corners, pass it."""


@attrs.frozen(kw_only=True)
class Waypoints(Navigator):
    """Follows the released part of each path and stops at its end."""

    waypoints: Literal["pass", "stop"] = option(
        "pass",
        help="drive through released waypoints on the way, or stop at each and turn to the next as MRP-Bench did",
    )
    turn_ahead: bool = option(
        False, help="a robot that waits turns to the next waypoint, so that it drives off at once; needs room to turn"
    )
    waypoint_tolerance: float | None = option(
        None,
        help="a waypoint on the way is reached within this distance, or when the robot passes it that close; default: "
        "0.10. With `path_end: release` it is the distance from the route at which robots pass; default: 0.50",
        unit="m",
        validator=optional(gt(0)),
    )
    path_end: Literal["bend", "release"] = option(
        "bend",
        help="where the path for the controller ends: at the next bend, where the robot slows down and keeps to "
        "its route, or at the end of the released part, as in Nav2, where it cuts corners",
    )
    nav2: Path | None = option(
        None,
        help="a Nav2 parameter file: the goal and progress checkers and failure_tolerance of its controller_server; "
        "options given here win",
    )
    namespace: str | None = option(None, help="namespace of the robot in the Nav2 file, where namespaces differ in it")
    goal_checker: Literal["SimpleGoalChecker", "StoppedGoalChecker", "PositionGoalChecker"] | None = parameter(
        "SimpleGoalChecker",
        help="when the end of the path is reached: by place and yaw, also standing, or by place alone",
    )
    xy_goal_tolerance: float | None = parameter(
        0.10,
        help="distance within which the end of the path is reached (Nav2: 0.25); smaller, down to 0.02 m or a "
        "wider `waypoint_tolerance`, where a robot within it would not have cleared the place before",
        unit="m",
        validator=gt(0),
    )
    yaw_goal_tolerance: float | None = parameter(
        0.25,
        help="error of yaw within which the end of the path is reached, if the path prescribes a yaw, radians",
        validator=gt(0),
    )
    stateful: bool | None = parameter(True, help="check only the yaw once a robot has been at the end of the path")
    trans_stopped_velocity: float | None = parameter(
        0.25, help="speed up to which StoppedGoalChecker sees a robot stand", unit="m/s", validator=ge(0)
    )
    rot_stopped_velocity: float | None = parameter(
        0.25, help="turn rate up to which StoppedGoalChecker sees a robot stand", unit="rad/s", validator=ge(0)
    )
    progress_checker: Literal["SimpleProgressChecker", "PoseProgressChecker"] | None = parameter(
        "SimpleProgressChecker", help="what is progress: moving, or also turning"
    )
    required_movement_radius: float | None = parameter(
        0.5, help="a robot under way makes progress when it moves this far", unit="m", validator=gt(0)
    )
    required_movement_angle: float | None = parameter(
        0.5, help="to PoseProgressChecker, a robot makes progress when it turns this far, radians", validator=gt(0)
    )
    movement_time_allowance: float | None = parameter(
        10.0,
        help="time within which a robot has to make progress; waiting for release does not count",
        unit="s",
        validator=gt(0),
    )
    failure_tolerance: float | None = parameter(
        0.3, help="time for which the controller may know no admissible command", unit="s", validator=ge(0)
    )
    replan_period: float = option(
        1.0, help="time after which a robot that is stuck asks for a way around; 0 = never", unit="s", validator=ge(0)
    )
    planner_tolerance: float = option(
        0.0,
        help="an occupied waypoint counts as reached beside it, within this distance (Nav2: 0.5); 0 = it does not",
        unit="m",
        validator=ge(0),
    )
    recoveries: tuple[Recovery, ...] = option(
        (Clear(), RotateToPath(), Spin(), Wait(), BackUp()), help="recoveries of a robot that is stuck, in turn"
    )
    max_recoveries: int = option(
        6, help="recoveries that a robot tries between two waypoints before it gives up", validator=ge(0)
    )

    def __attrs_post_init__(self) -> None:
        """Read the Nav2 file, so that errors in it are found before anything runs."""
        self.settled()

    def settled(self) -> dict[str, Any]:
        """Return the values of the options that Nav2 has: those given, those of the Nav2 file, or else the defaults.

        Raises:
            InputError: the file has a checker or value that is not supported.
        """
        values = resolve_options(self)
        if self.nav2 is not None:
            checkers, _ = self._checkers(self.nav2)
            values |= {name: value for name, value in checkers.items() if getattr(self, name) is None}
        return values

    def _checkers(self, nav2: Path) -> tuple[dict[str, Any], tuple[str, ...]]:
        """Return what the Nav2 file says, and notes on what it says without effect."""
        file = Nav2File.load(nav2)

        def read(namespace: str) -> tuple[dict[str, Any], tuple[str, ...]]:
            server = controller_server(file, namespace)
            several = (f"{nav2}: {note}" for note in several_in(server))
            return from_nav2(server, type(self)), (*several, *not_used(server))

        return file.read("controller_server", self.namespace, read)

    def notes(self) -> tuple[str, ...]:
        """Return what the Nav2 file says without effect."""
        return () if self.nav2 is None else self._checkers(self.nav2)[1]

    def idle_options(self) -> dict[str, str]:
        """Return options that the others make idle."""
        idle = {} if self.nav2 else {"namespace": "there is no Nav2 file"}
        values = self.settled()
        if self.waypoints == "stop":
            idle["turn_ahead"] = "waypoints is stop, where robots turn to the next one anyway"
        goal, progress = values["goal_checker"], values["progress_checker"]
        of_goal, of_progress = parameters_of(goal), parameters_of(progress)
        for name in ("yaw_goal_tolerance", "trans_stopped_velocity", "rot_stopped_velocity"):
            if name not in of_goal:
                idle[name] = f"goal_checker is {goal}"
        if "required_movement_angle" not in of_progress:
            idle["required_movement_angle"] = f"progress_checker is {progress}"
        if not self.max_recoveries:
            idle["recoveries"] = "max_recoveries is 0"
        elif not self.recoveries:
            idle["max_recoveries"] = "there are no recoveries"
        if not self.replan_period:
            idle["planner_tolerance"] = "replan_period is 0"
        return idle

    def start(
        self, fleet: Fleet, world: World, routes: Sequence[Route], controller: Controller, period: float, seed: int
    ) -> NavigatorSession:
        """Begin at the start of the routes; only controllers draw random numbers."""
        nav2, rules = self.settled(), self.arrival_rules
        turns = nav2["progress_checker"] == "PoseProgressChecker"
        progress = ProgressRules(
            required_movement_radius=nav2["required_movement_radius"],
            movement_time_allowance=nav2["movement_time_allowance"],
            required_movement_angle=nav2["required_movement_angle"] if turns else np.inf,
            detours_every=round(self.replan_period / period),
            detours_always=self.planner_tolerance > 0,
        )
        clearances = fleet.radii + fleet.radii.max(initial=0.0)
        follower = RouteFollower(routes, rules, clearances, self.path_end == "release", progress)
        controllers = controller.start_fleet(fleet.robots, world, period, seed)
        recoveries = RecoveryOptions(recoveries=self.recoveries, max_recoveries=self.max_recoveries, period=period)
        return WaypointsSession(
            follower=follower,
            controllers=ControllerServer(controllers, type(controller).__name__, nav2["failure_tolerance"]),
            detours=Detours(follower, controllers, self.planner_tolerance, rules.waypoint_tolerance),
            approaches=Approaches(follower),
            recoveries=RecoveryManager(fleet.robots, recoveries, controllers, follower),
            rotations=Rotations(follower, fleet.robots, period, nav2["movement_time_allowance"]),
            fleet=fleet,
            world=world,
        )

    @property
    def arrival_rules(self) -> ArrivalRules:
        """When a waypoint counts as reached."""
        nav2 = self.settled()
        stands = nav2["goal_checker"] == "StoppedGoalChecker"
        tolerance = self.waypoint_tolerance
        if tolerance is None:
            tolerance = _CUTTING if self.path_end == "release" else _KEEPING
        return ArrivalRules(
            stops=self.waypoints == "stop",
            turn_ahead=self.turn_ahead,
            waypoint_tolerance=min(tolerance, _KEEPING) if self.path_end == "release" else tolerance,
            passing_tolerance=tolerance,
            xy_goal_tolerance=nav2["xy_goal_tolerance"],
            yaw_goal_tolerance=np.inf if nav2["goal_checker"] == "PositionGoalChecker" else nav2["yaw_goal_tolerance"],
            stateful=nav2["stateful"],
            trans_stopped_velocity=nav2["trans_stopped_velocity"] if stands else np.inf,
            rot_stopped_velocity=nav2["rot_stopped_velocity"] if stands else np.inf,
        )
