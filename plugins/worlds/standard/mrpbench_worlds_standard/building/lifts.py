"""Lifts of a building file."""

import math
from collections.abc import Iterable, Mapping, Sequence

import attrs
import numpy as np

from mrpbench_core.files.text import counted
from mrpbench_core.model.worlds.world import Door, Lift
from mrpbench_worlds_standard.building.coordinates import Frame
from mrpbench_worlds_standard.building.node import Node
from mrpbench_worlds_standard.building.notes import Notes

TOUCHING = 1e-6
"""metres: cabins that overlap by less than this only touch."""
SAME = 0.1
"""metres: cabins and doors that are nearer than this are the same, drawn twice."""


def read_lifts(building: Node, frames: Mapping[str, Frame], notes: Notes) -> tuple[Lift, ...]:
    """Return the lifts that serve a level of `frames`, in the order of the file. All their doors are double sliding."""
    section = building.fields().get("lifts")
    heights = _heights(building, frames)
    lifts: list[Lift] = []
    for name, node in ({} if section is None else section.fields()).items():
        lift = _lift(name, node, frames, building.fields()["levels"], notes)
        if lift is None:
            continue
        for other in [other for other in lifts if _share_shaft(lift, other, heights)]:
            if not _is_same(lift, other):
                raise node.error(
                    f"lifts {other.name!r} and {name!r} are in the same shaft",
                    "move one of them, or let one lift serve the levels of both",
                    key=True,
                )
            notes.add(f"lifts {other.name!r} and {name!r} have the same cabin and doors and are one")
            lifts.remove(other)
            lift = _merged(lift, other)
        lifts.append(lift)
    return tuple(lifts)


def _is_same(lift: Lift, other: Lift) -> bool:
    """Tell whether two lifts are one that is drawn twice: the same cabin and the same doors."""
    points, others = (
        {"": one.corners, **{door.name: np.array([door.start, door.end]) for door in one.doors}}
        for one in (lift, other)
    )
    return points.keys() == others.keys() and all(
        np.allclose(points[name], others[name], rtol=0, atol=SAME) for name in points
    )


def _merged(lift: Lift, other: Lift) -> Lift:
    """Return one lift that serves the levels of both, by the name of that which serves more."""
    first, second = (lift, other) if len(lift.levels) > len(other.levels) else (other, lift)
    opens = {door.name: levels for door, levels in zip(second.doors, second.door_levels, strict=True)}
    return attrs.evolve(
        first,
        levels=tuple(dict.fromkeys((*first.levels, *second.levels))),
        door_levels=tuple(
            tuple(dict.fromkeys((*levels, *opens[door.name])))
            for door, levels in zip(first.doors, first.door_levels, strict=True)
        ),
    )


def _heights(building: Node, levels: Iterable[str]) -> list[float]:
    """Return the elevations of the levels, or their numbers if some elevations are equal."""
    fields = building.fields()["levels"].fields()
    elevations = [_number(fields[level], "elevation", 0.0) for level in levels]
    return elevations if len(set(elevations)) == len(elevations) else [float(index) for index in range(len(elevations))]


def _share_shaft(lift: Lift, other: Lift, heights: Sequence[float]) -> bool:
    """Tell whether the cabins of two lifts overlap at some height."""
    (low, high), (bottom, top) = (
        (min(heights[level] for level in one.levels), max(heights[level] for level in one.levels))
        for one in (lift, other)
    )
    if high < bottom or top < low:
        return False
    # Separating axis theorem: two convex polygons are apart if and only if a side of one separates them.
    for yaw in (lift.yaw, lift.yaw + math.pi / 2, other.yaw, other.yaw + math.pi / 2):
        axis = np.array([math.cos(yaw), math.sin(yaw)])
        first, second = lift.corners @ axis, other.corners @ axis
        if min(first.max(), second.max()) - max(first.min(), second.min()) < TOUCHING:
            return False
    return True


