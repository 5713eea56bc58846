"""Contacts of robots with people and other movers, from true poses and footprints, divided by who moved."""

from typing import NamedTuple

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.geometry import inside, point_segment_distance

TOUCH = 0.01
"""Metres between a footprint and the disc of a mover up to which they touch: more than either moves unnoticed."""
CLOSES = 0.01
"""m/s above which a motion brings two bodies nearer."""


class Moved(NamedTuple):
    """Numbers of contacts that have begun."""

    robot: int
    """The robot moved towards the mover, whatever the mover did."""
    mover: int
    """Only the mover moved towards the robot."""


def contacts_of(
    footprint: Float, time: Float, pose: Float, mover: Float, radius: Float, gap: Float, pause: float
) -> Moved:
    """Count the contacts of one robot; touches of a pair at most `pause` seconds apart are one contact.

    A motion is that since the sample before, with the other body at rest. A contact of the first sample counts for
    neither.

    Args:
        footprint: f8[k,2] metres, in the base frame.
        time: f8[T] seconds.
        pose: f8[T,3] of the robot.
        mover: f8[T,m,2] metres.
        radius: f8[m] metres.
        gap: f8[T,m] metres between the mover and the circumscribed disc of the robot; inf = not there.
        pause: seconds.
    """
    who, at = np.nonzero(gap.T <= TOUCH)
    touching = _gap(footprint, pose[at], mover[at, who], radius[who]) <= TOUCH
    who, at = who[touching], at[touching]
    begins = np.ones(len(at), bool)
    begins[1:] = (who[1:] != who[:-1]) | (np.diff(time[at]) > pause)
    who, at = who[begins & (at > 0)], at[begins & (at > 0)]
    before = _gap(footprint, pose[at - 1], mover[at - 1, who], radius[who])
    least = CLOSES * (time[at] - time[at - 1])
    by_robot = before - _gap(footprint, pose[at], mover[at - 1, who], radius[who]) > least
    by_mover = before - _gap(footprint, pose[at - 1], mover[at, who], radius[who]) > least
    return Moved(robot=int(by_robot.sum()), mover=int((by_mover & ~by_robot).sum()))


def _gap(footprint: Float, pose: Float, centre: Float, radius: Float) -> Float:
    """Metres f8[k] between a footprint at poses f8[k,3] and discs at f8[k,2]; negative = they overlap."""
    offset = centre - pose[:, :2]
    cosine, sine = np.cos(pose[:, 2]), np.sin(pose[:, 2])
    local = np.column_stack([cosine * offset[:, 0] + sine * offset[:, 1], cosine * offset[:, 1] - sine * offset[:, 0]])
    edges = point_segment_distance(local[:, None], footprint, np.roll(footprint, -1, axis=0)).min(axis=1)
    gap: Float = np.where(inside(footprint, local), -edges, edges) - radius
    return gap
