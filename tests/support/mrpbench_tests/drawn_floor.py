"""Draws one floor in the format of the RMF traffic editor, for tests of what reads it.

The frame is a drawing of its own scale, rotation and origin in pixels, with y down, as on scanned plans. Written from
the description of the format and not from the reader, so that one checks the other.
"""

import math
from itertools import pairwise
from typing import Any

import numpy as np

Point = tuple[float, float]


class DrawnFloor:
    """Vertices, walls, doors and lanes of a floor, given in metres of the building with y up."""

    def __init__(self, name: str, elevation: float, scale: float, turn: float, origin: Point) -> None:
        """Begin a drawing of `scale` metres per pixel, turned by `turn` radians, with the origin at `origin` pixels."""
        self.name, self.elevation, self.scale, self.turn, self.origin = name, elevation, scale, turn, np.array(origin)
        self.places: dict[str, Point] = {}
        """Metres of the places at which robots may start and end."""
        self._number: dict[tuple[Point, str], int] = {}
        self._vertices: list[list[Any]] = []
        self._walls: list[list[Any]] = []
        self._doors: list[list[Any]] = []
        self._lanes: list[list[Any]] = []

    def pixel(self, point: Point) -> list[float]:
        """Return the pixel of a point."""
        cosine, sine = math.cos(self.turn), math.sin(self.turn)
        x, y = np.array([[cosine, -sine], [sine, cosine]]) @ point / self.scale + self.origin
        return [round(float(x), 4), round(-float(y), 4)]

    def vertex(self, point: Point, name: str = "", **parameters: str) -> int:
        """Return the number of the vertex of that name at a point, which is drawn the first time."""
        point = (round(point[0], 6), round(point[1], 6))
        if (point, name) not in self._number:
            self._number[point, name] = len(self._vertices)
            typed = [{key: [1, value] for key, value in parameters.items()}] if parameters else []
            self._vertices.append([*self.pixel(point), 0.0, name, *typed])
        return self._number[point, name]

    def place(self, point: Point, name: str) -> int:
        """Draw a vertex at which robots may start and end."""
        self.places[name] = point
        return self.vertex(point, name)

    def wall(self, *points: Point) -> None:
        """Draw walls along a line of points."""
        self._walls += [[self.vertex(a), self.vertex(b), {"alpha": [3, 1.0]}] for a, b in pairwise(points)]

    def wall_with_gaps(self, y: float, length: float, gaps: list[tuple[float, float]]) -> None:
        """Draw a wall along x from 0 to `length` with gaps (middle, width)."""
        sides = [0.0, *(x + half for x, width in sorted(gaps) for half in (-width / 2, width / 2)), length]
        for a, b in zip(sides[::2], sides[1::2], strict=True):
            self.wall((a, y), (b, y))

    def lane(self, *vertices: int) -> None:
        """Draw two-way lanes through vertices."""
        options = {"bidirectional": [4, True], "graph_idx": [2, 0], "orientation": [1, ""]}
        self._lanes += [[a, b, dict(options)] for a, b in pairwise(vertices)]

    def door(self, name: str, kind: str, start: Point, end: Point, axis: str, direction: int) -> None:
        """Draw a door."""
        options = {"name": [1, name], "type": [1, kind], "motion_axis": [1, axis], "motion_direction": [2, direction]}
        options |= {"motion_degrees": [3, 90.0], "right_left_ratio": [3, 1.0], "plugin": [1, "normal"]}
        self._doors.append([self.vertex(start), self.vertex(end), options])

    def section(self, corners: list[Point]) -> dict[str, Any]:
        """Return the floor's part of the file; `corners` are fiducials, and a measurement joins the first two."""
        ends = [self.vertex(corner) for corner in corners[:2]]
        return {
            "drawing": {"filename": f"{self.name}.png"},
            "elevation": self.elevation,
            "fiducials": [[*self.pixel(corner), f"corner_{index}"] for index, corner in enumerate(corners)],
            "measurements": [[*ends, {"distance": [3, math.dist(*corners[:2])]}]],
            "vertices": self._vertices,
            "walls": self._walls,
            "doors": self._doors,
            "lanes": self._lanes,
        }
