"""Runs the native localisation and mapping of a fleet."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from mrpbench_native import slam

from mrpbench_core.api import LocalizerSession
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet, Lidar
from mrpbench_core.model.execution.observation import Estimate, Odometry, ScanBatch
from mrpbench_core.model.runs.recording import Chunk

_OURS = ("max_laser_range", "min_laser_range", "map_update_interval")
"""Parameters that are not passed to the native part."""


class SlamSession(LocalizerSession):
    """Estimates the poses of a fleet, with one map per robot."""

    def __init__(self, parameters: Mapping[str, Any], fleet: Fleet, placements: Float) -> None:
        self._longest, self._shortest = parameters["max_laser_range"], parameters["min_laser_range"]
        self._lidars = [robot.lidar for robot in fleet.robots]
        self._robots = slam.Fleet(
            placements=np.array(placements, float).reshape(-1, 3),
            parameters={name: value for name, value in parameters.items() if name not in _OURS},
        )
        self._resolution = parameters["resolution"]
        self._interval, self._due = parameters["map_update_interval"], 0.0
        self._began = False

    def update(self, now: float, odometry: Odometry, scans: Sequence[ScanBatch], truth: Float | None) -> Estimate:  # noqa: ARG002
        """Match new scans, and return the estimates; without new scans they follow odometry."""
        pose = np.ascontiguousarray(odometry.pose)
        if not self._began:
            self._robots.begin(pose)
            self._began = True
        for batch in scans:
            self._sense(now, batch, pose)
        return Estimate(pose=self._robots.poses(pose))

    def map_changes(self, now: float, last: bool) -> Chunk:
        """Return the tiles that changed, every `map_update_interval` seconds and at the end."""
        if now < self._due and not last:
            return {}
        self._due = now + self._interval
        changes = [self._robots.changed_tiles(robot) for robot in range(len(self._lidars))]
        counts = [len(cells) for _, cells in changes]
        index, cells = (np.concatenate(parts) for parts in zip(*changes, strict=True))
        return {
            "map_time": np.full(len(cells), now),
            "map_robot": np.repeat(np.arange(len(counts), dtype=np.int32), counts),
            "map_corner": index * (slam.TILE * self._resolution),
            "map_side": np.full(len(cells), self._resolution),
            "map_cells": cells,
        }

    def _sense(self, now: float, batch: ScanBatch, odometry: Float) -> None:
        lidar = self._lidars[int(batch.robot[0])]
        assert lidar is not None, "only robots with a lidar take scans"
        longest, shortest = self._reach(lidar)
        self._robots.sense(
            np.ascontiguousarray(batch.robot),
            np.ascontiguousarray(batch.ranges),
            odometry,
            now=now,
            range=longest,
            min_range=shortest,
            forward=lidar.mount[0],
            leftward=lidar.mount[1],
        )

    def _reach(self, lidar: Lidar) -> tuple[float, float]:
        return min(self._longest, lidar.range), max(self._shortest, lidar.min_range)
