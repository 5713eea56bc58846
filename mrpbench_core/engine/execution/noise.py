"""Noise that the engine adds to a simulator's exact output and a navigator's exact commands; zero by default.

Every draw comes from the stream of its own cause and robot, so that neither another cause nor another robot changes it.
"""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.config.settings import Noise
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.common.poses import wrapped
from mrpbench_core.model.execution.observation import Odometry, ScanBatch
from mrpbench_core.model.execution.state import State

_BLOCK = 64
"""Periods that are drawn at once, for speed; the numbers are the same."""


class Disturbances:
    """Noisy sensors, motors and starts of one run.

    Odometry errs as a differential drive's does: each wheel measures its way with an error whose variance grows with
    the way (K. S. Chong and L. Kleeman, "Accurate odometry and error modelling for a mobile robot", ICRA 1997), and
    with a wrong scale (J. Borenstein and L. Feng, "Measurement and correction of systematic odometry errors in mobile
    robots", IEEE Trans. Robotics and Automation 12, 1996). Heading errs with it, the more the closer the wheels are.
    """

    def __init__(self, size: Noise, fleet: Fleet, start_poses: Float, period: float, seeds: Seeds) -> None:
        def streams(name: str) -> list[np.random.Generator]:
            return seeds.streams(name, len(fleet))

        self._size, self._period = size, period
        self._half_axle = np.array([robot.wheel_separation / 2 for robot in fleet.robots])
        self._ranges, self._dropouts = streams("lidar"), streams("lidar_dropout")
        self._wheels, self._motors = _Normals(streams("odometry")), _Normals(streams("actuation"))
        self._scale = 1 + size.odometry_bias * np.array(
            [stream.standard_normal(2) for stream in streams("odometry_bias")]
        ).reshape(-1, 2)
        self._truth = start_poses.copy()
        self._believed = start_poses.copy()
        self.start_delay: Float = np.array([stream.uniform(0, size.start_jitter) for stream in streams("start_jitter")])
        """f8[n] simulated seconds."""

    def odometry(self, state: State) -> Odometry:
        """Odometry after one more control period."""
        if not (self._size.odometry or self._size.odometry_bias):
            return Odometry(pose=state.pose, twist=state.twist)
        step = state.pose - self._truth
        turn = wrapped(step[:, 2])
        heading = self._truth[:, 2] + turn / 2
        ahead = step[:, 0] * np.cos(heading) + step[:, 1] * np.sin(heading)
        wheels = np.column_stack([ahead - turn * self._half_axle, ahead + turn * self._half_axle])
        error = wheels * (self._scale - 1)
        if self._size.odometry:
            error += self._size.odometry * np.sqrt(np.abs(wheels)) * self._wheels.next()
        further = np.column_stack([error.sum(axis=1) / 2, (error[:, 1] - error[:, 0]) / (2 * self._half_axle)])
        ahead, turn = ahead + further[:, 0], turn + further[:, 1]
        heading = self._believed[:, 2] + turn / 2
        self._believed = self._believed + np.column_stack([ahead * np.cos(heading), ahead * np.sin(heading), turn])
        self._believed[:, 2] = wrapped(self._believed[:, 2])
        self._truth = state.pose
        return Odometry(pose=self._believed, twist=state.twist + further / self._period)

    def scans(self, batches: Sequence[ScanBatch]) -> tuple[ScanBatch, ...]:
        """The same scans with noisy ranges (never below 0) and without some returns."""
        if not (self._size.lidar or self._size.lidar_dropout):
            return tuple(batches)
        return tuple(attrs.evolve(batch, ranges=self._measured(batch)) for batch in batches)

    def _measured(self, batch: ScanBatch) -> Float:
        ranges, robots = batch.ranges.copy(), batch.robot.tolist()
        if self._size.lidar:
            errors = [self._ranges[robot].normal(0, self._size.lidar, ranges.shape[1]) for robot in robots]
            ranges = np.maximum(ranges + np.reshape(errors, ranges.shape), 0)
        if self._size.lidar_dropout:
            luck = [self._dropouts[robot].random(ranges.shape[1]) for robot in robots]
            ranges[np.reshape(luck, ranges.shape) < self._size.lidar_dropout] = np.inf
        return ranges

    def actuated(self, twist: Float) -> Float:
        """Return the executed commands f8[n,2] of one control period, with the noise of the motors."""
        if not self._size.actuation:
            return twist
        return twist * (1 + self._size.actuation * self._motors.next())


class _Normals:
    """Two standard normal numbers per robot and period, each robot's from a stream of its own."""

    def __init__(self, streams: list[np.random.Generator]) -> None:
        self._streams = streams
        self._drawn = np.empty((len(streams), 0, 2))
        self._used = 0

    def next(self) -> Float:
        """The next f8[n,2]."""
        if self._used == self._drawn.shape[1]:
            drawn = [stream.standard_normal((_BLOCK, 2)) for stream in self._streams]
            self._drawn, self._used = np.reshape(drawn, (len(drawn), _BLOCK, 2)), 0
        self._used += 1
        return self._drawn[:, self._used - 1]
