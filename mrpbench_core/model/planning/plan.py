"""The result of a planner: one timed path per robot, a status and statistics."""

from collections.abc import Mapping
from enum import StrEnum

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Int, Int32, array
from mrpbench_core.model.planning.roadmap import Roadmap


@attrs.frozen(kw_only=True)
class Path:
    """One robot's consecutive segments: moves along an edge and waits at a vertex.

    Segment s + 1 enters when segment s leaves. `leave - enter >= duration` of the edge; a wait may have any length.
    """

    edge: Int32 = array("i4")
    """i4[k]: index into `Roadmap.edges`, -1 = wait."""
    enter: Int = array("i8")
    """i8[k] ticks."""
    leave: Int = array("i8")
    """i8[k] ticks."""

    def __len__(self) -> int:
        return len(self.edge)

    def vertices(self, roadmap: Roadmap, start: int) -> Int32:
        """Vertices i4[k+1]: `start`, then the vertex at the end of each segment."""
        moves = self.edge >= 0
        heads = roadmap.edges[self.edge[moves], 1]
        visited: Int32 = np.concatenate([[start], heads])[np.concatenate([[0], moves.cumsum()])].astype(np.int32)
        return visited

    def end(self, roadmap: Roadmap, start: int) -> int:
        """The vertex at which the last segment ends; `start` if there is none."""
        return int(self.vertices(roadmap, start)[-1])

    @property
    def arrival(self) -> int:
        """Tick at which the last move ends, 0 if the robot never moves: its cost in classical MAPF."""
        moves = np.flatnonzero(self.edge >= 0)
        return int(self.leave[moves[-1]]) if len(moves) else 0


@attrs.frozen(kw_only=True)
class Plan:
    """One path per robot (the paper's *schedule*)."""

    paths: tuple[Path, ...]

    @property
    def sum_of_costs(self) -> int:
        """Sum over robots of the tick at which each is at its goal for good."""
        return sum(path.arrival for path in self.paths)

    @property
    def makespan(self) -> int:
        """Tick at which the last robot is at its goal for good."""
        return max((path.arrival for path in self.paths), default=0)


class PlanStatus(StrEnum):
    """The outcome of planning."""

    SOLVED = "solved"
    TIMEOUT = "timeout"
    OUT_OF_MEMORY = "out_of_memory"
    UNSOLVABLE = "unsolvable"
    """Proved: no plan exists."""
    GAVE_UP = "gave_up"
    """An incomplete planner found none, which proves nothing."""
    UNKNOWN = "unknown"
    """Of recordings of other fleets: whether and how anyone planned is not known. No planner returns it."""


@attrs.frozen(kw_only=True)
class AnytimePoint:
    """One point of an anytime curve: what a planner had after some time."""

    seconds: float
    """wall seconds since the call."""
    cost: float
    """Cost of the best plan until then: the sum of costs in ticks, or the planner's own objective; inf = none."""
    lower_bound: float = float("nan")
    """Proved until then, of the same cost; NaN if none."""


@attrs.frozen(kw_only=True)
class PlanResult:
    """Outcome of one call of a planner."""

    status: PlanStatus
    plan: Plan | None = None
    lower_bound: float = attrs.field(default=float("nan"), eq=repr)  # NaN equals NaN
    """Proved lower bound on the sum of costs, in ticks; NaN if the planner proves none."""
    clock_bound: bool = False
    """The plan depends on when the clock ended the search (anytime planners)."""
    statistics: Mapping[str, float] = attrs.field(factory=dict)
    """e.g. `expansions`, `generated`, `low_level_expansions`."""
    history: tuple[AnytimePoint, ...] = attrs.field(default=(), eq=False)  # wall times: no two runs have the same
    """The improvements of plan and bound, oldest first; () if the planner reports none. In a record: `timing`."""


@attrs.frozen(kw_only=True)
class Budget:
    """The limits of one call of a planner."""

    wall_s: float
    """seconds of wall time from the call; the planner returns `TIMEOUT` (or its best plan) when they are over."""
    memory_bytes: int
    iterations: int | None = None
    """For anytime planners: stop after this many, which is reproducible where a clock is not."""
    seed: int = 0
    """0 to 2^31 - 1: where a planner's random choices begin, unless its own option `seed` says otherwise."""
