"""Tracks and predicts in one execution, in C++."""

from collections.abc import Sequence
from typing import Any

import attrs
import numpy as np
from mrpbench_native.tracking import STEP, Fleet

from mrpbench_core.api.predictor import Prediction, PredictorSession
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.worlds.solids import segments
from mrpbench_core.model.worlds.world import World
from mrpbench_predictors_tracking.occupancy import Occupancy


class TrackingSession(PredictorSession):
    """What each robot tracks by its own scans.

    Raises:
        InputError: the world has several levels, or a robot has no lidar.
    """

    def __init__(
        self, robots: Sequence[RobotModel], world: World, values: dict[str, Any], social_force: bool, threads: int
    ) -> None:
        if len(world.levels) > 1:
            raise InputError(
                f"prediction: tracks among the walls of one level, and {world.name} has {len(world.levels)}"
            )
        blind = next((robot.name for robot in robots if robot.lidar is None), None)
        if blind is not None:
            raise InputError(f"prediction: works by a lidar, and the robot {blind} has none")
        self._radius = float(values["radius"])
        self._fleet = Fleet(
            walls=np.ascontiguousarray(segments(world), float),
            mount=np.array([robot.lidar.mount[:2] for robot in robots if robot.lidar is not None], float),
            radius=np.array([robot.radius for robot in robots], float),
            options=values,
            social_force=social_force,
            threads=threads,
        )
        self._occupancy = Occupancy()

    def observe(self, pose: Float, scans: Sequence[ScanBatch]) -> tuple[ScanBatch, ...]:
        """Take new scans, and return them with -1 where a beam ends on an object that moves."""
        return tuple(
            attrs.evolve(batch, ranges=self._fleet.see(batch.stamp, batch.robot, pose, batch.ranges)) for batch in scans
        )

    def predict(self, now: float) -> Prediction:
        """Return where the objects that move will be from `now` on."""
        robot, place = self._fleet.predict(now)
        return Prediction(step=STEP, robot=robot, place=place, radius=np.full(len(robot), self._radius))

    def constrained(self, problem: Problem, now: float) -> Problem:
        """Return the problem with the occupancy that is predicted."""
        return self._occupancy.constrained(problem, self.predict(now), now)
