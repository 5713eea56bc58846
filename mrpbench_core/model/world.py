"""A place robots live in: walls, doors, obstacles, lifts and the navigation graph.

Metres, radians, x right, y up (ROS REP 103).
"""

import math
from collections.abc import Mapping
from typing import Any

import attrs
import numpy as np

from mrpbench_core.model.arrays import Float, array
from mrpbench_core.model.occupancy import Occupancy


@attrs.frozen(kw_only=True)
class Door:
    """A passage from `start` to `end` (x, y in metres) that can be closed."""

    name: str
    start: tuple[float, float]
    end: tuple[float, float]
    motion: str = "sliding"
    """hinged, double_hinged, sliding, double_sliding, telescope or double_telescope."""
    motion_axis: str = "start"
    """start | end: where a single leaf is hinged, or the side that it slides towards."""
    motion_direction: int = 1
    """1 | -1: a hinged leaf turns counter-clockwise or clockwise as it opens."""
    motion_degrees: float = 90.0
    """How far a hinged leaf turns."""
    right_left_ratio: float = 1.0
    """Length of the leaf at `end` over that of the leaf at `start`, for doors of two leaves."""
    thickness: float = 0.03
    height: float = 2.2

    @property
    def width(self) -> float:
        """Metres between the posts."""
        return math.dist(self.start, self.end)


@attrs.frozen(kw_only=True)
class Obstacle:
    """Something solid that is not a wall: a polygon f8[k,2] in metres, counter-clockwise."""

    name: str
    polygon: Float = array("f8", 2)
    height: float = 1.0
    estimated: bool = False
    """True when the footprint is our estimate, not a fact of the map."""


@attrs.frozen(kw_only=True)
class Area:
    """A part of a floor: a polygon f8[k,2] in metres."""

    polygon: Float = array("f8", 2)


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
    floors: tuple[Area, ...] = ()
    """Where the floor is drawn; () = everywhere."""
    holes: tuple[Area, ...] = ()
    """Where it has holes: nothing solid, but robots keep clear of them. Lift shafts are not among them."""


@attrs.frozen(kw_only=True)
class Lift:
    """A cabin that carries robots between levels: a rectangle around (x, y), turned by `yaw`."""

    name: str
    x: float
    y: float
    yaw: float
    width: float
    """metres along the cabin's x axis."""
    depth: float
    """metres along its y axis."""
    levels: tuple[int, ...]
    """Indices into `World.levels` where it stops, in the order of its file."""
    initial_level: int
    doors: tuple[Door, ...] = ()
    """In the frame `map`; each opens cabin and shaft together."""
    door_levels: tuple[tuple[int, ...], ...] = ()
    """For each door, the levels on which it opens."""

    @property
    def corners(self) -> Float:
        """The cabin's corners f8[4,2], counter-clockwise."""
        half = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * (self.width / 2, self.depth / 2)
        cosine, sine = math.cos(self.yaw), math.sin(self.yaw)
        turned: Float = half @ np.array([(cosine, sine), (-sine, cosine)]) + (self.x, self.y)
        return turned

    def holds(self, x: float, y: float) -> bool:
        """Tell whether a point lies inside the cabin."""
        dx, dy = x - self.x, y - self.y
        cosine, sine = math.cos(self.yaw), math.sin(self.yaw)
        return abs(dx * cosine + dy * sine) <= self.width / 2 and abs(dy * cosine - dx * sine) <= self.depth / 2


@attrs.frozen(kw_only=True)
class Vertex:
    """A named place of the navigation graph."""

    name: str
    x: float
    y: float
    level: int = 0
    parameters: Mapping[str, Any] = attrs.field(factory=dict)
    lift: str = ""
    """The lift whose cabin it lies in."""


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
    """'' | forward | backward: how a robot should face along the lane, the other way on the way back. Robots here
    always face where they drive."""
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
    lifts: tuple[Lift, ...] = ()
