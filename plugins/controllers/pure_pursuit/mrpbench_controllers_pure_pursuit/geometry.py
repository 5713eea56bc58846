"""The points that pursuing robots aim at, and the speeds from which they can stop in time; for many robots at once."""

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int


def carrots(first: Float, points: Float, begin: Int, end: Int, place: Float, distance: float) -> Float:
    """Return the first point of each path, prolonged straight beyond its end, that is `distance` metres from a robot.

    If a path begins farther away than that, it is the first point of the path.

    Args:
        first: f8[k,2], where the paths begin.
        points: f8[p,2], of all paths.
        begin: i8[k]; path i goes on with `points[begin[i]:end[i]]`.
        end: i8[k].
        place: f8[k,2] of the robots.
        distance: metres.
    """
    start, along = first.copy(), np.zeros_like(first)
    inside = _apart(first, place) < distance
    at, walking = begin.copy(), inside & (begin < end)
    while walking.any():
        rows = np.flatnonzero(walking)
        ahead = points[at[rows]]
        step = ahead - start[rows]
        longer = (step != 0).any(axis=1)
        along[rows[longer]] = step[longer]
        far = longer & (_apart(ahead, place[rows]) >= distance)
        start[rows[~far]] = ahead[~far]
        at[rows] += 1
        walking[rows] = ~far & (at[rows] < end[rows])
    length = np.hypot(along[:, 0], along[:, 1])
    along /= np.where(length > 0, length, 1.0)[:, None]
    # `start` lies inside the circle around the robot; the ray from there along the leg leaves it once.
    offset = place - start
    ahead_by = (offset * along).sum(axis=1)
    beside = offset[:, 0] * along[:, 1] - offset[:, 1] * along[:, 0]
    share = ahead_by + np.sqrt(np.maximum(distance * distance - beside * beside, 0.0))
    prolonged = inside & (length > 0)  # else all of the path is one point, or it begins outside
    aim: Float = np.where(prolonged[:, None], start + share[:, None] * along, start)
    return aim


def path_lengths(first: Float, points: Float, begin: Int, end: Int, enough: Float) -> Float:
    """Return the lengths f8[k] of paths (see `carrots`) in metres; for longer paths at least `enough` f8[k]."""
    length = np.zeros(len(first))
    here, at, rows = first.copy(), begin.copy(), np.flatnonzero(begin < end)
    while len(rows):
        ahead = points[at[rows]]
        length[rows] += _apart(ahead, here[rows])
        here[rows] = ahead
        at[rows] += 1
        rows = rows[(length[rows] < enough[rows]) & (at[rows] < end[rows])]
    return length


def stopping_speed(distance: Float, acceleration: Float, period: float) -> Float:
    """Return the highest speeds, kept for one period, from which robots can still stop within the distances."""
    speed: Float = acceleration * (np.sqrt(period * period + 2 * distance / acceleration) - period)
    return speed


def wrapped(angle: Float) -> Float:
    """Return angles in radians as -pi < angle <= pi."""
    error: Float = np.pi - np.remainder(np.pi - angle, 2 * np.pi)
    return error


def limited(wanted: Float, measured: Float, change: Float) -> Float:
    """Return `wanted`, limited to what is within `change` of the measured speeds."""
    result: Float = np.minimum(np.maximum(wanted, measured - change), measured + change)
    return result


def _apart(one: Float, other: Float) -> Float:
    distance: Float = np.hypot(one[:, 0] - other[:, 0], one[:, 1] - other[:, 1])
    return distance
