"""The navigator `waypoints`: drives each robot along the released part of its path, and reports its progress.

Checks, recoveries and their order are those of Nav2, by its names (Macenski et al., "The Marathon 2: A Navigation
System", IROS 2020).
"""

from collections.abc import Sequence
from typing import Literal

import attrs
from attrs.validators import ge, gt

from mrpbench_core.api import Controller, Navigator, NavigatorSession, option
from mrpbench_core.api.recovery import Recovery
from mrpbench_core.builtin.navigators.controller_server import ControllerServer
from mrpbench_core.builtin.navigators.detours import DetourOptions, Detours
from mrpbench_core.builtin.navigators.progress_checker import ProgressChecker
from mrpbench_core.builtin.navigators.recovery_manager import RecoveryManager, RecoveryOptions
from mrpbench_core.builtin.navigators.rotations import Rotations
from mrpbench_core.builtin.navigators.route_follower import RouteFollower
from mrpbench_core.builtin.navigators.route_tables import ArrivalRules
from mrpbench_core.builtin.navigators.session import WaypointsSession
from mrpbench_core.builtin.recoveries.back_up import BackUp
from mrpbench_core.builtin.recoveries.clear import Clear
from mrpbench_core.builtin.recoveries.spin import Spin
from mrpbench_core.builtin.recoveries.wait import Wait
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class Waypoints(Navigator):
    """Follows the released part of each path and stops at its end."""

    waypoints: Literal["pass", "stop"] = option(
        "pass",
        help="drive through released waypoints on the way, or stop at each and turn to the next as MRP-Bench did",
    )
    waypoint_tolerance: float = option(
        0.10,
        help="a waypoint on the way is reached within this distance, or when the robot passes it that close",
        unit="m",
        validator=gt(0),
    )
    xy_goal_tolerance: float = option(
        0.10, help="distance within which the end of the path is reached (Nav2: 0.25)", unit="m", validator=gt(0)
    )
    yaw_goal_tolerance: float = option(
        0.25,
        help="error of yaw within which the end of the path is reached, if the path prescribes a yaw, radians",
        validator=gt(0),
    )
    stateful: bool = option(True, help="check only the yaw once a robot has been at the end of the path")
    required_movement_radius: float = option(
        0.5, help="a robot under way makes progress when it moves this far", unit="m", validator=gt(0)
    )
    movement_time_allowance: float = option(
        10.0,
        help="time within which a robot has to make progress; waiting for release does not count",
        unit="s",
        validator=gt(0),
    )
    failure_tolerance: float = option(
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
        (Clear(), Spin(), Wait(), BackUp()), help="recoveries of a robot that is stuck, in turn"
    )
    max_recoveries: int = option(
        6, help="recoveries that a robot tries between two waypoints before it gives up", validator=ge(0)
    )

    def idle_options(self) -> dict[str, str]:
        """Return options that the others make idle."""
        idle = {}
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
        """Begin at the start of the routes; nothing here is random."""
        del seed
        follower = RouteFollower(routes, self.arrival_rules, fleet.radii + fleet.radii.max(initial=0.0))
        controllers = controller.start_fleet(fleet.robots, world, period)
        detours = DetourOptions(
            every=round(self.replan_period / period),
            planner_tolerance=self.planner_tolerance,
            waypoint_tolerance=self.waypoint_tolerance,
        )
        recoveries = RecoveryOptions(recoveries=self.recoveries, max_recoveries=self.max_recoveries, period=period)
        return WaypointsSession(
            follower=follower,
            controllers=ControllerServer(len(fleet), controllers, type(controller).__name__, self.failure_tolerance),
            progress_checker=ProgressChecker(len(fleet), self.required_movement_radius, self.movement_time_allowance),
            detours=Detours(follower, controllers, detours),
            recoveries=RecoveryManager(fleet.robots, recoveries, controllers, follower),
            rotations=Rotations(follower, fleet.robots, period, self.movement_time_allowance),
            xy_goal_tolerance=self.xy_goal_tolerance,
            fleet=fleet,
            world=world,
        )

    @property
    def arrival_rules(self) -> ArrivalRules:
        """When a waypoint counts as reached."""
        return ArrivalRules(
            stops=self.waypoints == "stop",
            waypoint_tolerance=self.waypoint_tolerance,
            xy_goal_tolerance=self.xy_goal_tolerance,
            yaw_goal_tolerance=self.yaw_goal_tolerance,
            stateful=self.stateful,
        )
