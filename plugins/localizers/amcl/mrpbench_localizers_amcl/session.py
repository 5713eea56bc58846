"""Runs the native particle filters of a fleet."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from mrpbench_native import amcl

from mrpbench_core.api import LocalizerSession
from mrpbench_core.checking.occupancy import rasterise
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet, Lidar
from mrpbench_core.model.execution.observation import Estimate, Odometry, ScanBatch
from mrpbench_core.model.worlds.solids import segments
from mrpbench_core.model.worlds.world import World

_OURS = ("laser_max_range", "laser_min_range", "robot_model_type")
"""Parameters that are not passed to the native part."""


class AmclSession(LocalizerSession):
    """Estimates the poses of a fleet, with one filter per robot."""

    def __init__(
        self,
        parameters: Mapping[str, Any],
        resolution: float,
        fleet: Fleet,
        world: World,
        placements: Float,
        seed: int,
    ) -> None:
        self._longest, self._shortest = parameters["laser_max_range"], parameters["laser_min_range"]
        self._lidars = [robot.lidar for robot in fleet.robots]
        recovers = parameters["recovery_alpha_fast"] > 0
        self._filters = amcl.Fleet(
            segments=segments(world),
            resolution=resolution,
            places=_free(world, resolution) if recovers else np.empty((0, 2)),
            placements=np.array(placements, float).reshape(-1, 3),
            seed=seed % 2**64,
            parameters={name: value for name, value in parameters.items() if name not in _OURS},
        )
        self._began = False

    def update(self, now: float, odometry: Odometry, scans: Sequence[ScanBatch], truth: Float | None) -> Estimate:  # noqa: ARG002
        """Update the filters with new scans, and return the estimates; without new scans they follow odometry."""
        pose = np.ascontiguousarray(odometry.pose)
        if not self._began:
            self._filters.begin(pose)
            self._began = True
        for batch in scans:
            self._sense(batch, pose)
        return Estimate(pose=self._filters.poses(pose), covariance=self._filters.covariances)

    def _sense(self, batch: ScanBatch, odometry: Float) -> None:
        lidar = self._lidars[int(batch.robot[0])]
        assert lidar is not None, "only robots with a lidar take scans"
        longest, shortest = self._reach(lidar)
        self._filters.sense(
            np.ascontiguousarray(batch.robot),
            np.ascontiguousarray(batch.ranges),
            odometry,
            range=longest,
            min_range=shortest,
            forward=lidar.mount[0],
            leftward=lidar.mount[1],
        )

    def _reach(self, lidar: Lidar) -> tuple[float, float]:
        longest = lidar.range if self._longest < 0 else min(self._longest, lidar.range)
        shortest = lidar.min_range if self._shortest < 0 else max(self._shortest, lidar.min_range)
        return longest, shortest


def _free(world: World, resolution: float) -> Float:
    """Return the centres f8[k,2] of the free cells."""
    raster = rasterise(world.levels[0], resolution, rule="touched")
    return np.ascontiguousarray(raster.centres(np.argwhere(~raster.blocked)))
