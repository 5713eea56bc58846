"""Worlds of the MovingAI benchmark (`.map`): rasters of terrain letters.

Sturtevant, "Benchmarks for Grid-Based Pathfinding", IEEE Transactions on Computational Intelligence and
AI in Games, 2012.
"""

import attrs

from mrpbench_core.api.component import Path, option
from mrpbench_core.api.world import WorldSource
from mrpbench_core.files.movingai import read_movingai_map
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Level, World


@attrs.frozen(kw_only=True)
class MovingAi(WorldSource):
    """A MovingAI `.map`. Passable: `.`, `G`, `S` and `E`; blocked: `@`, `O`, `T` and `W`.

    Line r of the map's `height` lines becomes row `height - 1 - r`, so that y points up as everywhere else; x is the
    column. The lower left corner is the origin.
    """

    file: Path = option(help="The .map file.")
    resolution: float = option(
        1.0, help="Side of a cell.", unit="m", validator=attrs.validators.gt(0), former="cell_size"
    )

    def load(self) -> World:
        """Read the raster; no walls, no places, no lanes."""
        blocked = read_movingai_map(self.file)
        level = Level(name="L1", occupancy=Occupancy(blocked=blocked[::-1], resolution=self.resolution))
        return World(name=self.file.name.removesuffix(".map"), levels=(level,))
