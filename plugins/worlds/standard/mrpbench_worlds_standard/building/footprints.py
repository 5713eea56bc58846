"""Footprints of models by name: our table and the user's."""

from functools import cache
from pathlib import Path

import attrs
import numpy as np

from mrpbench_core.files import yaml
from mrpbench_core.model.common.arrays import Float, array
from mrpbench_worlds_standard.building.node import Node

SHIPPED = Path(__file__).parents[1] / "data" / "footprints.yaml"
SIDES = 12
"""Number of sides of the polygon that represents a disc."""
_KEYS = ("size", "radius", "centre", "height", "origin")


@attrs.frozen(kw_only=True)
class Footprint:
    """The area of the floor that a model covers, in the model's frame."""

    polygon: Float = array("f8", 2)
    """f8[k,2] metres, counter-clockwise; k = 0 if the model is not an obstacle."""
    height: float = 1.0
    origin: float = 0.0
    """Height of the model's origin above its base, metres."""
    estimated: bool = True


class Footprints:
    """Finds footprints by the name of a model, with or without its owner (`OpenRobotics/Desk`, `Desk`)."""

    def __init__(self, file: Path | None = None) -> None:
        self._table = _shipped() if file is None else _shipped() | _read(file, estimated=False)

    def get(self, model: str) -> Footprint | None:
        """Return the footprint, or None if no table has the model."""
        return self._table.get(model, self._table.get(model.rpartition("/")[2]))


@cache
def _shipped() -> dict[str, Footprint]:
    return _read(SHIPPED, estimated=True)


def _read(file: Path, *, estimated: bool) -> dict[str, Footprint]:
    document = yaml.load(file)
    return {name: _footprint(node, estimated) for name, node in Node(document, document.data).fields().items()}


def _footprint(node: Node, estimated: bool) -> Footprint:
    fields = node.fields()
    for key in fields:
        if key not in _KEYS:
            raise fields[key].error(f"unknown key {key!r}", f"a footprint has {', '.join(_KEYS)}", key=True)
    if "size" in fields and "radius" in fields:
        raise node.error("a footprint has either size or radius")
    heights = {key: fields[key].number() for key in ("height", "origin") if key in fields}
    return Footprint(polygon=_polygon(fields), estimated=estimated, **heights)


def _polygon(fields: dict[str, Node]) -> Float:
    if "radius" in fields:
        angle = np.arange(SIDES) * 2 * np.pi / SIDES
        corners = np.stack([np.cos(angle), np.sin(angle)], axis=1) * _positive(fields["radius"])
    elif "size" in fields:
        corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * [
            _positive(side) / 2 for side in _pair(fields["size"])
        ]
    else:
        return np.empty((0, 2))
    polygon: Float = corners + ([value.number() for value in _pair(fields["centre"])] if "centre" in fields else 0.0)
    return polygon


def _pair(node: Node) -> list[Node]:
    if len(values := node.items(least=2)) > 2:
        raise node.error("should be two numbers: along the model's x and y axis")
    return values


def _positive(node: Node) -> float:
    value = node.number()
    if value <= 0:
        raise node.error("should be positive")
    return value
