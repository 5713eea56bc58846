"""A place robots live in: walls, doors, obstacles and the navigation graph.

Metres, radians, x right, y up (ROS REP 103).
"""

from collections.abc import Mapping
from typing import Any

import attrs

from mrpbench_core.model.arrays import Float, array
from mrpbench_core.model.occupancy import Occupancy


@attrs.frozen(kw_only=True)
class Door:
    """A passage from `start` to `end` (x, y in metres) that can be closed."""

    name: str
    start: tuple[float, float]
    end: tuple[float, float]
    motion: str = "sliding"
    """hinged, double_hinged, sliding or double_sliding."""


@attrs.frozen(kw_only=True)
class Obstacle:
    """Something solid that is not a wall: a polygon f8[k,2] in metres, counter-clockwise."""

    name: str
    polygon: Float = array("f8", 2)
    height: float = 1.0
    estimated: bool = False
    """True when the footprint is our estimate, not a fact of the map."""


@attrs.frozen(kw_only=True)
class Level:
    """One floor of a world."""

    name: str
    elevation: float = 0.0
    walls: Float = array("f8", 4, factory=list)
    """f8[W,4]: centre lines x1, y1, x2, y2 in metres."""
    wall_thickness: float = 0.1
    """Walls are boxes around their centre line, extended by half the thickness at both ends."""
    wall_height: float = 2.5
    doors: tuple[Door, ...] = ()
    obstacles: tuple[Obstacle, ...] = ()
    occupancy: Occupancy | None = None
    """The raster of a map that is one by nature (MovingAI, ROS map_server); its blocked cells are solid."""


@attrs.frozen(kw_only=True)
class Vertex:
    """A named place of the navigation graph."""

    name: str
    x: float
    y: float
    level: int = 0
    parameters: Mapping[str, Any] = attrs.field(factory=dict)


@attrs.frozen(kw_only=True)
class Lane:
    """A straight lane between two vertices (indices into `World.vertices`)."""

    start: int
    end: int
    bidirectional: bool = True
    graph: int = 0
    """RMF graph index: which fleet's graph the lane belongs to."""
    speed_limit: float = 0.0
    """m/s; 0 means none."""
    orientation: str = ""
    """'' | forward | backward: how a robot must face along the lane."""
    mutex: str = ""
    door: str = ""


@attrs.frozen(kw_only=True)
class World:
    """Levels and the navigation graph over them. Immutable; positions in metres in one frame, `map`."""

    name: str
    levels: tuple[Level, ...]
    vertices: tuple[Vertex, ...] = ()
    lanes: tuple[Lane, ...] = ()
    notes: tuple[str, ...] = ()
    """What the loader did not understand or had to assume, one sentence each."""
