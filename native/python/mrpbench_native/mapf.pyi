"""Multi-agent path finding in C++. Plain arrays in, plain arrays out."""

from typing import Literal

import numpy as np
from numpy.typing import NDArray

class Instance:
    """Robots on a roadmap. Raises ValueError for data that make no sense.

    Lists of several robots are stored one after another: those of robot r are [first[r], first[r + 1]).
    """

    def __init__(
        self,
        *,
        position: NDArray[np.float64],
        edges: NDArray[np.int32],
        duration: NDArray[np.int32],
        profile: NDArray[np.int32],
        radius: NDArray[np.float64],
        start: NDArray[np.int32],
        ready: NDArray[np.int64],
        goal_first: NDArray[np.int64],
        goal: NDArray[np.int32],
        committed_first: NDArray[np.int64],
        committed_edge: NDArray[np.int32],
        committed_enter: NDArray[np.int64],
        committed_leave: NDArray[np.int64],
        exclusion_first: NDArray[np.int64],
        exclusion_element: NDArray[np.int32],
        exclusion_distance: NDArray[np.float64],
        resource_first: NDArray[np.int64],
        resource_element: NDArray[np.int32],
        resource_capacity: NDArray[np.int32],
        resource_setup: NDArray[np.int64],
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

def astar(
    instance: Instance,
    *,
    heuristic: str,
    wall_s: float,
    memory_bytes: int,
) -> Answer:
    """Every robot alone: shortest paths that may conflict."""

def prioritized(
    instance: Instance,
    *,
    order: str,
    restarts: int,
    seed: int,
    wall_s: float,
    memory_bytes: int,
) -> Answer:
    """One robot after another by safe interval path planning."""

def cbs(
    instance: Instance,
    *,
    goal_choice: str = "own",
    prioritize: bool = True,
    bypass: bool = True,
    heuristic: bool = True,
    target: bool = True,
    corridor: bool = True,
    rectangle: bool = True,
    wall_s: float,
    memory_bytes: int,
) -> Answer:
    """The least sum of arrival times, by conflict-based search. goal_choice: own (each robot takes any of its), ranked
    or by_node (all take different ones, by trees for the cheapest assignments or by an assignment in each node).
    """

def bounded_cbs(
    instance: Instance,
    *,
    goal_choice: str = "own",
    selection: str,
    w: float,
    prioritize: bool,
    bypass: bool,
    heuristic: bool,
    target: bool,
    corridor: bool,
    rectangle: bool,
    flex: bool,
    incumbent_after: int | None,
    distance_weight: float,
    conflict_weight: float,
    wall_s: float,
    memory_bytes: int,
) -> Answer:
    """At most w times the least sum of arrival times, by bounded-suboptimal conflict-based search."""

def pbs(instance: Instance, *, wall_s: float, memory_bytes: int) -> Answer:
    """One robot after another, by a search over who comes before whom."""

def pibt(
    instance: Instance,
    *,
    swap: bool,
    steps: int,
    seed: int,
    wall_s: float,
    memory_bytes: int,
) -> Answer:
    """Tick by tick, by priority inheritance. Unit moves only: raises ValueError for other roadmaps."""

def lacam(
    instance: Instance,
    *,
    objective: str,
    swap: bool,
    prioritized: bool,
    guides: bool,
    star: bool,
    neighbourhoods: bool,
    iterations: int | None,
    seed: int,
    wall_s: float,
    memory_bytes: int,
) -> Answer:
    """A plan soon, by a search over configurations, and better ones later.

    Unit moves only: raises ValueError for other roadmaps.
    """

def lns(
    instance: Instance,
    *,
    objective: str,
    initial: str,
    neighbourhood: int | None,
    iterations: int | None,
    seed: int,
    wall_s: float,
    memory_bytes: int,
) -> Answer:
    """Plans groups of robots anew until there is no conflict, then for better plans."""
