"""Checks that every localizer must pass: robots that drive about in a room, measured without noise."""

import numpy as np

from mrpbench_core.api.localizer import Localizer
from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.checking.covariances import check_covariances
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.execution.observation import Estimate, Odometry
from mrpbench_core.model.execution.state import Inputs
from mrpbench_core.testing.faults import Skip, require
from mrpbench_core.testing.fixtures.room import PERIOD, fleet, room
from mrpbench_core.testing.suites.component import ComponentConformance

PLACES = np.array([(1.0, 1.0, 0.0), (3.0, 2.0, 3.0)])
TWISTS = np.array([(0.15, 0.15), (0.1, 0.1)])
SECONDS = 8.0
FAR = 0.3
"""Metres and radians by which an estimate may be wrong."""


class LocalizerConformance(ComponentConformance):
    """Checks of localizers: `class TestMine(LocalizerConformance)`."""

    def make(self) -> Localizer:
        """Return the localizer to check."""
        raise NotImplementedError("define make(self) and return the localizer to check")

    def test_estimates_have_the_shapes_of_the_contract(self) -> None:
        for estimate in self.drive(0)[0]:
            require(isinstance(estimate, Estimate), f"returns {type(estimate).__name__} instead of Estimate")
            require(estimate.pose.shape == (2, 3), f"estimates of two robots have shape {estimate.pose.shape}")
            require(
                np.isfinite(estimate.pose).all(), "an estimate is not finite: keep the last one where there is none"
            )
            if estimate.covariance is not None:
                fault = check_covariances(estimate.covariance, 2)
                require(fault is None, f"returns {fault} for two robots")

    def test_follows_robots_whose_sensors_are_exact(self) -> None:
        estimates, truths = self.drive(0)
        for step, (estimate, truth) in enumerate(zip(estimates, truths, strict=True)):
            off = estimate.pose - truth
            off[:, 2] = np.remainder(off[:, 2] + np.pi, 2 * np.pi) - np.pi
            worst = float(np.abs(off).max())
            require(worst < FAR, f"after {step * PERIOD:.2f} s an estimate is wrong by {worst:.2f} (m, rad)")

    def test_the_same_seed_gives_the_same_estimates(self) -> None:
        one, other = (np.array([estimate.pose for estimate in self.drive(3)[0]]) for _ in range(2))
        require(
            np.array_equal(one, other), "the same seed gives other estimates the second time: draw from `seed` only"
        )

    def test_does_not_need_the_truth(self) -> None:
        if self.make().needs_truth:
            raise Skip("it declares `needs_truth`")
        self.drive(0)

    def drive(self, seed: int) -> tuple[list[Estimate], list[Float]]:
        """Estimates and the truth in every period."""
        localizer, robots = self.make(), fleet(2)
        session = localizer.start(robots, room(), PLACES, seed)
        estimates, truths = [], []
        with Kinematic().open(room(), robots, PLACES, 0, PERIOD) as simulation:
            state = simulation.state
            for step in range(round(SECONDS / PERIOD)):
                odometry = Odometry(pose=in_odometry_frames(state.pose), twist=state.twist)
                truth = state.pose if localizer.needs_truth else None
                estimates.append(session.update(step * PERIOD, odometry, simulation.scans(), truth))
                truths.append(state.pose)
                state = simulation.step(Inputs(twist=TWISTS))
        return estimates, truths


def in_odometry_frames(pose: Float) -> Float:
    """Poses f8[n,3] relative to the pose at which each robot was placed."""
    offset, angle = pose[:, :2] - PLACES[:, :2], PLACES[:, 2]
    along = offset[:, 0] * np.cos(angle) + offset[:, 1] * np.sin(angle)
    across = offset[:, 1] * np.cos(angle) - offset[:, 0] * np.sin(angle)
    return np.column_stack([along, across, np.remainder(pose[:, 2] - angle + np.pi, 2 * np.pi) - np.pi])
