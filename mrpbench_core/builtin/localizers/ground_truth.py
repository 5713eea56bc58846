"""The localizer `ground_truth`: robots know exactly where they are."""

from collections.abc import Sequence
from typing import ClassVar

import attrs

from mrpbench_core.api import Localizer, LocalizerSession
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.observation import Estimate, Odometry, ScanBatch
from mrpbench_core.model.worlds.world import World


class _Session(LocalizerSession):
    def update(self, now: float, odometry: Odometry, scans: Sequence[ScanBatch], truth: Float | None) -> Estimate:  # noqa: ARG002
        assert truth is not None, "the engine passes the true poses to a localizer that declares needs_truth"
        return Estimate(pose=truth)


@attrs.frozen(kw_only=True)
class GroundTruth(Localizer):
    """Returns the true poses."""

    needs_truth: ClassVar[bool] = True

    def start(self, fleet: Fleet, world: World, placements: Float, seed: int) -> LocalizerSession:  # noqa: ARG002
        """Begin; the arguments do not matter."""
        return _Session()
