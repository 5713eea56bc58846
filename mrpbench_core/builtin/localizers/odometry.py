"""The localizer `odometry`: dead reckoning from the placements."""

from collections.abc import Sequence

import attrs

from mrpbench_core.api import Localizer, LocalizerSession
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.common.poses import composed, relative
from mrpbench_core.model.execution.observation import Estimate, Odometry, ScanBatch
from mrpbench_core.model.worlds.world import World


class _Session(LocalizerSession):
    def __init__(self, placements: Float) -> None:
        self._placements = placements
        self._first: Float | None = None

    def update(self, now: float, odometry: Odometry, scans: Sequence[ScanBatch], truth: Float | None) -> Estimate:  # noqa: ARG002
        if self._first is None:
            self._first = odometry.pose.copy()
        return Estimate(pose=composed(self._placements, relative(self._first, odometry.pose)))


@attrs.frozen(kw_only=True)
class DeadReckoning(Localizer):
    """Adds the motion that odometry measures to the placements; the error grows without bound."""

    def start(self, fleet: Fleet, world: World, placements: Float, seed: int) -> LocalizerSession:  # noqa: ARG002
        """Begin at the placements; nothing here is random."""
        return _Session(placements.copy())
