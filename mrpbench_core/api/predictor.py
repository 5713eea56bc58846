"""Contract of the kind *predictor*: where people and other things that no plan moves will be, by what lidars see."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import ClassVar

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.model.common.arrays import Float, Int32, array
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class Prediction:
    """The places of k objects, taken for discs, at t times from now on."""

    step: float
    """seconds between the times, of which the first is now."""
    robot: Int32 = array("i4")
    """i4[k]: the robot that tracks each object, ascending."""
    place: Float = array("f8")
    """f8[k,t,2] metres, frame `map`."""
    radius: Float = array("f8")
    """f8[k] metres."""


class PredictorSession(ABC):
    """Tracks and predicts in one execution."""

    @abstractmethod
    def observe(self, pose: Float, scans: Sequence[ScanBatch]) -> tuple[ScanBatch, ...]:
        """Take new scans, and return them with -1 where a beam ends on what is predicted.

        `pose` f8[n,3] is the estimated pose of each robot. Robots of the fleet are not objects.
        """

    @abstractmethod
    def predict(self, now: float) -> Prediction:
        """Return where objects will be from `now` on, which is not before the last scans."""

    @abstractmethod
    def constrained(self, problem: Problem, now: float) -> Problem:
        """Return a problem whose robots keep away from where objects will be, with the same robots first."""


class Predictor(Component):
    """Starts sessions of prediction."""

    group: ClassVar[str] = "mrpbench.predictors"

    @abstractmethod
    def start(self, robots: Sequence[RobotModel], world: World) -> PredictorSession:
        """Begin to predict for a fleet; raises `InputError` if it cannot in this world."""
