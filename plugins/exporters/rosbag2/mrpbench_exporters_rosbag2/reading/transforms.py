"""Poses of robots in `map` from their chains of transforms."""

from collections.abc import Mapping

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_exporters_rosbag2.reading.series import Ordered

Edges = Mapping[str, tuple[str, Ordered]]
"""Each frame's parent, and its poses in it; a static frame has one."""
DEPTH = 100
"""Largest number of frames between a robot and `map`; more mean a cycle."""


def placed(edges: Edges, frame: str, root: str) -> Ordered | None:
    """Poses of `frame` in `root` whenever the transform of a moving frame nearest to the robot comes; None = no way.

    The transforms above it are interpolated, and held before the first and after the last.
    """
    chain: list[Ordered] = []
    while frame != root:
        if frame not in edges or len(chain) == DEPTH:
            return None
        frame, poses = edges[frame]
        chain.append(poses)
    moving = next((poses for poses in chain if len(poses.stamps) > 1), None)
    if moving is None:
        return None
    total = np.zeros((len(moving.stamps), 4))
    for poses in reversed(chain):
        total = compose(total, sample(poses, moving.stamps))
    return Ordered(moving.stamps, total)


def sample(poses: Ordered, stamps: Int) -> Float:
    """Poses f8[k,4] at `stamps` i8[k]."""
    since = (poses.stamps - poses.stamps[0]).astype(float)
    when = (stamps - poses.stamps[0]).astype(float)
    columns = [poses.rows[:, 0], poses.rows[:, 1], np.unwrap(poses.rows[:, 2]), poses.rows[:, 3]]
    return np.stack([np.interp(when, since, column) for column in columns], axis=-1)


def compose(outer: Float, inner: Float) -> Float:
    """Poses f8[k,4] of `inner`, given in frames with the poses `outer`."""
    cos, sin = np.cos(outer[:, 2]), np.sin(outer[:, 2])
    x = outer[:, 0] + cos * inner[:, 0] - sin * inner[:, 1]
    y = outer[:, 1] + sin * inner[:, 0] + cos * inner[:, 1]
    return np.stack([x, y, outer[:, 2] + inner[:, 2], outer[:, 3] + inner[:, 3]], axis=-1)
