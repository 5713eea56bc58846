"""Discs that push each other and are pushed out of walls."""

import numpy as np

from mrpbench_core.builtin.simulators.nearby import Nearby
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.common.intervals import overlapping

TOLERANCE = 1e-4
"""metres by which discs may overlap walls or each other."""
_ROUNDS = 20
_TOUCH = 1e-9


class Discs:
    """Robots (the first of the radii) and movers, which push but cannot be pushed."""

    def __init__(self, radii: Float, robots: int, segments: Float, stride: float) -> None:
        self._radii = radii
        self._robots = robots
        self._widest = float(radii.max(initial=0.0))
        self._nearby = Nearby(segments, self._widest + stride)

    def separate(self, before: Float, after: Float, leaves: Float) -> tuple[Float, set[tuple[int, int]]]:
        """Resolve overlaps of discs that moved from `before` to `after`, f8[n,2] each and at most `stride` apart.

        `leaves` f8[k,4] are the segments of doors.

        Returns where they end up, and the contacts: (robot, disc of higher index, or -1 for what does not move).
        """
        owner, walls = self._walls(after, leaves)
        centres = after
        contacts: set[tuple[int, int]] = set()
        for _ in range(_ROUNDS):
            pushed, overlaps = self._push(before, centres, owner, walls)
            contacts |= overlaps
            if pushed is None:
                return centres, contacts
            centres = pushed
        return self._take_back(before, centres, owner, walls), contacts

    def _walls(self, centres: Float, leaves: Float) -> tuple[Int, Float]:
        """Robots i8[k] and the segments f8[k,4] each could touch."""
        near = [self._nearby(x, y) for x, y in centres[: self._robots].tolist()]
        owner = np.repeat(np.arange(self._robots), [len(segments) for segments in near])
        robot, leaf = _close(centres[: self._robots], self._radii[: self._robots], leaves)
        return np.concatenate([owner, robot]), np.concatenate([*near, leaves[leaf]])

    def _push(
        self, before: Float, centres: Float, owner: Int, walls: Float
    ) -> tuple[Float | None, set[tuple[int, int]]]:
        """The positions after one round of pushing (None if nothing overlaps), and the overlaps.

        A robot that a mover would push into a wall stays where it was.
        """
        contacts: set[tuple[int, int]] = set()
        shift = np.zeros_like(centres)
        by_mover = np.zeros(len(centres), bool)
        for first, second in np.column_stack(self._overlapping(centres, _TOUCH)).tolist():
            contacts.add((first, second))
            offset = centres[second] - centres[first]
            distance = np.hypot(*offset)
            direction = offset / distance if distance > 0 else np.array([1.0, 0.0])
            push = direction * (self._radii[first] + self._radii[second] - distance)
            if second < self._robots:
                shift[first] -= push / 2
                shift[second] += push / 2
            else:
                shift[first] -= push
                by_mover[first] = True
        against = by_mover[owner] & (_overlap(centres + shift, self._radii, owner, walls) > _TOUCH)
        pushed = owner[against]  # movers that are not there yet are infinitely far away
        shift[pushed] = before[pushed] - centres[pushed]
        deep = _overlap(centres, self._radii, owner, walls)
        inside = np.flatnonzero(deep > _TOUCH)
        # A robot in several walls is pushed out of the one it is deepest in; the next rounds handle the others.
        for row in inside[np.argsort(deep[inside], kind="stable")].tolist():
            robot = int(owner[row])
            contacts.add((robot, -1))
            shift[robot] = _away(centres[robot], walls[row]) * deep[row]
        return (centres + shift if contacts else None), contacts

    def _overlapping(self, centres: Float, depth: float) -> tuple[Int, Int]:
        """Pairs of a robot i8[k] and a disc i8[k] of higher index that overlap by more than `depth`, in order."""
        first, second = np.sort(overlapping(centres[:, 0], centres[:, 0] + 2 * self._widest), axis=0)
        first, second = first[first < self._robots], second[first < self._robots]
        offset = centres[second] - centres[first]
        close = np.hypot(offset[:, 0], offset[:, 1]) < self._radii[first] + self._radii[second] - depth
        first, second = first[close], second[close]
        in_order = np.lexsort((second, first))
        return first[in_order], second[in_order]

    def _take_back(self, before: Float, after: Float, owner: Int, walls: Float) -> Float:
        """Undo the motion of robots that still overlap by too much, and of robots that these then overlap."""
        centres = after.copy()
        back = np.zeros(len(centres), bool)
        while True:
            stuck = self._stuck(centres, owner, walls) & ~back
            if not stuck.any():
                return centres
            back |= stuck
            centres[stuck] = before[stuck]

    def _stuck(self, centres: Float, owner: Int, walls: Float) -> Bool:
        stuck = np.zeros(len(centres), bool)
        stuck[np.concatenate(self._overlapping(centres, TOLERANCE))] = True
        stuck[self._robots :] = False
        stuck[owner[_overlap(centres, self._radii, owner, walls) > TOLERANCE]] = True
        return stuck


def _close(centres: Float, radii: Float, leaves: Float) -> tuple[Int, Int]:
    """Pairs of a robot and a segment whose boxes, with half a robot's width to spare, meet."""
    if not len(leaves):
        return np.empty(0, np.int64), np.empty(0, np.int64)
    low, high = np.minimum(leaves[:, :2], leaves[:, 2:]), np.maximum(leaves[:, :2], leaves[:, 2:])
    reach = 1.5 * radii[:, None, None]
    meet = ((centres[:, None] + reach >= low) & (centres[:, None] - reach <= high)).all(axis=2)
    robot, leaf = np.nonzero(meet)
    return robot, leaf


def _overlap(centres: Float, radii: Float, owner: Int, walls: Float) -> Float:
    """The depth f8[k] of each robot in the segment that it is paired with, metres; negative = apart."""
    overlap: Float = radii[owner] - point_segment_distance(centres[owner], walls[:, :2], walls[:, 2:])
    return overlap


def _away(centre: Float, wall: Float) -> Float:
    """The direction f8[2] straight from a segment, solid on its left, to a point; to its right from a point on it."""
    along = wall[2:] - wall[:2]
    offset = centre - wall[:2]
    share = min(max(float((offset * along).sum() / max(float((along * along).sum()), 1e-300)), 0.0), 1.0)
    gap = offset - share * along
    distance = float(np.hypot(gap[0], gap[1]))
    if distance > 0:
        return gap / distance
    right: Float = np.array([along[1], -along[0]])
    return right / max(float(np.hypot(right[0], right[1])), 1e-300)
