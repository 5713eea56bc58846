"""The worlds that come with the core: editable `building.yaml` files in the folder `data`."""

from pathlib import Path

import attrs

from mrpbench_core.api.world import WorldSource
from mrpbench_core.builtin.worlds.rmf import Rmf
from mrpbench_core.model.world import World

FOLDER = Path(__file__).parent / "data"


@attrs.frozen(kw_only=True)
class Office(WorldSource):
    """Ten rooms on both sides of a corridor, 21.5 × 12 m, 29 places."""

    def load(self) -> World:
        """Read the packaged file."""
        return Rmf(file=FOLDER / "office.building.yaml").load()


@attrs.frozen(kw_only=True)
class Warehouse(WorldSource):
    """Shelves, aisles, docks and pick stations, 22 × 27 m, 54 places."""

    def load(self) -> World:
        """Read the packaged file."""
        return Rmf(file=FOLDER / "warehouse.building.yaml").load()
