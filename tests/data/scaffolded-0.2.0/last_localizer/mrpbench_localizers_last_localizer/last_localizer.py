"""LastLocalizer: dead reckoning that says how far it may be wrong."""

from collections.abc import Sequence

import attrs
import numpy as np
from mrpbench_core.api import Localizer, LocalizerSession, option
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.common.poses import composed, relative
from mrpbench_core.model.execution.observation import Estimate, Odometry, ScanBatch
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class LastLocalizer(Localizer):
    """Adds up odometry from the placements; the variance of x, y and yaw grows with the distance and the turn."""

    drift: float = option(
        0.05, help="standard deviation in metres after 1 m; in radians after 1 rad", validator=attrs.validators.ge(0)
    )

    def start(self, fleet: Fleet, world: World, placements: Float, seed: int) -> LocalizerSession:  # noqa: ARG002
        """Begin at the placements; nothing is random."""
        return LastLocalizerSession(self.drift, placements)


class LastLocalizerSession(LocalizerSession):
    """Localizes one fleet."""

    def __init__(self, drift: float, placements: Float) -> None:
        self.drift = drift
        self.pose = np.array(placements, float)
        self.variance = np.zeros_like(self.pose)
        self.before: Float | None = None

    def update(self, now: float, odometry: Odometry, scans: Sequence[ScanBatch], truth: Float | None) -> Estimate:
        """Move the estimates as far as odometry has moved since the last call."""
        del now, scans, truth
        if self.before is not None:
            moved = relative(self.before, odometry.pose)
            self.pose = composed(self.pose, moved)
            distance, turn = np.hypot(moved[:, 0], moved[:, 1]), np.abs(moved[:, 2])
            self.variance += self.drift**2 * np.column_stack([distance, distance, turn])
        self.before = odometry.pose.copy()
        return Estimate(pose=self.pose, covariance=self.variance[:, :, None] * np.eye(3))
