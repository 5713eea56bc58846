"""Worlds drawn in the editors of Open-RMF: `building.yaml` and `.site.json`."""

from typing import Any, Literal

import attrs
import numpy as np

from mrpbench_core.api.component import Path, option
from mrpbench_core.api.world import WorldSource
from mrpbench_core.files import yaml
from mrpbench_core.model.worlds.world import Area, Lane, Level, Lift, Vertex, World
from mrpbench_worlds_standard.building.coordinates import Frame, read_frames, read_vertices
from mrpbench_worlds_standard.building.crowd_sim import read_crowd_sim
from mrpbench_worlds_standard.building.doors import read_doors
from mrpbench_worlds_standard.building.floors import read_areas
from mrpbench_worlds_standard.building.footprints import Footprints
from mrpbench_worlds_standard.building.lanes import LevelDrawing, read_graph
from mrpbench_worlds_standard.building.lifts import read_lifts
from mrpbench_worlds_standard.building.models import read_models
from mrpbench_worlds_standard.building.node import Node
from mrpbench_worlds_standard.building.notes import Notes
from mrpbench_worlds_standard.building.site import is_site, read_site
from mrpbench_worlds_standard.building.unsupported import note_unsupported, refuse_navigation_graph
from mrpbench_worlds_standard.building.walls import read_walls

DoorState = Literal["operated", "open"]


def doors_option() -> Any:
    """Return the option of worlds with doors."""
    return option(
        "operated",
        help="`operated`: doors are shut until a robot is granted one, which takes planners that support resources; "
        "`open`: every doorway is free, to compare all planners.",
        validator=attrs.validators.in_(("operated", "open")),
    )


@attrs.frozen(kw_only=True)
class Rmf(WorldSource):
    """A `building.yaml` of the RMF traffic editor, or a `.site.json` of the site editor, its levels in one frame.

    The reference level (`reference_level_name`, else the first) becomes level 0. Models become obstacles by a table of
    estimated footprints, which `footprints` extends. `World.notes` lists what is not supported.
    """

    file: Path = option(help="The building.yaml or .site.json file.")
    level: str | None = option(None, help="Name of the one level to load, in its own frame; by default all.")
    footprints: Path | None = option(
        None, help="Footprints of models as `name: {size: [x, y]}` or `{radius: r}`, on top of the estimated ones."
    )
    clearance: float = option(
        0.35,
        help="An estimated footprint closer than this to a lane is left out, because lanes are free.",
        unit="m",
        validator=attrs.validators.ge(0),
    )

    doors: DoorState = doors_option()

    def load(self) -> World:
        """Read walls, doors, furniture, lifts and lanes."""
        notes = Notes()
        document = read_site(self.file, notes) if is_site(self.file) else yaml.load(self.file)
        building = Node(document, document.data)
        nodes = self._levels(building)
        refuse_navigation_graph(nodes)
        frames = read_frames(building, nodes, notes)
        drawings = {name: _drawing(node, frames[name], notes) for name, node in nodes.items()}
        if self.doors == "open":
            drawings = {name: attrs.evolve(drawing, doors=()) for name, drawing in drawings.items()}
        lifts = read_lifts(building, frames, notes)
        vertices, lanes = read_graph(tuple(drawings.values()), lifts, notes)
        footprints = Footprints(self.footprints)
        levels = []
        for index, (name, drawing) in enumerate(drawings.items()):
            bare = _bare_level(name, drawing, index, lifts, notes)
            drawn = _named_lanes(index, vertices, lanes)
            models = read_models(drawing.node, frames[name], footprints, drawn, self.clearance, notes)
            levels.append(attrs.evolve(bare, obstacles=models))
        activities, people = read_crowd_sim(building, tuple(drawings.values()), notes)
        note_unsupported(building, nodes, notes)
        return World(
            name=self._world_name(building),
            levels=tuple(levels),
            vertices=vertices,
            lanes=lanes,
            notes=notes.sentences(),
            lifts=lifts,
            activities=activities,
            people=people,
        )

    def _levels(self, building: Node) -> dict[str, Node]:
        """The levels to load, the reference level first."""
        section = building.fields().get("levels")
        if section is None or not section.fields():
            raise building.error("has no levels", "is it a traffic editor file?")
        levels = section.fields()
        if self.level is not None:
            if self.level not in levels:
                raise section.error(f"no level {self.level!r}", f"levels: {', '.join(levels)}", key=True)
            return {self.level: levels[self.level]}
        stated = building.fields().get("reference_level_name")
        if stated is None or not stated.text():
            return levels
        if stated.text() not in levels:
            raise stated.error(f"no level {stated.text()!r}", f"levels: {', '.join(levels)}")
        return {stated.text(): levels[stated.text()], **levels}

    def _world_name(self, building: Node) -> str:
        parts = building.fields()
        stated = next((parts[key].text() for key in ("name", "building_name") if key in parts), "")
        return stated or self.file.name.split(".")[0]


def _drawing(node: Node, frame: Frame, notes: Notes) -> LevelDrawing:
    positions = frame(read_vertices(node))
    return LevelDrawing(node, positions, read_doors(node, positions, notes))


def _bare_level(name: str, drawing: LevelDrawing, index: int, lifts: tuple[Lift, ...], notes: Notes) -> Level:
    elevation = drawing.node.fields().get("elevation")
    shafts = [lift for lift in lifts if index in lift.levels]
    holes = read_areas(drawing.node, "holes", drawing.positions, notes)
    return Level(
        name=name,
        elevation=0.0 if elevation is None else elevation.number(),
        walls=read_walls(drawing.node, drawing.positions, notes),
        doors=tuple(drawing.doors),
        floors=read_areas(drawing.node, "floors", drawing.positions, notes),
        holes=tuple(hole for hole in holes if not any(_is_shaft(hole, lift) for lift in shafts)),
    )


def _is_shaft(hole: Area, lift: Lift) -> bool:
    return lift.holds(*hole.polygon.mean(axis=0).tolist())


def _named_lanes(level: int, vertices: tuple[Vertex, ...], lanes: tuple[Lane, ...]) -> list[tuple[str, np.ndarray]]:
    named = []
    for lane in lanes:
        ends = [vertices[index] for index in (lane.start, lane.end)]
        if ends[0].level == level:
            called = " – ".join(end.name or f"({end.x:.2f}, {end.y:.2f})" for end in ends)
            named.append((called, np.array([(end.x, end.y) for end in ends])))
    return named
