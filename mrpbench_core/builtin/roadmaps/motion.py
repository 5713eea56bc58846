"""The durations of a roadmap's edges: constant, or those of the motion of the robots."""

import math
from typing import Literal

import attrs
import numpy as np

from mrpbench_core.api.component import option
from mrpbench_core.api.roadmap import RoadmapBuilder
from mrpbench_core.builtin.roadmaps.headings import Penalties, with_headings
from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.common.fleet import Fleet, RobotModel
from mrpbench_core.model.planning.roadmap import Roadmap

KINODYNAMIC_TICK = 0.1
"""seconds: ticks of kinodynamic durations are at most this long, because a turn takes a second or two."""


@attrs.frozen(kw_only=True)
class TimedRoadmap(RoadmapBuilder):
    """A builder of roadmaps whose edges take the time that robots need."""

    duration_model: Literal["constant", "kinodynamic"] = option(
        "constant",
        help="constant: driving takes length / speed, turning and accelerating nothing; kinodynamic: vertices have "
        "headings, and turning, braking and accelerating take time too",
        validator=attrs.validators.in_(["constant", "kinodynamic"]),
    )
    speed_share: float = option(
        1.0,
        help="kinodynamic: share of its top speed at which the controller lets a robot cruise",
        validator=attrs.validators.and_(attrs.validators.gt(0), attrs.validators.le(1)),
    )
    turn_penalty: float = option(
        0.0,
        help="kinodynamic: time that a turn takes longer with the controller than the robot needs; negative if the "
        "controller rounds corners",
        unit="s",
    )
    stop_penalty: float = option(0.0, help="kinodynamic: the same of a stop at a goal", unit="s")

    def idle_options(self) -> dict[str, str]:
        """Return options that the others make idle."""
        idle = ("speed_share", "turn_penalty", "stop_penalty")
        return {} if self.is_kinodynamic else dict.fromkeys(idle, "duration_model is constant")

    @property
    def is_kinodynamic(self) -> bool:
        """Tell whether the roadmap has headings."""
        return self.duration_model == "kinodynamic"

    def profiles(self, fleet: Fleet) -> tuple[RobotModel, ...]:
        """Return the distinct robot models of a fleet, with the speeds at which they cruise."""
        models, _ = fleet.profiles
        if not self.is_kinodynamic:
            return models
        return tuple(attrs.evolve(robot, max_speed=self.speed_share * robot.max_speed) for robot in models)

    def timed(self, roadmap: Roadmap, profiles: tuple[RobotModel, ...]) -> Roadmap:
        """Return the finished roadmap, with headings if durations are kinodynamic.

        Args:
            roadmap: whose edges take the time to cross them at a constant speed.
            profiles: the robot model of each row of its durations.
        """
        if not self.is_kinodynamic:
            return roadmap
        return with_headings(roadmap, profiles, Penalties(turn=self.turn_penalty, stop=self.stop_penalty))


def driving_ticks(length: Float, speed: Float | float, tick: float) -> Int:
    """Return the ticks i8[...] in which robots drive `length` metres at `speed` m/s, rounded up, at least one."""
    ticks: Int = np.maximum(1, np.ceil(length / speed / tick - 1e-9)).astype(np.int64)
    return ticks


def dividing_tick(seconds: float) -> float:
    """Return the longest tick of at most `KINODYNAMIC_TICK` of which `seconds` are a multiple."""
    return seconds / math.ceil(seconds / KINODYNAMIC_TICK - 1e-9)
