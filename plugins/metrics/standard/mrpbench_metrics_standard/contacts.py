"""Counts contacts: episodes of touching."""

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int32


def episodes(time: Float, contact: Int32, pause: float) -> tuple[int, int]:
    """Count the episodes between robots and those with walls.

    Args:
        time: f8[k] seconds of each row of `contact`.
        contact: i4[k,2]: robot and what it touched (another robot, or -1 = wall or obstacle).
        pause: seconds; touches of a pair at most this far apart belong to one episode.
    """
    pair = np.sort(contact, axis=1)  # -1 sorts first
    order = np.lexsort((time, pair[:, 1], pair[:, 0]))
    pair, time = pair[order], time[order]
    begins = np.ones(len(time), bool)
    begins[1:] = (pair[1:] != pair[:-1]).any(axis=1) | (np.diff(time) > pause)
    wall = pair[:, 0] < 0
    return int((begins & ~wall).sum()), int((begins & wall).sum())
