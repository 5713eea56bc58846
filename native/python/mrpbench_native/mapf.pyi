"""Multi-agent path finding in C++. Plain arrays in, plain arrays out."""

from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from mrpbench_native.options import Option

class Roadmap:
    """A roadmap for several instances; solvers go on with the distances that they found on it for the one before."""

    def __init__(self, arrays: dict[str, Any]) -> None: ...

class Instance:
    """Robots on a roadmap. `mrpbench_native.instances.build_instance` makes one; each dict holds arrays by name.

    Raises ValueError for data that make no sense, and TypeError for an array of the wrong type or shape. Lists of
    several robots or resources are stored one after another: those of number i are [first[i], first[i + 1]).
    """

    def __init__(
        self,
        *,
        roadmap: dict[str, Any] | Roadmap,
        robots: dict[str, Any],
        exclusions: dict[str, Any],
        resources: dict[str, Any],
        following_forbidden: bool,
        disappear_at_goal: bool,
        k: int = 0,
        horizon: int | None = None,
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

def bottleneck(cost: NDArray[np.float64]) -> float | None:
    """The least cost such that all rows can have different columns that cost no more; None if there is none.

    Augmenting paths: Derigs and Zimmermann, Computing 1978.

    Args:
        cost: f8[n,m] with n <= m, infinite where a pair is forbidden.

    Raises:
        ValueError: it has more rows than columns, or a cost is NaN or -inf.
    """

def cheapest_assignment(cost: NDArray[np.float64]) -> NDArray[np.int32] | None:
    """i4[n]: the column of each row, all different, with the least sum of costs; None if there is none.

    Shortest augmenting paths: Jonker and Volgenant, Computing 1987. The least sum is found except for rounding, and
    equal matrices give equal assignments.

    Args:
        cost: f8[n,m] with n <= m, infinite where a pair is forbidden.
    """

class Reordering:
    """The best order of robots found."""

    @property
    def status(self) -> Literal["solved", "timeout", "out_of_memory", "unsolvable"]:
        """`solved`: proved to be the best; `unsolvable`: every order is a cycle."""
    @property
    def switched(self) -> NDArray[np.uint8]:
        """u1[k]: 1 where the switched arc of a pair holds, 0 where the planned one does; [0] without an order."""
    @property
    def cost(self) -> int:
        """Sum of the earliest times of the last events in ticks, -1 without an order."""
    @property
    def planned_cost(self) -> int:
        """That of the planned order, -1 if it is a cycle."""
    @property
    def lower_bound(self) -> int: ...
    @property
    def expansions(self) -> int: ...
    @property
    def work(self) -> int:
        """Number of times of events computed."""
    @property
    def decisions(self) -> int:
        """Number of groups of pairs that can only be decided alike."""

def earliest(first: NDArray[np.int32], duration: NDArray[np.int32], arcs: NDArray[np.int32]) -> NDArray[np.int32]:
    """Compute the earliest time i4[events] of each event in ticks.

    Args:
        first: as for `reorder`.
        duration: as for `reorder`.
        arcs: i4[k,3] of (event before, event after, least ticks between them), all of which hold.

    Raises:
        ValueError: the arcs form a cycle, or make no sense.
    """

def open_orders(
    *,
    first: NDArray[np.int32],
    duration: NDArray[np.int32],
    fixed: NDArray[np.int32],
    planned: NDArray[np.int32],
    switched: NDArray[np.int32],
    together: NDArray[np.int32],
    begin: NDArray[np.int64],
    limit: int,
) -> NDArray[np.int32]:
    """Find the pairs whose order may stay open: whichever way all of them are decided, there is no cycle.

    Su, Veerapaneni and Li, "Bidirectional temporal plan graph", AAAI 2024.

    Args:
        first: as for `reorder`.
        duration: as for `reorder`.
        fixed: as for `reorder`.
        planned: as for `reorder`.
        switched: as for `reorder`.
        together: i4[events]: the first event of a set of events that are at the same time, such as the event itself.
        begin: i8[k] by pair: groups of pairs are tried in the order of their least value.
        limit: number of groups that are tried.

    Returns:
        The group i4[k] of each pair whose order may stay open, -1 for the others.

    Raises:
        ValueError: indices out of range, arcs within one robot, or a planned order with a cycle.
    """

def reorder(
    *,
    first: NDArray[np.int32],
    duration: NDArray[np.int32],
    fixed: NDArray[np.int32],
    planned: NDArray[np.int32],
    switched: NDArray[np.int32],
    wall_s: float,
    memory_bytes: int,
    work_limit: int | None = None,
) -> Reordering:
    """Find the order of robots with the least sum of arrivals: graph-based switchable edge search.

    Feng, Paul, Chen and Li, ICAPS 2024; Jiang, Lin and Li, AAAI 2025.

    Args:
        first: i4[n+1]: the events of robot r are [first[r], first[r + 1]), its first one at time 0.
        duration: i4[events] least ticks from an event to the next one of its robot, at least 1.
        fixed: i4[...,3] of (event before, event after, least ticks between them).
        planned: i4[k,3] arcs of which exactly one holds together with the same row of `switched`.
        switched: i4[k,3] between the same two robots in the other direction.
        wall_s: at this limit the best order found is returned.
        memory_bytes: limit of what the search counts.
        work_limit: number of computed times of events at which the best order found is returned, which does not depend
            on the clock; None = no limit.

    Raises:
        ValueError: indices out of range, arcs within one robot, or times below 1.
    """
