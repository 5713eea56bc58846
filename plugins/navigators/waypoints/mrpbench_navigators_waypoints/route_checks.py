"""Conditions on a robot's place along its route, as named arrays.

`RouteTables` has one entry for each waypoint or corner of all routes. `RouteAhead` has, for each robot, a copy of those
that matter next. NaN means that there is nothing to check, and every comparison with it is false.
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

    def copy(self, robots: Int, table: Self, rows: Int) -> None:
        """Replace the entries of `robots` i8[k] by those at `rows` i8[k] of a table."""
        self.block[:, robots] = table.block.take(rows, axis=1)


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

    def terms(self) -> Float:
        """The terms f8[5,4,k] of `FleetChecks`, which hold also a little too early."""
        x, y, along_x, along_y = self.x, self.y, self.along_x, self.along_y
        none, beside = np.full_like(x, np.nan), -self.lateral_tolerance - SLACK
        bounds = self.tolerance * self.tolerance + SLACK, np.full_like(x, -SLACK), beside, beside
        directions = (none, along_x, -along_y, along_y), (none, along_y, along_x, -along_x)
        return np.array([(x,) * 4, (y,) * 4, *directions, bounds])


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

    def terms(self) -> Float:
        """The term f8[5,k] of `FleetChecks`, which holds when this does."""
        return np.array([self.x, self.y, self.normal_x, self.normal_y, np.full_like(self.x, -SLACK)])


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

    def terms(self) -> Float:
        """The term f8[5,k] of `FleetChecks`, the same to within rounding."""
        none = np.full_like(self.x, np.nan)
        return np.array([self.x, self.y, none, none, self.distance * self.distance])


class FleetChecks:
    """The next vertex, waypoint and corner of each of n robots, all checked in as few operations as possible.

    Each robot has six terms of five numbers: x, y of a place, x, y of a direction, and a bound. They lie so that each
    operation has all robots in a row.

    - Term 0: the squared distance from the vertex to be cleared is at least the bound.
    - Term 1: the squared distance from the next waypoint is at most the bound.
    - Terms 2 to 5: the way from the place in the direction is at least the bound. The robot is past the next waypoint,
      not too far from the line through it on either side, and past the line that bisects the corner.
    """

    VERTEX, WAYPOINT, CORNER = 0, slice(1, 5), 5
    """The terms of each."""

    def __init__(self, size: int) -> None:
        self._block = np.full((5, 6, size), np.nan)
        self._x, self._y, *direction, bound = self._block
        self._direction_x, self._direction_y = (component[2:] for component in direction)
        self._nearest, self._furthest, self._least = bound[0], bound[1], bound[2:]

    def replace(self, term: int | slice, robots: Int, values: Float, where: Bool) -> None:
        """Replace a term of `robots` i8[k] by `values` f8[5,...,k], NaN where `where` is false."""
        self._block[:, term][..., robots] = np.where(where, values, np.nan)

    def hold(self, x: Float, y: Float) -> tuple[Bool, Bool, Bool]:
        """Tell bool[n] each which robots at x, y f8[n] each may have reached, rounded and cleared what is next."""
        x, y = x - self._x, y - self._y
        past, left, right, rounded = x[2:] * self._direction_x + y[2:] * self._direction_y >= self._least
        x, y = x[:2], y[:2]
        squared = x * x + y * y
        reached: Bool = squared[1] <= self._furthest
        reached |= past & left & right
        return reached, rounded, squared[0] >= self._nearest


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
