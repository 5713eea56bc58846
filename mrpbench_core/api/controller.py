"""Contract of the kind *controller*."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import ClassVar

import numpy as np

from mrpbench_core.api.component import Component
from mrpbench_core.model.arrays import Bool, Float
from mrpbench_core.model.execution import Observation
from mrpbench_core.model.fleet import RobotModel
from mrpbench_core.model.world import World


class ControllerSession(ABC):
    """Controls one robot."""

    @abstractmethod
    def command(self, observation: Observation) -> tuple[float, float] | None:
        """Return forward speed (m/s) and turn rate (rad/s), or None when no command is admissible."""

    def clear(self) -> None:  # noqa: B027 - optional: a controller without a costmap has nothing to clear
        """Forget what sensors have marked (the recovery *clear costmap*)."""

    def is_free(self, poses: Float) -> Bool:
        """Tell for each pose f8[k,3] whether the robot's footprint fits there as far as the controller knows."""
        return np.ones(len(poses), bool)

    def reroute(self, observation: Observation) -> Float | None:  # noqa: ARG002 - for those that override it
        """Return waypoints f8[k,2] around what blocks the path, or None when the controller knows none."""
        return None


class FleetControllerSession:
    """Controls all robots at once. The default loops over one session per robot."""

    def __init__(self, sessions: Sequence[ControllerSession]) -> None:
        self.sessions = tuple(sessions)

    def command(self, observations: Mapping[int, Observation]) -> dict[int, tuple[float, float] | None]:
        """Return a command for each robot in `observations`."""
        return {robot: self.sessions[robot].command(seen) for robot, seen in observations.items()}


class Controller(Component):
    """Turns a path and sensor data into wheel commands."""

    group: ClassVar[str] = "mrpbench.controllers"

    @abstractmethod
    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:
        """Begin to control one robot; `world` is the static map, `period` the control period in simulated seconds."""

    def start_fleet(self, robots: Sequence[RobotModel], world: World, period: float) -> FleetControllerSession:
        """Begin to control a fleet; override to answer for all robots in one call."""
        return FleetControllerSession([self.start(robot, world, period) for robot in robots])
