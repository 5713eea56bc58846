"""Contract of the kind *recovery*: what a robot tries when it is stuck."""

from abc import ABC, abstractmethod
from typing import ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.common.fleet import RobotModel


class Surroundings(ABC):
    """The surroundings of one robot, as its controller knows them."""

    @abstractmethod
    def clear(self) -> None:
        """Forget what sensors have marked."""

    @abstractmethod
    def is_free(self, poses: Float) -> Bool:
        """Tell bool[k] at which poses f8[k,3] the robot may be: it fits there, and has not left the place to others."""

    @abstractmethod
    def heading(self) -> float:
        """Return the yaw at which the path leads on from where the robot was at first, radians; NaN = it ends there."""


class RecoverySession(ABC):
    """One attempt of one robot to recover."""

    @abstractmethod
    def step(self, now: float, pose: Float, twist: Float) -> tuple[float, float] | bool:
        """Return forward speed (m/s) and turn rate (rad/s) for one control period, or whether the attempt succeeded.

        A bool ends the attempt. `pose` f8[3] is the estimated pose, `twist` f8[2] the measured twist.
        """


class Recovery(Component):
    """Gets a robot out of a place where its controller finds no way on."""

    group: ClassVar[str] = "mrpbench.recoveries"

    @abstractmethod
    def start(self, robot: RobotModel, surroundings: Surroundings, period: float) -> RecoverySession:
        """Begin an attempt, which must end also if the robot cannot move; `period` is in simulated seconds."""
