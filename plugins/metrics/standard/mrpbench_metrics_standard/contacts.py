"""Counts contacts: episodes of touching."""

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int32


def episodes(time: Float, contact: Int32, pause: float, robots: int) -> tuple[int, int, int]:
    """Count the episodes between robots, those with walls, and those with movers.

    Args:
        time: f8[k] seconds of each row of `contact`.
        contact: i4[k,2]: robot and what it touched (another robot, -1 = wall or obstacle, or `robots` + j = mover j).
        pause: seconds; touches of a pair at most this far apart belong to one episode.
        robots: number of robots.
    """
    pair = np.sort(contact, axis=1)  # -1 sorts first
    order = np.lexsort((time, pair[:, 1], pair[:, 0]))
    pair, time = pair[order], time[order]
    begins = np.ones(len(time), bool)
    begins[1:] = (pair[1:] != pair[:-1]).any(axis=1) | (np.diff(time) > pause)
    wall, mover = pair[:, 0] < 0, pair[:, 1] >= robots
    return int((begins & ~wall & ~mover).sum()), int((begins & wall).sum()), int((begins & mover).sum())
