"""Conditions on a robot's place along its route, as named arrays.

`RouteTables` has one entry for each waypoint or corner of all routes. `RouteAhead` has one entry for each robot, a
copy of the one that matters next; NaN means that there is nothing to check, and every comparison with it is false.
"""

from typing import ClassVar, Self

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int

SLACK = 1e-6
"""metres, or square metres where squares are compared."""


class Columns:
    """Named arrays f8[k], which are the rows of one block f8[c,k] so that all are copied in one operation."""

    width: ClassVar[int]
    """Number of names."""

    def __init__(self, block: Float) -> None:
        self.block = block

    @classmethod
    def unset(cls, size: int) -> Self:
        """Arrays of `size` entries, all NaN."""
        return cls(np.full((cls.width, size), np.nan))

    @classmethod
    def of(cls, *columns: Float) -> Self:
        """Join arrays f8[k], in the order of the names."""
        return cls(np.array(columns, float))

    def take(self, rows: Int) -> Self:
        """Copy the entries at `rows` i8[k]."""
        return type(self)(self.block.take(rows, axis=1))

    def copy(self, robots: Int, table: Self, rows: Int, where: Bool | None = None) -> None:
        """Replace the entries of `robots` i8[k] by those at `rows` i8[k] of a table, NaN where `where` is false."""
        values = table.block.take(rows, axis=1)
        self.block[:, robots] = values if where is None else np.where(where, values, np.nan)


class WaypointCheck(Columns):
    """Whether a waypoint is reached: the robot is near it, or passes it on the way."""

    width = 6

    def __init__(self, block: Float) -> None:
        super().__init__(block)
        self.x, self.y, self.tolerance, self.along_x, self.along_y, self.lateral_tolerance = block
        # `along` is the direction of the way to the waypoint; it is NaN where passing does not count.

    def holds(self, x: Float, y: Float) -> Bool:
        """Tell bool[k] for robots at x, y f8[k] each."""
        dx, dy = x - self.x, y - self.y
        reached: Bool = np.hypot(dx, dy) <= self.tolerance
        passed = dx * self.along_x + dy * self.along_y >= 0
        reached |= passed & (np.abs(self.along_x * dy - self.along_y * dx) <= self.lateral_tolerance)
        return reached

    def may_hold(self, x: Float, y: Float) -> Bool:
        """A faster `holds` that is true also a little too early."""
        dx, dy = x - self.x, y - self.y
        reached: Bool = dx * dx + dy * dy <= self.tolerance * self.tolerance + SLACK
        passed = dx * self.along_x + dy * self.along_y >= -SLACK
        reached |= passed & (np.abs(self.along_x * dy - self.along_y * dx) <= self.lateral_tolerance + SLACK)
        return reached


class CornerCheck(Columns):
    """Whether a corner is rounded: the robot is on the far side of the line that bisects its angle."""

    width = 4

    def __init__(self, block: Float) -> None:
        super().__init__(block)
        self.x, self.y, self.normal_x, self.normal_y = block

    def holds(self, x: Float, y: Float) -> Bool:
        """Tell bool[k] for robots at x, y f8[k] each."""
        rounded: Bool = (x - self.x) * self.normal_x + (y - self.y) * self.normal_y >= -SLACK
        return rounded


class ClearanceCheck(Columns):
    """Whether a vertex is cleared: the robot is so far from it that any other robot fits there."""

    width = 3

    def __init__(self, block: Float) -> None:
        super().__init__(block)
        self.x, self.y, self.distance = block

    def holds(self, x: Float, y: Float) -> Bool:
        """Tell bool[k] for robots at x, y f8[k] each."""
        cleared: Bool = np.hypot(x - self.x, y - self.y) >= self.distance
        return cleared

    def may_hold(self, x: Float, y: Float) -> Bool:
        """A faster `holds`, the same to within rounding."""
        dx, dy = x - self.x, y - self.y
        cleared: Bool = dx * dx + dy * dy >= self.distance * self.distance
        return cleared


class Legs(Columns):
    """Straight legs between two corners: a start x, y, the step dx, dy from there, and its squared length."""

    width = 5

    def __init__(self, block: Float) -> None:
        super().__init__(block)
        self.x, self.y, self.dx, self.dy, self.squared = block

    def nearest_points(self, x: Float | float, y: Float | float) -> Float:
        """The point f8[k,2] of each leg that is nearest to x, y."""
        along = (x - self.x) * self.dx + (y - self.y) * self.dy
        share = np.minimum(np.maximum(along / self.squared, 0.0), 1.0)
        points = np.empty((len(share), 2))
        points[:, 0] = self.x + share * self.dx
        points[:, 1] = self.y + share * self.dy
        return points
