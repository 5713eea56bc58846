"""Worlds drawn in the RMF traffic editor (`building.yaml`): one level, walls, doors as gaps, lanes."""

import attrs

from mrpbench_core.api.component import Path, option
from mrpbench_core.api.world import WorldSource
from mrpbench_core.builtin.worlds.building.coordinates import read_positions
from mrpbench_core.builtin.worlds.building.lanes import read_graph
from mrpbench_core.builtin.worlds.building.leftovers import note_leftovers
from mrpbench_core.builtin.worlds.building.node import Node
from mrpbench_core.builtin.worlds.building.notes import Notes
from mrpbench_core.builtin.worlds.building.walls import read_doors, read_walls
from mrpbench_core.files import yaml
from mrpbench_core.model.world import Level, World


@attrs.frozen(kw_only=True)
class Rmf(WorldSource):
    """A `building.yaml` of the RMF traffic editor."""

    file: Path = option(help="The building.yaml file.")
    level: str | None = option(None, help="Name of the level; by default the reference level, else the first.")

    def load(self) -> World:
        """Read walls, doors and lanes; what is not understood stands in `World.notes`."""
        document = yaml.load(self.file)
        building = Node(document, document.data)
        name = self._level_name(building)
        level = building.fields()["levels"].fields()[name]
        notes = Notes()
        positions = read_positions(building, level, notes)
        doors = read_doors(level, positions, notes)
        vertices, lanes = read_graph(level, positions, doors, notes)
        elevation = level.fields().get("elevation")
        floor = Level(
            name=name,
            elevation=0.0 if elevation is None else elevation.number(),
            walls=read_walls(level, positions, notes),
            doors=doors,
        )
        note_leftovers(building, level, name, notes)
        return World(
            name=self._world_name(building), levels=(floor,), vertices=vertices, lanes=lanes, notes=notes.sentences()
        )

    def _level_name(self, building: Node) -> str:
        levels = building.fields().get("levels")
        if levels is None or not levels.fields():
            raise building.error("has no levels", "is it a traffic editor file?")
        names = list(levels.fields())
        reference = building.fields().get("reference_level_name")
        if self.level is not None:
            if self.level not in names:
                raise levels.error(f"no level {self.level!r}", f"levels: {', '.join(names)}", key=True)
            return self.level
        if reference is not None and reference.text():
            if reference.text() not in names:
                raise reference.error(f"no level {reference.text()!r}", f"levels: {', '.join(names)}")
            return reference.text()
        return names[0]

    def _world_name(self, building: Node) -> str:
        parts = building.fields()
        stated = next((parts[key].text() for key in ("name", "building_name") if key in parts), "")
        return stated or self.file.name.split(".")[0]