def _lift(name: str, node: Node, frames: Mapping[str, Frame], levels: Node, notes: Notes) -> Lift | None:
    fields = node.fields()
    width, depth = (_positive(node, key) for key in ("width", "depth"))
    number = {level: index for index, level in enumerate(frames)}
    for key in ("reference_floor_name", "initial_floor_name", "lowest_floor", "highest_floor"):
        if key in fields and fields[key].text():
            _known_level(fields[key], fields[key].text(), levels)
    stops = _stops(name, node, levels, notes)
    if len(stops) < 2:
        notes.add(f"lift {name!r} serves {counted(len(stops), 'level')} and is left out: a lift needs at least two")
        return None
    served = [level for level in stops if level in number]
    if not served:
        notes.add(f"lift {name!r} stops at no level that is loaded and is left out")
        return None
    reference = fields["reference_floor_name"].text() if "reference_floor_name" in fields else ""
    if reference and reference not in frames:
        notes.add(f"lift {name!r} is drawn on level {reference!r}, which is not loaded, and is left out")
        return None
    frame = frames[reference or served[0]]
    x, y = frame(np.array([[_number(node, "x"), _number(node, "y")]]))[0].tolist()
    yaw = _number(node, "yaw", 0.0) + frame.rotation
    initial = fields["initial_floor_name"].text() if "initial_floor_name" in fields else ""
    doors = {} if "doors" not in fields else fields["doors"].fields()
    return Lift(
        name=name,
        x=x,
        y=y,
        yaw=yaw,
        width=width,
        depth=depth,
        levels=tuple(number[level] for level in served),
        initial_level=number[initial if initial in served else served[0]],
        doors=tuple(_door(door, x, y, yaw, doors[door]) for door in doors),
        door_levels=tuple(tuple(number[level] for level in served if door in stops[level]) for door in doors),
    )


def _stops(name: str, node: Node, levels: Node, notes: Notes) -> dict[str, list[str]]:
    """Return the doors that open on each level that the lift serves."""
    fields = node.fields()
    doors = {} if "doors" not in fields else fields["doors"].fields()
    stops = {}
    for level, names in ({} if "level_doors" not in fields else fields["level_doors"].fields()).items():
        _known_level(names, level, levels, key=True)
        opening = [door.text() for door in names.items()]
        for door in opening:
            if door not in doors:
                raise names.error(f"lift {name!r} opens the door {door!r} on level {level!r}, which it does not have")
        if opening:
            stops[level] = opening
        else:
            notes.add(f"lift {name!r} has no door on level {level!r} and does not stop there")
    return stops


def _known_level(node: Node, level: str, levels: Node, *, key: bool = False) -> None:
    if level not in levels.fields():
        raise node.error(f"no level {level!r}", f"levels: {', '.join(levels.fields())}", key=key)


def _door(name: str, x: float, y: float, yaw: float, node: Node) -> Door:
    """Return a door; the file gives its centre in metres from that of the cabin, its direction and its width."""
    dx, dy = _number(node, "x"), _number(node, "y")
    middle = (x + dx * math.cos(yaw) - dy * math.sin(yaw), y + dx * math.sin(yaw) + dy * math.cos(yaw))
    along = yaw + _number(node, "motion_axis_orientation", 0.0)
    half = _positive(node, "width") / 2
    ends = [(middle[0] + side * math.cos(along), middle[1] + side * math.sin(along)) for side in (-half, half)]
    return Door(name=name, start=ends[0], end=ends[1], motion="double_sliding", height=2.5)


def _number(node: Node, key: str, default: float | None = None) -> float:
    value = node.fields().get(key)
    if value is not None:
        return value.number()
    if default is None:
        raise node.error(f"has no {key!r}")
    return default


def _positive(node: Node, key: str) -> float:
    value = _number(node, key)
    if value <= 0:
        raise node.fields()[key].error(f"{key} should be positive")
    return value
