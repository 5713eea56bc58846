"""Multi-agent path finding in C++. Plain arrays in, plain arrays out."""

from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from mrpbench_native.options import Option

class Instance:
    """Robots on a roadmap. `mrpbench_native.instances.build_instance` makes one; each dict holds arrays by name.

    Raises ValueError for data that make no sense, and TypeError for an array of the wrong type or shape. Lists of
    several robots or resources are stored one after another: those of number i are [first[i], first[i + 1]).
    """

    def __init__(
        self,
        *,
        roadmap: dict[str, Any],
        robots: dict[str, Any],
        exclusions: dict[str, Any],
        resources: dict[str, Any],
        following_forbidden: bool,
        disappear_at_goal: bool,
    ) -> None: ...

class Answer:
    """How a solver ended. The segments of robot r are [first[r], first[r + 1])."""

    @property
    def status(self) -> Literal["solved", "timeout", "out_of_memory", "unsolvable", "gave_up"]: ...
    @property
    def lower_bound(self) -> float:
        """Proved lower bound on the sum of arrival times in ticks, NaN if none."""
    @property
    def statistics(self) -> dict[str, int]:
        """Counters; failed_robot is -1 where no robot is to blame."""
    @property
    def clock_bound(self) -> bool:
        """The clock ended the search for a better plan."""
    @property
    def history(self) -> NDArray[np.float64]:
        """f8[...,3]: seconds, cost of the best plan until then, lower bound."""
    @property
    def first(self) -> NDArray[np.int64]:
        """i8[n+1], or [0] without a plan."""
    @property
    def edge(self) -> NDArray[np.int32]:
        """i4[...], -1 = wait."""
    @property
    def enter(self) -> NDArray[np.int64]:
        """i8[...] ticks."""
    @property
    def leave(self) -> NDArray[np.int64]:
        """i8[...] ticks."""

class Algorithm:
    """An algorithm and its options."""

    @property
    def name(self) -> str: ...
    @property
    def help(self) -> str:
        """One sentence."""
    @property
    def options(self) -> list[Option]: ...

def algorithms() -> list[Algorithm]:
    """All algorithms, in alphabetical order."""

def describe(name: str) -> Algorithm:
    """The algorithm of this name. Raises ValueError if there is none."""

def solve(
    instance: Instance,
    algorithm: str,
    options: dict[str, Any],
    *,
    wall_s: float,
    memory_bytes: int,
) -> Answer:
    """Solve an instance. Raises ValueError for an option that does not exist or that cannot have its value."""

def path_lengths(
    vertex_count: int,
    edges: NDArray[np.int32],
    length: NDArray[np.float64],
    sources: NDArray[np.int32],
    targets: NDArray[np.int32],
) -> NDArray[np.float64]:
    """f8[sources,targets], infinite where there is no path; edges i4[E,2], length f8[E] not below 0."""
