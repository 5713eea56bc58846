"""Contract of the kind *controller*."""

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from mrpbench_core.api.component import Component
from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.checking.recording import LARGEST
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.execution.evaluation import Evaluation
from mrpbench_core.model.execution.observation import Observation, Observations, ScanBatch
from mrpbench_core.model.worlds.world import World


class ControllerSession(ABC):
    """Controls one robot."""

    @abstractmethod
    def command(self, observation: Observation) -> tuple[float, float] | None:
        """Return forward speed (m/s) and turn rate (rad/s), or None when no command is admissible."""

    def clear(self) -> None:  # noqa: B027 - optional: a controller without a costmap has nothing to clear
        """Forget what sensors have marked (the recovery `clear`)."""

    def is_free(self, poses: Float) -> Bool:
        """Tell bool[k] at which poses f8[k,3] the robot's footprint fits, as far as the controller knows."""
        return np.ones(len(poses), bool)

    def reroute(self, observation: Observation) -> Float | None:  # noqa: ARG002 - for those that override it
        """Return waypoints f8[k,2] around what blocks the path, or None if nothing does or there is no way.

        The last waypoint is a point of the path, from which the robot follows the path again.
        """
        return None

    def approach(self, observation: Observation, tolerance: float) -> Float | None:  # noqa: ARG002 - as `reroute`
        """Return waypoints f8[k,2] to the free place nearest to the end of the path, at most `tolerance` metres from
        it, or None if the end itself is free or there is no way.
        """
        return None

    def evaluation(self) -> Evaluation | None:
        """Return what led to the last command, None if that is not known; for recordings, and called only for these."""
        return None


class FleetControllerSession:
    """Controls all robots at once. The default loops over one session per robot.

    Args:
        sessions: one per robot, in order.
        name: name of the controller, for messages.
    """

    def __init__(self, sessions: Sequence[ControllerSession], name: str = "") -> None:
        self.sessions = tuple(sessions)
        self._name = name
        self._scans: dict[int, ScanBatch] = {}

    def observe(self, now: float, scans: tuple[ScanBatch, ...], fleet_pose: Float) -> None:
        """Begin with what follows from `Observations.scans`, the same object, and `fleet_pose` of the next `command`.

        Navigators need not call this before `command`, which begins with it otherwise.
        """

    def command(self, observations: Observations) -> Float:
        """Return forward speed (m/s) and turn rate (rad/s) f8[k,2] of all rows; NaN = no command is admissible."""
        for batch in observations.scans:
            for row, robot in enumerate(batch.robot.tolist()):
                rows = slice(row, row + 1)
                self._scans[robot] = ScanBatch(stamp=batch.stamp, robot=batch.robot[rows], ranges=batch.ranges[rows])
        twist = np.full((len(observations.robot), 2), np.nan)
        for row, robot in enumerate(observations.robot.tolist()):
            command = self.sessions[robot].command(observations.of(row, self._scans.pop(robot, None)))
            if command is None:
                continue
            try:
                ahead, turn = command
                twist[row] = float(ahead), float(turn)
            except (TypeError, ValueError, OverflowError):
                raise BrokenContractError(
                    f"the controller {self._name} returned for robot {robot} something other than (speed, turn rate) "
                    "in 64 bits, or None",
                    "controller",
                ) from None
            if not (np.abs(twist[row]) <= LARGEST).all():
                raise BrokenContractError(
                    f"the controller {self._name} returned {command!r} for robot {robot}", "controller"
                )
        return twist

    def clear(self, robot: int) -> None:
        """Forget what one robot's sensors have marked."""
        self.sessions[robot].clear()

    def is_free(self, robot: int, poses: Float) -> Bool:
        """Tell bool[k] at which poses f8[k,3] one robot's footprint fits, as far as the controller knows."""
        return self.sessions[robot].is_free(poses)

    def reroute(self, observations: Observations, row: int) -> Float | None:
        """Return waypoints f8[k,2] around what blocks the path of one row, or None; see `ControllerSession.reroute`."""
        return self.sessions[int(observations.robot[row])].reroute(observations.of(row))

    def approach(self, observations: Observations, row: int, tolerance: float) -> Float | None:
        """Return waypoints f8[k,2] to a place near the end of the path of one row; see `ControllerSession.approach`."""
        return self.sessions[int(observations.robot[row])].approach(observations.of(row), tolerance)

    def evaluation(self, robot: int) -> Evaluation | None:
        """Return what led to the last command of one robot; see `ControllerSession.evaluation`."""
        return self.sessions[robot].evaluation() if self.sessions else None

    def failure_reason(self, robot: int) -> str:  # noqa: ARG002 - for those that override it
        """Return in a few words why a robot had no admissible command, for events and logs."""
        return ""


class FleetOfOne(ControllerSession):
    """A session for one robot of a controller that commands fleets."""

    def __init__(self, fleet: FleetControllerSession) -> None:
        self._fleet = fleet

    def command(self, observation: Observation) -> tuple[float, float] | None:
        """Return the command of the only row."""
        ahead, turn = self._fleet.command(Observations.alone(observation))[0].tolist()
        return None if math.isnan(ahead) else (ahead, turn)

    def clear(self) -> None:
        """Forget what sensors have marked."""
        self._fleet.clear(0)

    def is_free(self, poses: Float) -> Bool:
        """Tell bool[k] at which poses f8[k,3] the robot fits."""
        return self._fleet.is_free(0, poses)

    def reroute(self, observation: Observation) -> Float | None:
        """Return waypoints around what blocks the path."""
        return self._fleet.reroute(Observations.alone(observation), 0)

    def approach(self, observation: Observation, tolerance: float) -> Float | None:
        """Return waypoints to a place near the end of the path."""
        return self._fleet.approach(Observations.alone(observation), 0, tolerance)

    def evaluation(self) -> Evaluation | None:
        """Return what led to the last command."""
        return self._fleet.evaluation(0)


class Controller(Component):
    """Turns a path and sensor data into wheel commands."""

    group: ClassVar[str] = "mrpbench.controllers"

    @property
    def needs_lidar(self) -> bool:
        """True if it works by scans: runs with robots that have no lidar are refused."""
        return False

    def robot_notes(self, robot: RobotModel) -> tuple[str, ...]:  # noqa: ARG002 - for those that override it
        """Return what the user should know before this robot is driven, one line each, e.g. limits out of reach."""
        return ()

    @abstractmethod
    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:
        """Begin to control one robot; `world` is the static map, `period` the control period in simulated seconds."""

    def start_fleet(
        self,
        robots: Sequence[RobotModel],
        world: World,
        period: float,
        seed: int = 0,  # noqa: ARG002 - for controllers that draw random numbers
    ) -> FleetControllerSession:
        """Begin to control a fleet; override this to command all robots in one call.

        `seed` follows from the run and is the same for all planners. A controller that draws random numbers draws them
        by this seed and the index of the robot.
        """
        sessions = [self.start(robot, world, period) for robot in robots]
        return FleetControllerSession(sessions, type(self).__name__)
