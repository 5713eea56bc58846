"""What is in the way of a robot that gives up, for events and records."""

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.worlds.solids import segments
from mrpbench_core.model.worlds.world import World

AHEAD = 0.4
"""metres of the path ahead that are looked at."""
_STEP = 0.05
"""metres between two places on the path that are looked at."""


def obstruction(fleet: Fleet, world: World, robot: int, pose: Float, level: Int16, path: Float) -> str:
    """Name what a robot would touch if it drove on along its path, or return "" if there is room.

    Args:
        fleet: the robots.
        world: the static map.
        robot: index of the robot.
        pose: f8[n,3] estimated, of the fleet.
        level: i2[n].
        path: f8[k,2] places to which the robot has to go next.
    """
    corners = np.concatenate([pose[None, robot, :2], path])
    at = np.append(0.0, np.cumsum(np.hypot(*np.diff(corners, axis=0).T)))
    places = np.arange(0.0, min(AHEAD, at[-1]) + _STEP, _STEP)
    points = np.column_stack([np.interp(places, at, corners[:, axis]) for axis in (0, 1)])
    gaps = np.hypot(*(pose[:, None, :2] - points).transpose(2, 0, 1)).min(axis=1) - fleet.radii - fleet.radii[robot]
    gaps[(level != level[robot]) | (np.arange(len(fleet)) == robot)] = np.inf
    if (gaps < 0).any():
        return f"{fleet.names[int(gaps.argmin())]} in the way"
    walls = segments(world, int(level[robot])) if world.levels else np.empty((0, 4))
    near = [point_segment_distance(point[None], walls[:, :2], walls[:, 2:]).min(initial=np.inf) for point in points]
    return "wall or obstacle in the way" if min(near) < fleet.radii[robot] else ""
