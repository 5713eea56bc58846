"""Noise that the engine lays over a simulator's exact output; all zero by default."""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.engine.seeds import stream
from mrpbench_core.model.arrays import Float
from mrpbench_core.model.execution import Odometry, ScanBatch, State


class SensorNoise:
    """Noisy sensors and starts of one run.

    Args:
        lidar: standard deviation of every range, metres.
        odometry: standard deviation of the relative error of each period's distance and turn.
        start_jitter: each robot starts up to this many simulated seconds late, uniformly.
        placements: f8[n,3], where odometry begins.
    """

    def __init__(
        self, lidar: float, odometry: float, start_jitter: float, placements: Float, seed: int, repeat: int
    ) -> None:
        robots = range(len(placements))
        self._lidar = lidar
        self._odometry = odometry
        self._ranges = [stream(seed, repeat, "lidar", robot) for robot in robots]
        self._wheels = [stream(seed, repeat, "odometry", robot) for robot in robots]
        self._truth = placements.copy()
        self._believed = placements.copy()
        self.start_delay: Float = np.array(
            [stream(seed, repeat, "start_jitter", robot).uniform(0, start_jitter) for robot in robots]
        )
        """f8[n] simulated seconds."""

    def odometry(self, state: State) -> Odometry:
        """Odometry after one more control period."""
        if not self._odometry:
            return Odometry(pose=state.pose, twist=state.twist)
        step = state.pose - self._truth
        turn = np.arctan2(np.sin(step[:, 2]), np.cos(step[:, 2]))
        heading = self._truth[:, 2] + turn / 2
        ahead = step[:, 0] * np.cos(heading) + step[:, 1] * np.sin(heading)
        error = np.array([wheels.normal(1.0, self._odometry, 2) for wheels in self._wheels])
        ahead, turn = ahead * error[:, 0], turn * error[:, 1]
        heading = self._believed[:, 2] + turn / 2
        self._believed += np.column_stack([ahead * np.cos(heading), ahead * np.sin(heading), turn])
        self._truth = state.pose.copy()
        return Odometry(pose=self._believed, twist=state.twist * error)

    def scans(self, batches: Sequence[ScanBatch]) -> tuple[ScanBatch, ...]:
        """The same scans with noisy ranges (never below 0)."""
        if not self._lidar:
            return tuple(batches)
        return tuple(attrs.evolve(batch, ranges=np.maximum(batch.ranges + self._errors(batch), 0)) for batch in batches)

    def _errors(self, batch: ScanBatch) -> Float:
        beams = batch.ranges.shape[1]
        return np.array([self._ranges[robot].normal(0, self._lidar, beams) for robot in batch.robot])
