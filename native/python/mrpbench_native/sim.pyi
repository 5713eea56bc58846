"""Robots, contacts and lidars in the plane, in C++. Plain arrays in, new arrays out; metres, radians, seconds.

Segments are f8[S,4] x1, y1, x2, y2, solid on their left. Everything raises ValueError for data that make no sense and
lets other threads run; one `Plane` belongs to one thread at a time, a `Caster` to any number.
"""

import numpy as np
from numpy.typing import NDArray

class Plane:
    """Robots with differential drives, discs to whatever they touch, among walls and movers."""

    def __init__(
        self,
        *,
        segments: NDArray[np.float64],
        radius: NDArray[np.float64],
        limit: NDArray[np.float64],
        acceleration: NDArray[np.float64],
        wheel_separation: NDArray[np.float64],
        pose: NDArray[np.float64],
        period: float,
        slip: float,
        actuation: float,
        seed: int,
    ) -> None:
        """Robots at `pose` f8[n,3].

        `radius` f8[n+m] is first the robots', then the movers', which are nowhere until `step` says where. `limit` and
        `acceleration` f8[n,2] are of speed and turn rate. `slip` is the mean share of its travel that a wheel loses,
        `actuation` the standard deviation of the relative error of speeds; `seed` is below 2**64.
        """
    def step(self, twist: NDArray[np.float64], movers: NDArray[np.float64] | None = None) -> None:
        """Advance by one control period under commands f8[n,2]; put movers at f8[m,2], or leave them."""
    def set_leaves(self, segments: NDArray[np.float64]) -> None:
        """What is solid besides the segments given at first, from now on: f8[S,4] of doors."""
    def place(self, robot: int, x: float, y: float) -> None:
        """Put a robot elsewhere, as it is: a lift has carried it to another level."""
    @property
    def pose(self) -> NDArray[np.float64]:
        """f8[n,3]."""
    @property
    def twist(self) -> NDArray[np.float64]:
        """f8[n,2] over ground."""
    @property
    def contacts(self) -> NDArray[np.int32]:
        """i4[k,2] of the last step, sorted: a robot, and a robot of higher index or -1 for anything else."""

class Caster:
    """Lidars of one kind among segments and discs. Beam i points at i * 2*pi / beams from straight ahead."""

    def __init__(
        self,
        *,
        segments: NDArray[np.float64],
        beams: int,
        range: float,
        min_range: float,
        forward: float,
        leftward: float,
    ) -> None: ...
    def scan(
        self,
        robots: NDArray[np.int32],
        pose: NDArray[np.float64],
        movers: NDArray[np.float64],
        radius: NDArray[np.float64],
        leaves: NDArray[np.float64] | None = None,
    ) -> NDArray[np.float64]:
        """Ranges f8[k,beams] of `robots` i4[k] among all robots at `pose` f8[n,3] and movers at f8[m,2]; inf = none.

        `radius` f8[n+m]. No robot sees itself. A mover at infinity is nowhere. `leaves` f8[S,4] are
        solid besides the segments.
        """
