"""Local navigation in C++: costmaps, and Nav2's controllers. Plain arrays in, new arrays out; metres, radians, seconds.

All functions raise ValueError for invalid data. `see` and `command` let other threads run; only one thread at a time
may use a `Fleet`.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_native.options import Option

class Fleet:
    """Local controllers, one per robot; one call computes the commands of all."""

    def __init__(self, *, walls: NDArray[np.float64], reach: float, threads: int) -> None:
        """`walls` f8[S,4] are those of the static map; a robot considers the walls within `reach` of it."""
    def add(
        self,
        *,
        controller: str,
        settings: dict[str, Any],
        footprint: NDArray[np.float64],
        critics: list[tuple[str, float, dict[str, Any]]] = ...,
        seed: int = 0,
    ) -> None:
        """Add a robot: the name of its controller, options of robot and controller by Nav2's names, footprint f8[k,2],
        critics with weight and options, seed of the run, by which and by the robot's index its controller draws.
        """
    def add_costmap(self, *, settings: dict[str, Any], footprint: NDArray[np.float64]) -> None:
        """Add a robot that has only a costmap: it is not commanded, and nothing is to be explained."""
    def see(
        self, now: float, robots: NDArray[np.int32], pose: NDArray[np.float64], ranges: NDArray[np.float64]
    ) -> None:
        """Mark scans f8[k,beams] of `robots` i4[k] in the costmaps; `pose` f8[n,3] is that of the whole fleet."""
    def foresee(
        self,
        robots: NDArray[np.int32],
        places: NDArray[np.float64],
        radius: NDArray[np.float64],
        step: float,
    ) -> None:
        """Tell robots where discs with `radius` f8[k] will be, for critics in the next call of `command`.

        `robots` i4[k], ascending, regard them; `places` f8[k,t,2] are those from now on, `step` seconds apart.
        """
    def command(
        self,
        seen: Any,
        score: Callable[[int, NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]] | None = None,
    ) -> NDArray[np.float64]:
        """Commands f8[k,2], NaN where none is admissible.

        `seen` has the attributes of `mrpbench_core.model.execution.observation.Observations`.
        `score` gets a robot, twists and poses of the m trajectories that its controller samples, and returns f8[m],
        which is added to their totals. Of `dwb`, twists are f8[m,2] and poses f8[m,p,3].
        """
    def clear(self, robot: int) -> None:
        """Remove the marks of scans."""
    def is_free(self, robot: int, poses: NDArray[np.float64]) -> NDArray[np.float64]:
        """1.0 for each of `poses` f8[k,3] where the robot fits, else 0.0."""
    def reroute(self, robot: int, x: float, y: float, path: NDArray[np.float64]) -> NDArray[np.float64] | None:
        """Points f8[k,2] from (x, y) around an obstacle to the path f8[p,2]; None = path free, or no detour."""
    def approach(
        self, robot: int, x: float, y: float, path: NDArray[np.float64], tolerance: float
    ) -> NDArray[np.float64] | None:
        """Points f8[k,2] from (x, y) to the free place nearest to the end of the path f8[p,2], at most `tolerance`
        metres from it; None = the end is free, or there is no such path.
        """
    def plan(
        self, now: float, robot: int, pose: NDArray[np.float64], goal: NDArray[np.float64], tolerance: float
    ) -> NDArray[np.float64] | None:
        """Points f8[k,2] from `pose` f8[1,3] to `goal` f8[1,2], or to a cell at most `tolerance` metres from it, over
        cells that the costmap does not show as occupied; None = there is no such way.
        """
    def explain(self, robot: int) -> dict[str, Any]:
        """What the controller computed for the last command, by name: arrays and lists of words."""
    def costmap(self, robot: int) -> tuple[NDArray[np.float64], float, float, float]:
        """Costs f8[rows,columns], x and y of the lower left corner, inscribed radius."""

def robot_options(group: str) -> list[Option]:
    """The options of the groups `costmap_grid`, `inflation`, `observation` and `further`, of all controllers."""

def controller_options(name: str, further: bool = False) -> list[Option]:
    """The options of a controller that Nav2 has, or `further` ones. Raises ValueError if there is none."""

def critic_options(controller: str, name: str) -> list[Option]:
    """The options of a critic of a controller. Raises ValueError if there is none of this name."""
