"""Contract of the kind *localizer* (provisional)."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.observation import Estimate, Odometry, ScanBatch
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.worlds.world import World


class LocalizerSession(ABC):
    """Estimates the poses of a fleet."""

    @abstractmethod
    def update(self, now: float, odometry: Odometry, scans: Sequence[ScanBatch], truth: Float | None) -> Estimate:
        """Return pose estimates in `map`. `truth` f8[n,3] is None unless the recipe declares `needs_truth`."""

    def map_changes(self, now: float, last: bool) -> Chunk:  # noqa: ARG002 - by default there are no maps
        """Return the tiles of robots' maps that changed, as rows of the channels `map_...`; {} = none to record now.

        `map_corner` is the lower left corner of a tile in `map`, `map_side` that of its cells, metres. `map_cells`
        has the values of `nav_msgs/OccupancyGrid`, row by row from there: -1 = unknown, 0 = free to 100 = occupied.
        """
        return {}


class Localizer(Component):
    """Tells robots where they are."""

    group: ClassVar[str] = "mrpbench.localizers"
    needs_truth: ClassVar[bool] = False
    """True if `update` needs the true poses, which only `ground_truth` gets without `grant_truth: true`."""

    @property
    def needs_lidar(self) -> bool:
        """True if it works by scans: runs with robots that have no lidar are refused."""
        return False

    @abstractmethod
    def start(self, fleet: Fleet, world: World, placements: Float, seed: int) -> LocalizerSession:
        """Begin with robots placed at `placements` f8[n,3]."""
