"""The world `generated_warehouse`: shelves in rows."""

import attrs

from mrpbench_core.api.component import between, option
from mrpbench_core.api.world import WorldSource
from mrpbench_core.model.worlds.occupancy import CELL_SIZES
from mrpbench_core.model.worlds.world import World
from mrpbench_worlds_standard.generated.raster import CELL_SIZE, chances, free_raster, raster_world


@attrs.frozen(kw_only=True)
class GeneratedWarehouse(WorldSource):
    """Shelves as blocks of cells in rows and columns, with aisles between them and free floor all around.

    The defaults are the proportions of the `warehouse-10-20-10-2-*` maps of Stern et al., "Multi-Agent Pathfinding:
    Definitions, Variants, and Benchmarks", SoCS 2019: shelves 10 × 2 cells.
    """

    shelf_columns: int = option(5, help="Shelves side by side along x.", validator=attrs.validators.ge(1))
    shelf_rows: int = option(10, help="Shelves above one another along y.", validator=attrs.validators.ge(1))
    shelf_length: int = option(10, help="Cells of a shelf along x.", validator=attrs.validators.ge(1))
    shelf_depth: int = option(2, help="Cells of a shelf along y.", validator=attrs.validators.ge(1))
    aisle: int = option(2, help="Cells between shelves above one another.", validator=attrs.validators.ge(1))
    cross_aisle: int = option(2, help="Cells between shelves side by side.", validator=attrs.validators.ge(1))
    margin: int = option(5, help="Cells of free floor all around, for stations.", validator=attrs.validators.ge(1))
    missing: float = option(
        0.0,
        help="Probability that a shelf is missing.",
        validator=between(0, 1),
    )
    resolution: float = option(
        CELL_SIZE, help="Side of a cell.", unit="m", validator=between(*CELL_SIZES), former="cell_size"
    )
    seed: int = option(0, help="Seed of the missing shelves.")

    def load(self) -> World:
        """Place the shelves."""
        across, up = self.shelf_length + self.cross_aisle, self.shelf_depth + self.aisle
        columns = 2 * self.margin + self.shelf_columns * across - self.cross_aisle
        rows = 2 * self.margin + self.shelf_rows * up - self.aisle
        blocked = free_raster(rows, columns)
        present = chances(self.seed, self.shelf_rows * self.shelf_columns) >= self.missing
        for index in present.nonzero()[0].tolist():
            row, column = divmod(index, self.shelf_columns)
            bottom, left = self.margin + row * up, self.margin + column * across
            blocked[bottom : bottom + self.shelf_depth, left : left + self.shelf_length] = True
        return raster_world(f"warehouse_{columns}x{rows}_{self.seed}", blocked, self.resolution)
