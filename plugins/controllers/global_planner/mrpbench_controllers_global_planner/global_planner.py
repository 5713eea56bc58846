"""The controller `global_planner`: the options of the planner, and of its global costmap by Nav2's names."""

from collections.abc import Sequence
from typing import Any

import attrs
import numpy as np
from attrs.validators import ge, gt
from mrpbench_controllers_local.costmap import LocalCostmap
from mrpbench_controllers_local.recipe import SOME_ROBOT
from mrpbench_controllers_local.settings import RobotSettings, lidar_values

from mrpbench_controllers_global_planner.session import GlobalPlannerSession, Replanning
from mrpbench_core.api import Controller, ControllerSession, FleetControllerSession, FleetOfOne, option
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.worlds.solids import segments
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class GlobalPlanner(Controller):
    """Plans a path to the end of the given one on a global costmap again and again; another controller follows it.

    With the roadmap `straight`, nothing else plans: the robot knows where to go, and of the field only what its lidar
    has seen.
    """

    primary_controller: Controller = option(help="the controller that follows the planned path")
    global_costmap: LocalCostmap | None = option(
        None,
        help="the global costmap; by default it holds the whole world wherever the robot is, has the robot's footprint "
        "and the range of its lidar, and does not know the walls (plugins: [static_layer, …] does)",
    )
    replan_frequency: float = option(1.0, help="how often each robot plans (Nav2: 1 Hz)", unit="Hz", validator=gt(0))
    tolerance: float = option(
        0.5,
        help="plan to a place at most this far from an occupied or enclosed goal (Nav2: 0.5)",
        unit="m",
        validator=ge(0),
    )

    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:
        """Begin to control one robot."""
        return FleetOfOne(self.start_fleet((robot,), world, period))

    def start_fleet(
        self, robots: Sequence[RobotModel], world: World, period: float, seed: int = 0
    ) -> FleetControllerSession:
        """Begin to control a fleet, all robots in one call.

        Raises:
            InputError: the world has several levels, or the costmap has too many cells.
        """
        if len(world.levels) > 1:
            raise InputError(f"controller: global_planner plans on one level, and {world.name} has {len(world.levels)}")
        primary = self.primary_controller.start_fleet(robots, world, period, seed)
        side = 2 * _extent(world) + 1.0
        settings = [self.settings(robot, side) for robot in robots]
        walls = segments(world) if any(each.values["static_layer"] for each in settings) else np.empty((0, 4))
        try:
            return GlobalPlannerSession(
                primary, Replanning(self.replan_frequency, self.tolerance), settings, np.ascontiguousarray(walls, float)
            )
        except ValueError as error:
            hint = "set the width, height or resolution of global_costmap"
            raise InputError(f"controller: global_planner: {error}", hint=hint) from None

    def settings(self, robot: RobotModel, side: float) -> RobotSettings:
        """Return the settings of a robot's costmap, which by default is `side` metres wide and high."""
        costmap = self.global_costmap or LocalCostmap()
        lidar_range = robot.lidar.range if robot.lidar is not None else None
        defaults: dict[str, Any] = {
            "width": side,
            "height": side,
            "footprint": "robot" if costmap.robot_radius is None else None,
            "obstacle_max_range": lidar_range,
            "raytrace_max_range": lidar_range,
            "plugins": ("obstacle_layer", "inflation_layer"),
        }
        filled = {name: value for name, value in defaults.items() if getattr(costmap, name) is None}
        values, footprint = attrs.evolve(costmap, **filled).settings(robot, None)
        values["max_detour"] = 0.0
        return RobotSettings(values | lidar_values(robot), np.array(footprint))

    @property
    def needs_lidar(self) -> bool:
        """True if the global costmap has a layer that beams mark, or the other controller works by scans."""
        return bool(self.settings(SOME_ROBOT, 3.0).values["obstacle_layer"]) or self.primary_controller.needs_lidar

    def notes(self) -> tuple[str, ...]:
        """Return the notes of the other controller."""
        return self.primary_controller.notes()

    def idle_options(self) -> dict[str, str]:
        """Return the idle options of the other controller."""
        return {f"primary_controller.{name}": why for name, why in self.primary_controller.idle_options().items()}


def _extent(world: World) -> float:
    """The longer side of the box around everything in a world, metres."""
    places = np.array([(vertex.x, vertex.y) for vertex in world.vertices]).reshape(-1, 2)
    points = np.vstack([segments(world).reshape(-1, 2), places])
    return float(np.ptp(points, axis=0).max()) if len(points) else 0.0
