"""Moving objects in the scans of a fleet: tracks and predictions, in C++. Plain arrays in, new arrays out; metres,
seconds, in the frame `map`.

All functions raise ValueError for invalid data. Only one thread at a time may use a `Fleet`.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_native.options import Option

STEP: float
"""Seconds between the places that a `Fleet` predicts."""

class Fleet:
    """What each robot of a fleet tracks by its own scans."""

    def __init__(
        self,
        *,
        walls: NDArray[np.float64],
        mount: NDArray[np.float64],
        radius: NDArray[np.float64],
        options: dict[str, Any],
        social_force: bool,
        threads: int,
    ) -> None:
        """Robots with lidars at `mount` f8[n,2] and footprints of `radius` f8[n], among the walls f8[k,4] of the map.

        `options` are those of `options()`. Results do not depend on `threads`.
        """
    def see(
        self, now: float, robots: NDArray[np.int32], pose: NDArray[np.float64], ranges: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Use scans f8[k,beams] of `robots` i4[k], and return them with -1 where a beam ends on an object that moves.

        `pose` f8[n,3] are the poses of all robots.
        """
    def predict(self, now: float) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        """Return the robot i4[k] that tracks each object that moves, and its places f8[k,t,2] at `now`, `now` + `STEP`,
        and so on until the horizon.
        """
    def tracks(self, robot: int) -> NDArray[np.float64]:
        """Return all tracks f8[k,6] of one robot: x, y, vx, vy, number of detections, time of the last one."""

def social_force(
    objects: NDArray[np.float64],
    *,
    radius: float,
    walls: NDArray[np.float64],
    robots: NDArray[np.float64],
    robot_radius: NDArray[np.float64],
    step: float,
    count: int,
) -> NDArray[np.float64]:
    """Return places f8[k,count,2], `step` seconds apart, of objects f8[k,4] (x, y, vx, vy) that walk by social forces.

    They want the velocities that they have, and regard robots f8[r,2], which stay, as people.
    """

def options() -> list[Option]:
    """The options of tracking."""
