"""A small room with robots in it, for whatever moves robots."""

import math

import numpy as np

from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.arrays import Float
from mrpbench_core.model.execution import Route
from mrpbench_core.model.fleet import Fleet
from mrpbench_core.model.world import Level, World

PERIOD = 0.05
"""control period, simulated seconds"""
WIDTH, HEIGHT, HALF_WALL = 4.0, 3.0, 0.05
"""metres between the centre lines of the walls; the room's lower left corner is the origin"""
ROBOT = load_robot("turtlebot3_burger")


def room() -> World:
    """Four walls."""
    corners = [(0.0, 0.0), (WIDTH, 0.0), (WIDTH, HEIGHT), (0.0, HEIGHT)]
    walls = np.column_stack([corners, corners[1:] + corners[:1]])
    return World(name="room", levels=(Level(name="L1", walls=walls, wall_thickness=2 * HALF_WALL),))


def fleet(robots: int) -> Fleet:
    """TurtleBot3 Burgers."""
    return Fleet(robots=(ROBOT,) * robots)


def route(*points: tuple[float, float], yaw: float = math.nan) -> Route:
    """A route through points, without limits of speed."""
    waypoint = np.array([(x, y, math.nan) for x, y in points])
    waypoint[-1, 2] = yaw
    return Route(waypoint=waypoint, level=np.zeros(len(points), np.int16), speed=np.full(len(points) - 1, np.inf))


def driven(pose: Float, twist: Float, dt: float) -> Float:
    """Where unicycles at `pose` f8[n,3] are after driving the exact arcs of `twist` f8[n,2] for `dt` seconds."""
    turn = twist[:, 1] * dt
    chord = twist[:, 0] * dt * np.sinc(turn / (2 * np.pi))
    heading = pose[:, 2] + turn / 2
    return np.column_stack(
        [pose[:, 0] + chord * np.cos(heading), pose[:, 1] + chord * np.sin(heading), pose[:, 2] + turn]
    )
