"""Where the robots are to go: a vertex for each posted `Destination`, or the error that it deserves."""

from typing import Any

import attrs
import numpy as np

from mrpbench_core.api import Roadmap
from mrpbench_live.rmf.messages import (
    CODE_INCOMPATIBLE_CONSTRAINT,
    CODE_UNKNOWN_DESTINATION,
)

REACH = 1.0
"""Metres from the roadmap within which a destination means its nearest vertex; on a raster, its cell."""


class RefusedError(Exception):
    """A destination cannot be planned for.

    Args:
        code: of `DestinationError`.
        message: why.
    """

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code, self.message = code, message


@attrs.frozen
class Wish:
    """Where a robot is to go."""

    session: bytes
    vertex: int


def wish_of(destination: Any, roadmap: Roadmap, level: int) -> Wish:
    """Return what a `Destination` means: the first point of its first region, as the reference plan server reads it.

    A target orientation chooses among the vertices at one place, where these have headings.

    Raises:
        RefusedError: it names no region, or none on the roadmap.
    """
    regions = destination.constraints.regions
    if not regions:
        raise RefusedError(
            CODE_INCOMPATIBLE_CONSTRAINT, "a destination needs a region; keys of graphs are not supported"
        )
    points = regions[0].region.points
    if len(points) < 2:
        raise RefusedError(CODE_INCOMPATIBLE_CONSTRAINT, "the first region has no point")
    x, y = map(float, points[:2])
    vertex = int(roadmap.locate(np.array([[x, y]]), np.array([level], np.int16))[0])
    if vertex < 0:
        raise RefusedError(CODE_UNKNOWN_DESTINATION, f"({x:g}, {y:g}) is not on the roadmap")
    for orientation in regions[0].orientations[:1]:
        vertex = int(roadmap.facing(np.array([vertex], np.int32), np.array([orientation.orientation_radians]))[0])
    return Wish(session=bytes(destination.session.uuid), vertex=vertex)
