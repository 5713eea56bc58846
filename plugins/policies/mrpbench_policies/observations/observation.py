"""Contract of observations: what each robot perceives of a fleet on a grid."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mrpbench_policies.fleet_state import FleetState


class Field(NamedTuple):
    """One array of an observation, for one robot."""

    dtype: str
    shape: tuple[int, ...]
    low: float
    """Least value."""
    high: float
    """Largest value."""


class Observation(ABC):
    """Builds the observations of all robots of all environments at once; the same object serves planner and training.

    Args:
        radius: cells to each side that a robot perceives; a window has `2 * radius + 1` cells a side.
    """

    def __init__(self, radius: int = 5) -> None:
        self.radius, self.side = radius, 2 * radius + 1

    @abstractmethod
    def fields(self, shape: tuple[int, int]) -> Mapping[str, Field]:
        """Return the arrays of the observation of one robot, by name, on maps of a shape (rows, columns)."""

    @abstractmethod
    def observe(self, state: FleetState) -> Mapping[str, NDArray[Any]]:
        """Return the arrays of all robots, by name: rows are robots, those of the first environment first.

        `state.maps.margin` is `radius`.
        """


def agents(state: FleetState) -> NDArray[np.float32]:
    """Return f4[b*size]: 1 where a robot is, the observer included, as POGEMA 1.4 has it.

    A robot that followed one of a higher index is missing for one step; see `FleetState.overwritten`.
    """
    field = np.zeros(len(state.maps.blocked), np.float32)
    field[state.place[state.active & ~state.overwritten]] = 1.0
    return field
