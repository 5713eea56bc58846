"""Robots on maps of cells, in C++. Arrays in, arrays written in place.

All functions raise ValueError for arrays of wrong lengths and for places outside of the maps, and TypeError for arrays
of wrong types.
"""

import numpy as np
from numpy.typing import NDArray

class Maps:
    """The maps of b environments, all of one shape; see `mrpbench_policies.maps`.

    A place is the number of a cell in the padded maps of all environments, row by row, one map after the other. Arrays
    of robots have any shape, the same in each call.
    """

    def __init__(self, blocked: NDArray[np.bool_], height: int, width: int) -> None:
        """`blocked` bool[b*height*width] is read in each call and may change between two calls."""
    def soft(
        self, active: NDArray[np.bool_], place: NDArray[np.int64], wish: NDArray[np.int64], to: NDArray[np.int64]
    ) -> int:
        """Write places after a step in which robots at `place` want to be at `wish`, by the rule `soft` of POGEMA.

        Returns how many active robots are not where they want to be.
        """
    def overwritten(
        self, active: NDArray[np.bool_], place: NDArray[np.int64], to: NDArray[np.int64], found: NDArray[np.bool_]
    ) -> None:
        """Write which active robots enter the cell of an active one with a higher index."""
    def free_actions(self, place: NDArray[np.int64], bits: NDArray[np.uint8]) -> None:
        """Write which actions lead to free cells: stay 1, up 2, down 4, left 8, right 16."""
    def distances(self, goal: int, steps: NDArray[np.int32]) -> None:
        """Write the steps i4[height*width] to a goal from each cell of its map, 2**20 where there is no way."""
    def pogema(
        self,
        shown: NDArray[np.bool_],
        place: NDArray[np.int64],
        goal: NDArray[np.int64],
        radius: int,
        windows: NDArray[np.float32],
    ) -> None:
        """Write POGEMA's observation `default`, f4[k,3,2*radius+1,2*radius+1]: obstacles, robots `shown`, and goal."""
