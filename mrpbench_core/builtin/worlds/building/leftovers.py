"""What a building file holds that we do not understand yet: named, with counts, never dropped in silence."""

from mrpbench_core.builtin.worlds.building.node import Node
from mrpbench_core.builtin.worlds.building.notes import Notes

_BUILDING_READ = ("name", "building_name", "levels", "coordinate_system", "reference_level_name")
_BUILDING_LOOKS = ("map_version", "graphs", "parameters")
_LEVEL_READ = ("vertices", "lanes", "walls", "doors", "measurements", "elevation")
_LEVEL_LOOKS = (  # background, and what the editor uses to align it
    *("drawing", "x_meters", "y_meters", "flattened_x_offset", "flattened_y_offset"),
    *("layers", "features", "constraints", "fiducials"),
)
_LEVEL_LATER = {
    "models": "models (furniture) are not obstacles yet",
    "floors": "floors are taken as boundless",
    "holes": "holes in floors are not understood yet",
    "human_lanes": "human lanes are not understood yet",
}


def note_leftovers(building: Node, level: Node, chosen: str, notes: Notes) -> None:
    """Remark on every part of the file that has no effect on the world."""
    top = building.fields()
    others = [name for name in top["levels"].fields() if name != chosen]
    if others:
        notes.add(f"only level {chosen!r} is loaded, not {', '.join(map(repr, others))}")
    lifts = top["lifts"].value if "lifts" in top else None
    if lifts:
        notes.add(f"lifts are not understood yet: {len(lifts)} left out")
    crowd = top["crowd_sim"].value if "crowd_sim" in top else None
    if isinstance(crowd, dict) and crowd.get("enable"):
        notes.add("crowd_sim is not understood yet: no people")
    _note_unknown(top, (*_BUILDING_READ, *_BUILDING_LOOKS, "lifts", "crowd_sim"), "building", notes)
    parts = level.fields()
    for key, sentence in _LEVEL_LATER.items():
        if key in parts and parts[key].value:
            notes.add(f"{sentence}: {len(parts[key].items())} left out")
    _note_unknown(parts, (*_LEVEL_READ, *_LEVEL_LOOKS, *_LEVEL_LATER), "level", notes)


def _note_unknown(parts: dict[str, Node], known: tuple[str, ...], owner: str, notes: Notes) -> None:
    for key in parts:
        if key not in known:
            notes.add(f"{owner} key {key!r} is not known and has no effect")
