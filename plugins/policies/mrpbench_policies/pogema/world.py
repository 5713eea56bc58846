"""Maps of POGEMA's benchmark as worlds."""

from pathlib import Path

import attrs

from mrpbench_core.api import Level, Occupancy, World, WorldSource, between, option
from mrpbench_policies.pogema.files import read_map


@attrs.frozen(kw_only=True)
class PogemaWorld(WorldSource):
    """A map of a file of maps (`maps.yaml`) of POGEMA's benchmark (Skrynnik et al., ICLR 2025). The first row is on
    top, at the greatest y. The name of the world is that of the map.
    """

    file: Path = option(help="the file of maps")
    map: str = option(help="the name of the map in it")
    resolution: float = option(1.0, help="side of a cell", unit="m", validator=between(0.01, 100), former="cell_size")

    def load(self) -> World:
        """Read the map."""
        blocked = read_map(self.file, self.map)
        level = Level(name="L1", occupancy=Occupancy(blocked=blocked[::-1], resolution=self.resolution))
        return World(name=self.map, levels=(level,))
