"""Corridors: how far vehicles may leave the line of an edge (6.1.3 in 2.1, 6.1.5 in 3.0)."""

import math
from collections.abc import Mapping
from typing import Any

from mrpbench_core.api import Float
from mrpbench_live.fleet.regions import offsets
from mrpbench_live.vda5050.orders import RefusedError, references

SLACK = 1e-6
"""metres."""


def check_corridors(order: Mapping[str, Any], footprint: Float) -> None:
    """Check that a vehicle fits into the corridors of an order.

    Args:
        order: a valid message.
        footprint: f8[k,2] of the vehicle, metres.

    Raises:
        RefusedError: `VALIDATION_FAILURE`, or `UNSUPPORTED_PARAMETER` for corridors that have to be asked for.
    """
    for edge in order["edges"]:
        corridor = edge.get("corridor")
        if corridor is None:
            continue
        refers = references(order) | {"edgeId": edge["edgeId"]}
        left, right = float(corridor["leftWidth"]), float(corridor["rightWidth"])
        where = f"{edge['edgeId']!r} has a corridor of {left:g} m to the left and {right:g} m to the right"
        if not (math.isfinite(left) and math.isfinite(right)) or left + right <= 0:
            what = f"{where}: a vehicle that has to stay on its line has no corridor"
            raise RefusedError("VALIDATION_FAILURE", what, refers)
        if corridor.get("releaseRequired", False):
            found = refers | {"parameter": "corridor.releaseRequired"}
            what = f"{edge['edgeId']}: corridor.releaseRequired is not supported"
            raise RefusedError("UNSUPPORTED_PARAMETER", what, found, "CRITICAL")
        if of_contour(corridor):
            needed = float(footprint[:, 1].max()), float(-footprint[:, 1].min())
            if left < needed[0] - SLACK or right < needed[1] - SLACK:
                what = f"{where}, and the vehicle needs {needed[0]:g} m and {needed[1]:g} m"
                raise RefusedError("VALIDATION_FAILURE", what, refers)


def of_contour(corridor: Mapping[str, Any]) -> bool:
    """Tell whether the whole vehicle has to be in a corridor, not only its kinematic center, which is the default."""
    point = corridor.get("corridorReferencePoint", corridor.get("corridorRefPoint"))
    return bool(point == "CONTOUR")


def is_outside(corridor: Mapping[str, Any], line: Float, place: Float) -> bool:
    """Tell whether one of some places f8[p,2] is outside of the corridor along a line f8[k,2] (metres)."""
    if len(line) < 2:
        return False
    off = offsets(place, line)
    left, right = float(corridor["leftWidth"]), float(corridor["rightWidth"])
    return bool((off > left + SLACK).any() or (off < -right - SLACK).any())
