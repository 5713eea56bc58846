"""The world `generated_random`: cells blocked at random."""

import attrs
import numpy as np

from mrpbench_core.api.component import between, option
from mrpbench_core.api.world import WorldSource
from mrpbench_core.checking.components import components
from mrpbench_core.model.common.arrays import Bool
from mrpbench_core.model.worlds.occupancy import CELL_SIZES
from mrpbench_core.model.worlds.world import World
from mrpbench_worlds_standard.generated.raster import CELL_SIZE, chances, free_raster, raster_world


@attrs.frozen(kw_only=True)
class GeneratedRandom(WorldSource):
    """A rectangle in which each cell is blocked at random; cells outside the largest component are blocked too.

    Like the `random-*` maps of Stern et al., "Multi-Agent Pathfinding: Definitions, Variants, and Benchmarks", SoCS
    2019. With more than four blocked cells in ten, the free space splits into small components.
    """

    columns: int = option(32, help="Cells along x.", validator=attrs.validators.ge(1))
    rows: int = option(32, help="Cells along y.", validator=attrs.validators.ge(1))
    blocked: float = option(
        0.1,
        help="Probability that a cell is blocked.",
        validator=between(0, 0.4),
    )
    resolution: float = option(
        CELL_SIZE, help="Side of a cell.", unit="m", validator=between(*CELL_SIZES), former="cell_size"
    )
    seed: int = option(0, help="Seed of the blocked cells.")

    def load(self) -> World:
        """Draw the cells."""
        free_raster(self.rows, self.columns)
        blocked = (chances(self.seed, self.rows * self.columns) < self.blocked).reshape(self.rows, self.columns)
        return raster_world(f"random_{self.columns}x{self.rows}_{self.seed}", _largest_part(blocked), self.resolution)


def _largest_part(blocked: Bool) -> Bool:
    """Return the raster with only the largest component of its free cells, the first of equally large ones."""
    number = np.arange(blocked.size).reshape(blocked.shape)
    edges = []
    for here, there in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        both = ~blocked[here] & ~blocked[there]
        edges.append(np.stack([number[here][both], number[there][both]], axis=1))
    label = components(blocked.size, np.concatenate(edges))
    count = np.bincount(label[~blocked.ravel()], minlength=1)
    largest: Bool = (label == count.argmax()).reshape(blocked.shape) & ~blocked
    return ~largest
