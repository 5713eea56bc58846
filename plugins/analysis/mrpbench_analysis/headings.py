"""Headings that a recording does not give, from the direction of motion."""

import attrs
import numpy as np

from mrpbench_core.api.format import Track

STEP = 0.02
"""metres. A shorter step between two poses has no direction."""


def with_headings(track: Track) -> tuple[Track, str | None]:
    """Replace unknown headings (NaN) of a track, and say so.

    Where a robot stands, the heading is that of its last move, and before its first move that of the first; a robot
    that never moves has the heading 0.
    """
    unknown = np.isnan(track.pose[:, 2])
    if not unknown.any():
        return track, None
    step = np.diff(track.pose[:, :2], axis=0, append=track.pose[-1:, :2])
    moves = np.flatnonzero(np.hypot(*step.T) >= STEP)
    pose = track.pose.copy()
    if len(moves):
        newest = np.clip(np.searchsorted(moves, np.arange(len(pose)), side="right") - 1, 0, None)
        bearing = np.arctan2(step[moves, 1], step[moves, 0])[newest]
        how = "taken from the direction of motion"
    else:
        bearing, how = np.zeros(len(pose)), "0, because the robot does not move"
    pose[unknown, 2] = bearing[unknown]
    note = f"{track.robot}: {np.count_nonzero(unknown)} of {len(pose)} headings are unknown ({track.topic}): {how}"
    return attrs.evolve(track, pose=pose), note
