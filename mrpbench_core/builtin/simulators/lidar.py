"""A planar lidar among line segments and discs, in closed form."""

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Lidar

_SEAM = 1e-9
"""Share of its length by which a segment is prolonged, so that no beam passes between two that share an end."""


def scan(lidar: Lidar, pose: Float, segments: Float, centres: Float, radii: Float) -> Float:
    """Ranges f8[beams] in metres of the lidar of a robot at `pose` f8[3]; inf = no return.

    Args:
        lidar: the sensor and where it is mounted.
        pose: x, y, yaw of the robot's base.
        segments: f8[S,4], solid on their left; those that are seen from behind are ignored.
        centres: f8[k,2] of discs.
        radii: f8[k] of discs, metres.

    A beam ends at the first thing it meets; when that is nearer than `min_range` or farther than `range` it reads inf.
    """
    cosine, sine = np.cos(pose[2]), np.sin(pose[2])
    forward, leftward, _ = lidar.mount
    origin = pose[:2] + (cosine * forward - sine * leftward, sine * forward + cosine * leftward)
    angle = pose[2] + np.arange(lidar.beams) * (2 * np.pi / lidar.beams)
    ray = np.stack([np.cos(angle), np.sin(angle)])
    ranges = np.minimum(_to_segments(origin, ray, segments), _to_discs(origin, ray, centres, radii, lidar.range))
    ranges[(ranges < lidar.min_range) | (ranges > lidar.range)] = np.inf
    return ranges


def _to_segments(origin: Float, ray: Float, segments: Float) -> Float:
    """Distance f8[B] along each ray f8[2,B] to the nearest segment's front."""
    start = segments[:, :2] - origin
    along = segments[:, 2:] - segments[:, :2]
    area = along[:, 0] * start[:, 1] - along[:, 1] * start[:, 0]
    front = area > 0  # the sensor is on the right, the free side
    start, along, area = start[front], along[front], area[front]
    turn = ray[1] * along[:, 0, None] - ray[0] * along[:, 1, None]
    share = ray[0] * start[:, 1, None] - ray[1] * start[:, 0, None]
    # The ray meets the segment's line at distance area / turn, share / turn of its length from its start.
    meets = (turn > 0) & (share >= -_SEAM * turn) & (share <= (1 + _SEAM) * turn)
    distance = np.divide(area[:, None], turn, out=np.full(turn.shape, np.inf), where=meets)
    nearest: Float = distance.min(axis=0, initial=np.inf)
    return nearest


def _to_discs(origin: Float, ray: Float, centres: Float, radii: Float, reach: float) -> Float:
    """Distance f8[B] along each ray f8[2,B] to the nearest disc; a disc around the origin is at distance 0."""
    offset = centres - origin
    near = np.hypot(offset[:, 0], offset[:, 1]) <= reach + radii
    offset, radii = offset[near], radii[near]
    ahead = offset[:, :1] * ray[0] + offset[:, 1:] * ray[1]
    beside = offset[:, :1] * ray[1] - offset[:, 1:] * ray[0]
    squared = radii[:, None] ** 2 - beside**2
    depth = np.sqrt(np.maximum(squared, 0.0))
    meets = (squared >= 0) & (ahead + depth >= 0)
    nearest: Float = np.where(meets, np.maximum(ahead - depth, 0.0), np.inf).min(axis=0, initial=np.inf)
    return nearest
