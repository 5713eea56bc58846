"""Robots, people, contacts and lidars in the plane, in C++. Plain arrays in, new arrays out; metres, radians, seconds.

Segments are f8[S,4] x1, y1, x2, y2, solid on their left. All functions raise ValueError for invalid data and
let other threads run. Only one thread at a time may use a `Plane`; any number of threads may use a `Caster`
of one thread.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_native.options import Option

class Plane:
    """Robots with differential drives among walls and movers; all of them collide as discs."""

    def __init__(
        self,
        *,
        segments: NDArray[np.float64],
        robots: dict[str, NDArray[np.float64]],
        movers: NDArray[np.float64],
        period: float,
        noise: dict[str, Any],
        seed: int,
    ) -> None:
        """`robots` holds arrays by name: `pose` f8[n,3], `radius` f8[n], `limit` and `acceleration` f8[n,2] of speed
        and turn rate, `wheel_separation` f8[n].

        `movers` f8[m] are the radii of movers, which have no place until `step` sets it. `noise` has the options that
        `noise_options` describes; `seed` is below 2**64.
        """
    def step(self, twist: NDArray[np.float64], movers: NDArray[np.float64] | None = None) -> None:
        """Advance by one control period under commands f8[n,2]; move movers to f8[m,2], or leave them."""
    def observe(self, pose: NDArray[np.float64], twist: NDArray[np.float64]) -> int:
        """Write `pose` f8[n,3] and `twist` f8[n,2] into arrays of the caller; return the number of `contacts`."""
    def set_leaves(self, segments: NDArray[np.float64]) -> None:
        """Replace the door leaves f8[S,4] that are solid besides the segments of the constructor."""
    def place(self, robot: int, x: float, y: float) -> None:
        """Move a robot to (x, y) with its yaw and speed, for example because a lift carried it to another level."""
    @property
    def pose(self) -> NDArray[np.float64]:
        """f8[n,3]."""
    @property
    def twist(self) -> NDArray[np.float64]:
        """f8[n,2] over ground."""
    @property
    def contacts(self) -> NDArray[np.int32]:
        """i4[k,2] of the last step, sorted: a robot, and a robot of higher index, n + the index of
        a mover, or -1 for what does not move.
        """

class Caster:
    """Lidars of one kind among segments and discs. Beam i points at i * 2*pi / beams from straight ahead."""

    def __init__(self, *, segments: NDArray[np.float64], lidar: Any, threads: int = 1) -> None:
        """`lidar` has the attributes of `mrpbench_core.model.common.fleet.Lidar`; `threads` share the robots."""
    def scan(
        self,
        robots: NDArray[np.int32],
        pose: NDArray[np.float64],
        movers: NDArray[np.float64],
        radius: NDArray[np.float64],
        leaves: NDArray[np.float64] | None = None,
        sides: NDArray[np.float64] | None = None,
        first: NDArray[np.int32] | None = None,
    ) -> NDArray[np.float64]:
        """Ranges f8[k,beams] of `robots` i4[k] among all robots at `pose` f8[n,3] and movers at f8[m,2]; inf = none.

        `radius` f8[n+m]. A robot does not see itself. A mover at infinity is absent. `leaves` f8[S,4] are
        solid besides the segments. Robot i is its disc, or `sides[first[i]:first[i + 1]]` within it: f8[K,4] in the
        robot's frame, solid on their left, and i4[n+1].
        """
    def begin(
        self,
        ranges: NDArray[np.float64],
        robots: NDArray[np.int32],
        pose: NDArray[np.float64],
        movers: NDArray[np.float64],
        radius: NDArray[np.float64],
        leaves: NDArray[np.float64] | None = None,
        sides: NDArray[np.float64] | None = None,
        first: NDArray[np.int32] | None = None,
    ) -> None:
        """As `scan`, but `ranges` f8[k,beams] are complete after `finish`; other threads go on with it until then."""
    def finish(self) -> None: ...

class Walkers:
    """People who walk by social forces or by optimal reciprocal collision avoidance. All stay out of walls, robots,
    leaves of doors and one another, but for 0.1 mm.
    """

    def __init__(
        self,
        *,
        segments: NDArray[np.float64],
        people: dict[str, NDArray[Any]],
        options: dict[str, Any],
        orca: bool,
    ) -> None:
        """`people` holds arrays by name: `place` f8[m,2], which are free, `radius` f8[m], `speed` f8[m], the largest,
        and `group` i4[m], -1 = none. `options` has those that `walker_options` describes.
        """
    def step(
        self,
        dt: float,
        wishes: dict[str, NDArray[Any]],
        others: NDArray[np.float64],
        radius: NDArray[np.float64],
        robots: int,
        leaves: NDArray[np.float64],
    ) -> None:
        """Walk for `dt` seconds.

        `wishes` holds `velocity` f8[m,2], further accelerations `push` f8[m,2], and how each person regards robots,
        `regard` u1[m]: 0 as people, 1 as obstacles, 2 not at all. `others` f8[k,4] are x, y, vx, vy of the discs of
        `radius` f8[k] that are not pushed, of which the first `robots` are robots. `leaves` f8[S,4] are solid.
        """
    @property
    def place(self) -> NDArray[np.float64]:
        """f8[m,2]."""
    @property
    def velocity(self) -> NDArray[np.float64]:
        """f8[m,2] of the last step, over ground."""

def walking_routes(free: NDArray[np.uint8], goal: int) -> NDArray[np.int32]:
    """For each cell of a raster u1[rows,columns], row by row, the cell to which to walk straight on the way to the
    cell `goal`, i4[rows*columns]; -1 = there is none.
    """

def walker_options() -> list[Option]:
    """The options of walking."""

def noise_options() -> list[Option]:
    """The options of the noise of wheels."""
