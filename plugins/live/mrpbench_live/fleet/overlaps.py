"""Which robots touch by what they report: convex bodies at poses, by the separating axis theorem."""

import numpy as np

from mrpbench_core.api import Float, Int16, Int32, RobotModel


class Overlaps:
    """The bodies of a fleet.

    Args:
        robots: their footprints count as their convex hulls.
    """

    def __init__(self, robots: tuple[RobotModel, ...]) -> None:
        self._corners = [robot.footprint for robot in robots]
        self._radii = np.array([robot.radius for robot in robots])

    def of(self, pose: Float, level: Int16) -> Int32:
        """Return pairs i4[k,2] of robots whose bodies overlap, at poses f8[n,3] on levels i2[n]."""
        x, y = pose[:, 0], pose[:, 1]
        order = np.argsort(x, kind="stable")
        pairs = []
        reach = 2 * float(self._radii.max(initial=0.0))
        last = np.searchsorted(x[order], x[order] + reach, side="right")
        for at, robot in enumerate(order.tolist()):
            near = order[at + 1 : last[at]]
            close = np.hypot(x[near] - x[robot], y[near] - y[robot]) < self._radii[near] + self._radii[robot]
            others = near[close & (level[near] == level[robot])].tolist()
            pairs += [tuple(sorted((robot, other))) for other in others if self._overlap(robot, other, pose)]
        return np.array(sorted(pairs), np.int32).reshape(-1, 2)

    def _overlap(self, one: int, other: int, pose: Float) -> bool:
        first, second = (_placed(self._corners[robot], pose[robot]) for robot in (one, other))
        sides = np.concatenate([np.roll(corners, -1, axis=0) - corners for corners in (first, second)])
        normals = np.column_stack([-sides[:, 1], sides[:, 0]])
        along, across = first @ normals.T, second @ normals.T
        apart = (along.max(axis=0) <= across.min(axis=0)) | (across.max(axis=0) <= along.min(axis=0))
        return not apart.any()


def _placed(corners: Float, pose: Float) -> Float:
    cosine, sine = np.cos(pose[2]), np.sin(pose[2])
    turned: Float = corners @ np.array([[cosine, sine], [-sine, cosine]]) + pose[:2]
    return turned
