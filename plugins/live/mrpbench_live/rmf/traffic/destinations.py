"""Where the robots are to go: a vertex for each posted `Destination`, or the error that it deserves."""

from typing import Any

import attrs

from mrpbench_core.api import Roadmap
from mrpbench_live.rmf.messages import (
    CODE_INCOMPATIBLE_CONSTRAINT,
    CODE_UNKNOWN_DESTINATION,
)

REACH = 1.0
"""Metres from the roadmap within which a destination means its nearest vertex; on a raster, its cell."""


@attrs.frozen
class Refused(Exception):  # noqa: N818 - the word of the interface is error, and this one is sent
    """A destination cannot be planned for."""

    code: int
    message: str


@attrs.frozen
class Wish:
    """Where a robot is to go."""

    session: bytes
    vertex: int


def wish_of(destination: Any, roadmap: Roadmap, level: int) -> Wish:
    """Return what a `Destination` means: the first point of its first region, as the reference plan server reads it.

    A target orientation chooses among the vertices at one place, where these have headings.

    Raises:
        Refused: it names no region, or none on the roadmap.
    """
    regions = destination.constraints.regions
    if not regions:
        raise Refused(CODE_INCOMPATIBLE_CONSTRAINT, "a destination needs a region; keys of graphs are not supported")
    points = regions[0].region.points
    if len(points) < 2:
        raise Refused(CODE_INCOMPATIBLE_CONSTRAINT, "the first region has no point")
    x, y = map(float, points[:2])
    vertex = int(roadmap.locate([[x, y]], [level])[0])  # type: ignore[arg-type,list-item]
    if vertex < 0:
        raise Refused(CODE_UNKNOWN_DESTINATION, f"({x:g}, {y:g}) is not on the roadmap")
    for orientation in regions[0].orientations[:1]:
        vertex = int(roadmap.facing([vertex], [float(orientation.orientation_radians)])[0])  # type: ignore[arg-type,list-item]
    return Wish(session=bytes(destination.session.uuid), vertex=vertex)
