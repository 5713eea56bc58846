"""Fleets that follow routes, in C++. Arrays in, views or new arrays out; metres, radians, seconds.

All functions raise ValueError for arrays of wrong lengths and TypeError for those of wrong types. What `Navigation`
knows of n robots are arrays that it writes in place.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

class Navigation:
    """The progress of a fleet on its routes, and what lies ahead of each robot."""

    def __init__(self, *, rules: dict[str, Any], activities: dict[str, NDArray[np.bool_]]) -> None:
        """`rules` are those of `ArrivalRules` and `ProgressRules` of the navigator `waypoints`, and `beyond_bends`.

        `activities` holds bool[n] `aborted`, `recovering`, `rotating` and `detouring`, which are read in each period.
        """
    def adopt(self, tables: dict[str, Any], cut: NDArray[np.int32] | None = None) -> None:
        """Follow routes in tables (see `RouteTables`), which leave out the first `cut` i4[n] segments of the old ones.

        The tables are read as long as the routes are followed; they must not change.
        """
    def update(
        self,
        pose: NDArray[np.float64],
        twist: NDArray[np.float64],
        released: NDArray[np.int32],
        level: NDArray[np.int16],
    ) -> bool:
        """Count what robots have reached and cleared; tell whether anything has changed."""
    def survey(
        self, now: float, pose: NDArray[np.float64], twist: NDArray[np.float64], limits: NDArray[np.float64]
    ) -> tuple[int, bool, list[int], list[int]]:
        """Write `state` and the leading k of `rows`; `limits` f8[n] m/s may be empty.

        Returns k, whether any robot is stuck, the rows whose turn it is to ask for a detour, and those that are
        blocked.
        """
    def rejoin(self, robot: int, x: float, y: float) -> None:
        """Let a robot continue from a point of its released route."""
    def skip_path_end(self, robot: int) -> None:
        """Count the end of a robot's path as reached."""
    def only_turns(self, robot: int) -> bool:
        """Tell whether a robot is at the place to go to next, and has only to turn there."""
    def hurry(self, robot: int) -> None:
        """Let a robot ask for a detour at once."""
    @property
    def state(self) -> dict[str, NDArray[Any]]:
        """Read-only views: `reached` and `cleared` i4[n], `foot` f8[n,2], `begin` and `end` i8[n], `yaw` and `speed`
        f8[n], and `under_way`, `following` and `stuck` u1[n].
        """
    @property
    def rows(self) -> dict[str, NDArray[Any]]:
        """Read-only views of n rows, of which `survey` writes the first: `robot`, `begin` and `end` i8, `pose` f8[n,3],
        `twist` and `foot` f8[n,2], `yaw` and `speed` f8.
        """

class ProgressChecker:
    """Whether robots make progress; `Navigation` has one."""

    def __init__(self, robots: int, radius: float, allowance: float, angle: float) -> None:
        """A robot has to move by `radius` or turn by `angle` within `allowance`; inf = turning is no progress."""
    def begin(self, now: float) -> None:
        """Begin a control period."""
    def is_stuck(self, robot: int, x: float, y: float, yaw: float, under_way: bool, speed: float) -> bool:
        """Tell whether a robot is stuck; its time then begins anew."""

class PurePursuit:
    """Pure pursuit of a fleet."""

    def __init__(self, *, options: dict[str, Any], robots: NDArray[np.float64]) -> None:
        """`options` are those of the controller `pure_pursuit`, and `period`.

        `robots` f8[n,5] are cruising speed, turn rate on the spot, greatest turn rate, acceleration and turn
        acceleration.
        """
    def command(
        self,
        robot: NDArray[np.int64],
        pose: NDArray[np.float64],
        twist: NDArray[np.float64],
        foot: NDArray[np.float64],
        points: NDArray[np.float64],
        begin: NDArray[np.int64],
        end: NDArray[np.int64],
        yaw: NDArray[np.float64],
        speed: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """Return the commands f8[k,2] of k robots; see `Observations`."""
