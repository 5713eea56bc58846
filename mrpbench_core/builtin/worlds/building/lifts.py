"""Lifts of a building file."""

import math
from collections.abc import Mapping

import numpy as np

from mrpbench_core.builtin.worlds.building.coordinates import Frame
from mrpbench_core.builtin.worlds.building.node import Node
from mrpbench_core.builtin.worlds.building.notes import Notes
from mrpbench_core.model.world import Door, Lift


def read_lifts(building: Node, frames: Mapping[str, Frame], notes: Notes) -> tuple[Lift, ...]:
    """Return the lifts that serve a level of `frames`, in the order of the file. All their doors are double sliding."""
    section = building.fields().get("lifts")
    lifts = []
    for name, node in ({} if section is None else section.fields()).items():
        lift = _lift(name, node, frames, building.fields()["levels"], notes)
        if lift is not None:
            lifts.append(lift)
    return tuple(lifts)


def _lift(name: str, node: Node, frames: Mapping[str, Frame], levels: Node, notes: Notes) -> Lift | None:
    fields = node.fields()
    width, depth = (_positive(node, key) for key in ("width", "depth"))
    number = {level: index for index, level in enumerate(frames)}
    stops = _stops(node, levels)
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
    for level, names in stops.items():
        for door in names:
            if door not in doors:
                raise node.error(f"lift {name!r} opens the door {door!r} on level {level!r}, which it does not have")
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


def _stops(node: Node, levels: Node) -> dict[str, list[str]]:
    """Return the doors that open on each level."""
    section = node.fields().get("level_doors")
    stops = {}
    for level, names in ({} if section is None else section.fields()).items():
        if level not in levels.fields():
            raise names.error(f"no level {level!r}", f"levels: {', '.join(levels.fields())}", key=True)
        stops[level] = [name.text() for name in names.items()]
    return stops


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
