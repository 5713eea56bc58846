"""Lists the parts of a building file that are not supported, with counts; nothing is dropped silently."""

from collections.abc import Mapping

from mrpbench_worlds_standard.building.node import Node
from mrpbench_worlds_standard.building.notes import Notes

_BUILDING_READ = (
    "name",
    "building_name",
    "levels",
    "lifts",
    "coordinate_system",
    "parameters",
    "reference_level_name",
    "crowd_sim",
)
_BUILDING_IGNORED = ("map_version", "graphs")
_LEVEL_READ = ("vertices", "lanes", "walls", "doors", "models", "floors", "holes", "measurements", "fiducials")
_LEVEL_IGNORED = (  # background, and what the editor uses to align it
    *("elevation", "drawing", "x_meters", "y_meters", "flattened_x_offset", "flattened_y_offset"),
    *("layers", "features", "constraints"),
)


def note_unsupported(building: Node, levels: Mapping[str, Node], notes: Notes) -> None:
    """Add a note for every part of the file that has no effect on the world."""
    top = building.fields()
    others = [name for name in top["levels"].fields() if name not in levels]
    if others:
        chosen = ", ".join(map(repr, levels))
        notes.add(f"only level {chosen} is loaded, not {', '.join(map(repr, others))}")
    _note_unknown(top, (*_BUILDING_READ, *_BUILDING_IGNORED), "building", notes)
    for level in levels.values():
        parts = level.fields()
        if "human_lanes" in parts and parts["human_lanes"].value:
            notes.add(f"human lanes are not supported: {len(parts['human_lanes'].items())} left out")
        _note_unknown(parts, (*_LEVEL_READ, *_LEVEL_IGNORED, "human_lanes"), "level", notes)


def refuse_navigation_graph(levels: Mapping[str, Node]) -> None:
    """Refuse the navigation graph that `building_map_generator nav` writes, which looks like a building.

    Its vertices are `[x, y, {parameters}]` in metres, those of a building `[x, y, z, name, {parameters}]`.

    Raises:
        InputError: a level has such vertices.
    """
    for level in levels.values():
        for vertex in level.section("vertices"):
            if len(items := vertex.items()) == 3 and isinstance(items[2].value, dict):
                raise vertex.error(
                    "this is an RMF navigation graph, not a building",
                    "name the .building.yaml file that it is made from",
                )


def _note_unknown(parts: dict[str, Node], known: tuple[str, ...], owner: str, notes: Notes) -> None:
    for key in parts:
        if key not in known:
            notes.add(f"{owner} key {key!r} is not known and has no effect")
