"""Furniture of a building file: models with a footprint become obstacles."""

import math
from collections import defaultdict
from collections.abc import Sequence

import numpy as np

from mrpbench_core.checking.clearance import has_clearance
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.worlds.world import Level, Obstacle
from mrpbench_worlds_standard.building.coordinates import Frame
from mrpbench_worlds_standard.building.footprints import Footprint, Footprints
from mrpbench_worlds_standard.building.node import Node
from mrpbench_worlds_standard.building.notes import Notes

OUT_OF_REACH = 0.5
"""metres: models whose base is higher than this are in no robot's way."""
SHOWN = 3
_FIELDS = ("model_name", "name", "x", "y", "z", "yaw", "static", "dispensable")

NamedLanes = Sequence[tuple[str, Float]]
"""The name and the ends f8[2,2] of each lane of a level."""


def read_models(
    level: Node, frame: Frame, footprints: Footprints, lanes: NamedLanes, clearance: float, notes: Notes
) -> tuple[Obstacle, ...]:
    """Return the obstacles of a level; an estimated footprint within `clearance` of a lane is left out."""
    models: list[tuple[str, Obstacle]] = []
    for node in level.section("models"):
        fields = node.fields()
        for key in fields:
            if key not in _FIELDS:
                notes.add(f"model key {key!r} is not known and has no effect")
        if "model_name" not in fields or "x" not in fields or "y" not in fields:
            raise node.error("a model needs model_name, x and y")
        model = fields["model_name"].text()
        footprint = footprints.get(model)
        if footprint is None:
            notes.add(f"model {model!r} has no known footprint and is not an obstacle (option footprints)")
        elif not len(footprint.polygon):
            notes.add(f"model {model!r} is not an obstacle")
        elif _number(fields, "z") - footprint.origin > OUT_OF_REACH:
            notes.add(f"model {model!r} is higher than {OUT_OF_REACH} m above the floor and is not an obstacle")
        else:
            models.append((model, _obstacle(fields, frame, footprint)))
    return _off_lanes(models, lanes, clearance, notes)


def _obstacle(fields: dict[str, Node], frame: Frame, footprint: Footprint) -> Obstacle:
    place = frame(np.array([[fields["x"].number(), fields["y"].number()]]))[0]
    yaw = _number(fields, "yaw") + frame.rotation
    cosine, sine = math.cos(yaw), math.sin(yaw)
    name = fields["name"].text() if "name" in fields else fields["model_name"].text()
    return Obstacle(
        name=name,
        polygon=footprint.polygon @ np.array([(cosine, sine), (-sine, cosine)]) + place,
        height=footprint.height,
        estimated=footprint.estimated,
    )


def _number(fields: dict[str, Node], key: str) -> float:
    return fields[key].number() if key in fields else 0.0


def _off_lanes(
    models: list[tuple[str, Obstacle]], lanes: NamedLanes, clearance: float, notes: Notes
) -> tuple[Obstacle, ...]:
    if not lanes:
        return tuple(obstacle for _, obstacle in models)
    start, end = np.array([ends[0] for _, ends in lanes]), np.array([ends[1] for _, ends in lanes])
    obstacles = []
    blocked: dict[str, list[str]] = defaultdict(list)
    for model, obstacle in models:
        clear = has_clearance(Level(name="", obstacles=(obstacle,)), start, end, clearance)
        if clear.all() or not obstacle.estimated:
            obstacles.append(obstacle)
        else:
            blocked[model].append(lanes[int(np.flatnonzero(~clear)[0])][0])
    for model, names in blocked.items():
        listed = ", ".join(dict.fromkeys(names[:SHOWN])) + (", …" if len(names) > SHOWN else "")
        notes.add(
            f"model {model!r}: its estimated footprint is within {clearance:g} m of a lane and is left out there "
            f"({listed}; {len(names)} in all)"
        )
    return tuple(obstacles)
