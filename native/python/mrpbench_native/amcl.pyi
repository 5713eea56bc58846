"""Adaptive Monte Carlo localisation of a fleet, in C++. Plain arrays in, new arrays out; metres, radians.

All functions raise ValueError for invalid data. Only one thread at a time may use a `Fleet`.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_native.options import Option

class Fleet:
    """A particle filter for each robot, all on one map."""

    def __init__(
        self,
        *,
        segments: NDArray[np.float64],
        resolution: float,
        places: NDArray[np.float64],
        placements: NDArray[np.float64],
        seed: int,
        parameters: dict[str, Any],
    ) -> None:
        """Particles around `placements` f8[n,3] among `segments` f8[S,4], solid on their left.

        `resolution` is the side of the likelihood field's squares. Recovery draws particles on the squares of that side
        around `places` f8[k,2]. `parameters` are those of `options`. `seed` is below 2**64; the draws
        of a robot do not depend on other robots.
        """
    def begin(self, odometry: NDArray[np.float64]) -> None:
        """Set the odometry f8[n,3] at the placements; call this once, before all other methods."""
    def sense(
        self,
        robots: NDArray[np.int32],
        ranges: NDArray[np.float64],
        odometry: NDArray[np.float64],
        *,
        range: float,
        min_range: float,
        forward: float,
        leftward: float,
    ) -> None:
        """Update from scans f8[k,beams] of `robots` i4[k], taken at odometry f8[n,3] of the fleet; inf = no return."""
    def poses(self, odometry: NDArray[np.float64]) -> NDArray[np.float64]:
        """Estimates f8[n,3]: those of the last update, moved by the odometry f8[n,3] since then."""
    @property
    def covariances(self) -> NDArray[np.float64]:
        """f8[n,3,3] of the last updates."""
    def particles(self, robot: int) -> NDArray[np.float64]:
        """x, y, yaw, weight f8[k,4] of one robot's particles."""

def options() -> list[Option]:
    """The parameters of Nav2's AMCL."""
