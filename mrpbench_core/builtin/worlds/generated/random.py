"""Cells blocked at random."""

import attrs
import numpy as np

from mrpbench_core.api.component import option
from mrpbench_core.api.world import WorldSource
from mrpbench_core.builtin.worlds.generated.raster import CELL_SIZE, chances, free_raster, raster_world
from mrpbench_core.checking.components import components
from mrpbench_core.model.arrays import Bool
from mrpbench_core.model.world import World


@attrs.frozen(kw_only=True)
class GeneratedRandom(WorldSource):
    """A rectangle in which each cell is blocked by chance; what the largest connected part cannot reach is blocked too.

    Like the `random-*` maps of Stern et al., "Multi-Agent Pathfinding: Definitions, Variants, and Benchmarks", SoCS
    2019. Beyond four blocked cells in ten, free space falls to pieces.
    """

    columns: int = option(32, help="Cells along x.", validator=attrs.validators.ge(1))
    rows: int = option(32, help="Cells along y.", validator=attrs.validators.ge(1))
    blocked: float = option(
        0.1,
        help="Chance of a cell to be blocked.",
        validator=attrs.validators.and_(attrs.validators.ge(0), attrs.validators.le(0.4)),
    )
    cell_size: float = option(CELL_SIZE, help="Side of a cell.", unit="m", validator=attrs.validators.gt(0))
    seed: int = option(0, help="Which of the worlds with these numbers.")

    def load(self) -> World:
        """Draw the cells."""
        free_raster(self.rows, self.columns)
        blocked = (chances(self.seed, self.rows * self.columns) < self.blocked).reshape(self.rows, self.columns)
        return raster_world(f"random_{self.columns}x{self.rows}_{self.seed}", _largest_part(blocked), self.cell_size)


def _largest_part(blocked: Bool) -> Bool:
    """The raster with only the largest connected part of its free cells; of equal ones the first."""
    number = np.arange(blocked.size).reshape(blocked.shape)
    edges = []
    for here, there in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        both = ~blocked[here] & ~blocked[there]
        edges.append(np.stack([number[here][both], number[there][both]], axis=1))
    label = components(blocked.size, np.concatenate(edges))
    count = np.bincount(label[~blocked.ravel()], minlength=1)
    kept: Bool = (label == count.argmax()).reshape(blocked.shape) & ~blocked
    return ~kept
