"""Localisation and mapping of a fleet, in C++. Plain arrays in, new arrays out; metres, radians.

All functions raise ValueError for invalid data. Only one thread at a time may use a `Fleet`.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_native.options import Option

TILE: int
"""Cells to each side of a tile of a map."""

class Fleet:
    """A map for each robot, and its pose on it."""

    def __init__(self, *, placements: NDArray[np.float64], parameters: dict[str, Any]) -> None:
        """Robots at `placements` f8[n,3] in `map`, which they know. `parameters` are those of `options`."""
    def begin(self, odometry: NDArray[np.float64]) -> None:
        """Set the odometry f8[n,3] at the placements; call this once, before all other methods."""
    def sense(
        self,
        robots: NDArray[np.int32],
        ranges: NDArray[np.float64],
        odometry: NDArray[np.float64],
        *,
        now: float,
        range: float,
        min_range: float,
        forward: float,
        leftward: float,
    ) -> None:
        """Use scans f8[k,beams] of `robots` i4[k], taken at odometry f8[n,3] of the fleet; inf = no return.

        `now` is in seconds. A robot's first scan is used, later ones after it has moved for some time.
        """
    def poses(self, odometry: NDArray[np.float64]) -> NDArray[np.float64]:
        """Estimates f8[n,3] in `map`: those at the last scans, moved by the odometry f8[n,3] since then."""
    def scan_poses(self, robot: int) -> NDArray[np.float64]:
        """Poses f8[k,3] in `map` of the scans of one robot, as the graph has them now."""
    def loops(self, robot: int) -> int:
        """Number of loops that have moved the poses of one robot."""
    def changed_tiles(self, robot: int) -> tuple[NDArray[np.int32], NDArray[np.int8]]:
        """What has changed in one robot's map since the last call: indices i4[k,2] and cells i1[k,TILE,TILE] of tiles.

        The lower left corner of a tile is at its index (x, y) times `TILE` times the resolution in `map`. Cells are
        row by row from there: -1 = unknown, 0 = free, 100 = occupied, as in `nav_msgs/OccupancyGrid`.
        """

def optimised(
    poses: NDArray[np.float64],
    pairs: NDArray[np.int32],
    measured: NDArray[np.float64],
    information: NDArray[np.float64],
    *,
    huber: float = 0.0,
    fixed: int = 1,
) -> tuple[NDArray[np.float64], float]:
    """Return the poses f8[n,3] that fit relative poses best, and half of the sum of the losses.

    Constraint i says that pose `pairs[i, 1]` is at `measured[i]` f8[3] in the frame of pose `pairs[i, 0]`, with
    the information matrix `information[i]` f8[9] (row by row). Errors beyond `huber` standard deviations count
    linearly; 0 = all count by their squares. The first `fixed` poses stay, at least one.
    """

def options() -> list[Option]:
    """The parameters of localisation and mapping, those of slam_toolbox by its names."""
