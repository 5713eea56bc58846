"""A building: walls, doors, obstacles, lifts and the navigation graph.

Metres, radians, x right, y up (ROS REP 103).
"""

import math
from collections.abc import Mapping
from typing import Any

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float, array
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.routines import Activity, PeopleGroup


@attrs.frozen(kw_only=True)
class Door:
    """A passage from `start` to `end` (x, y in metres) that can be closed."""

    name: str
    start: tuple[float, float]
    end: tuple[float, float]
    motion: str = "sliding"
    """hinged, double_hinged, sliding, double_sliding, telescope or double_telescope."""
    motion_axis: str = "start"
    """start | end: the end at which a single leaf is hinged, or towards which it slides."""
    motion_direction: int = 1
    """1 | -1: a hinged leaf opens clockwise or counter-clockwise. Seen from `start` to `end`, a leaf hinged at `start`
    opens to the right with 1 and to the left with -1; the leaves of a double door open to the same side."""
    motion_degrees: float = 90.0
    """The angle between a closed and an open hinged leaf."""
    right_left_ratio: float = 1.0
    """Length of the leaf at `end` divided by that of the leaf at `start`, for doors with two leaves."""
    thickness: float = 0.03
    height: float = 2.2

    @property
    def width(self) -> float:
        """Metres between the posts."""
        return math.dist(self.start, self.end)


@attrs.frozen(kw_only=True)
class Obstacle:
    """A solid that is not a wall: a polygon f8[k,2] in metres, counter-clockwise."""

    name: str
    polygon: Float = array("f8", 2)
    height: float = 1.0
    estimated: bool = False
    """True if the footprint is an estimate and not given by the map."""


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
    doors: tuple[Door, ...] = ()
    obstacles: tuple[Obstacle, ...] = ()
    occupancy: Occupancy | None = None
    """The raster of a raster map (MovingAI, ROS map_server). Its blocked cells are solid."""
    floors: tuple[Area, ...] = ()
    """The drawn floor; () means that there is floor everywhere."""
    holes: tuple[Area, ...] = ()
    """Holes in the floor. They are not solid, but robots keep clear of them. Lift shafts are not holes."""


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
    """Indices into `World.levels` of the levels that it serves, in the order of the file."""
    initial_level: int
    doors: tuple[Door, ...] = ()
    """Doors in the frame `map`. A door closes the cabin and the shaft together."""
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
    """The name of the lift whose cabin contains it; '' if there is none."""


@attrs.frozen(kw_only=True)
class Lane:
    """A straight lane between two vertices (indices into `World.vertices`)."""

    start: int
    end: int
    bidirectional: bool = True
    graph: int = 0
    """The RMF graph index (`graph_idx`), which says to which fleet's navigation graph the lane belongs."""
    speed_limit: float = 0.0
    """m/s; 0 means none."""
    orientation: str = ""
    """'' | forward | backward: how an RMF robot faces on the lane. Our robots always drive forward."""
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
    """Unsupported features and assumptions of the loader, one sentence each."""
    lifts: tuple[Lift, ...] = ()
    activities: tuple[Activity, ...] = ()
    """What people do here, for crowds."""
    people: tuple[PeopleGroup, ...] = ()
    """How many people there usually are, and how they begin."""
