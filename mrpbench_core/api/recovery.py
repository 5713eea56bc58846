"""Contract of the kind *recovery*: what a robot tries when it is stuck."""

from abc import ABC, abstractmethod
from typing import ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.model.arrays import Bool, Float
from mrpbench_core.model.fleet import RobotModel


class Surroundings(ABC):
    """What the controller of one robot knows of its surroundings."""

    @abstractmethod
    def clear(self) -> None:
        """Forget what sensors have marked."""

    @abstractmethod
    def is_free(self, poses: Float) -> Bool:
        """Tell for each pose f8[k,3] whether the robot may be there: it fits, and the room was not given to others."""


class RecoverySession(ABC):
    """One attempt of one robot."""

    @abstractmethod
    def step(self, now: float, pose: Float, twist: Float) -> tuple[float, float] | bool:
        """Return forward speed and turn rate for one control period, or whether the attempt, now over, succeeded.

        `pose` f8[3] is estimated, `twist` f8[2] measured.
        """


class Recovery(Component):
    """Helps a robot that its controller cannot help."""

    group: ClassVar[str] = "mrpbench.recoveries"

    @abstractmethod
    def start(self, robot: RobotModel, surroundings: Surroundings, period: float) -> RecoverySession:
        """Begin an attempt; `period` is the control period in simulated seconds."""
