"""The result of a planner: one timed path per robot, a status and statistics."""

from collections.abc import Iterable, Mapping, Sequence
from enum import StrEnum
from functools import cached_property

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Int, Int32, array, read_only
from mrpbench_core.model.common.flat_sequence import FlatSequence, firsts, joined, rows
from mrpbench_core.model.planning.roadmap import Roadmap


@attrs.frozen(kw_only=True)
class RobotPath:
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


Path = RobotPath  # its name until 0.3: plugins may still import it


@attrs.frozen(kw_only=True)
class Paths(FlatSequence[RobotPath]):
    """The paths of all robots."""

    first: Int = array("i8")
    """i8[n+1]: the segments of robot i are `first[i]:first[i + 1]`."""
    edge: Int32 = array("i4")
    """i4[m] as in `RobotPath`, like the other columns."""
    enter: Int = array("i8")
    leave: Int = array("i8")

    @classmethod
    def of(cls, paths: Iterable[RobotPath]) -> "Paths":
        """Join paths that have as many edges as times; `Paths` are returned as they are."""
        if isinstance(paths, Paths):
            return paths
        robot_paths = tuple(paths)
        return cls(
            first=firsts(map(len, robot_paths)),
            edge=joined((path.edge for path in robot_paths), "i4"),
            enter=joined((path.enter for path in robot_paths), "i8"),
            leave=joined((path.leave for path in robot_paths), "i8"),
        )

    def __len__(self) -> int:
        return len(self.first) - 1

    def _item(self, index: int) -> RobotPath:
        here = rows(self.first, index)
        return RobotPath(edge=self.edge[here], enter=self.enter[here], leave=self.leave[here])

    @cached_property
    def size(self) -> Int:
        """Number i8[n] of segments of each path."""
        return read_only(np.diff(self.first))

    @cached_property
    def robot(self) -> Int:
        """i8[m]: the robot of each segment."""
        return read_only(np.repeat(np.arange(len(self)), self.size))

    @cached_property
    def segment(self) -> Int:
        """i8[m]: the index of each segment in its path."""
        return read_only(np.arange(len(self.edge)) - np.repeat(self.first[:-1], self.size))

    def part(self, begin: Int | Int32, end: Int | Int32) -> "Paths":
        """The segments from `begin` i8[n] until before `end` i8[n] of each path; a path may have fewer."""
        robot, segment = self.robot, self.segment
        at = ((begin[robot] <= segment) & (segment < end[robot])).nonzero()[0]
        first = at.searchsorted(self.first)
        return Paths(first=first, edge=self.edge.take(at), enter=self.enter.take(at), leave=self.leave.take(at))

    def later(self, ticks: int) -> "Paths":
        """The paths at other times: all so many ticks later, or earlier if they are negative."""
        return attrs.evolve(self, enter=self.enter + ticks, leave=self.leave + ticks)

    def then(self, *others: "Paths") -> "Paths":
        """Each path, continued by that of the same robot in each of `others`."""
        parts = (self, *others)
        order = np.argsort(np.concatenate([part.robot for part in parts]), kind="stable")
        return Paths(
            first=np.sum([part.first for part in parts], axis=0),
            edge=np.concatenate([part.edge for part in parts])[order],
            enter=np.concatenate([part.enter for part in parts])[order],
            leave=np.concatenate([part.leave for part in parts])[order],
        )

    def vertices(self, roadmap: Roadmap, start: Int32) -> Int32:
        """Vertices i4[m+n]: for each robot its `start` i4[n], then the vertex at the end of each segment."""
        rows = np.arange(len(self.edge)) + self.robot + 1
        edge: Int32 = np.full(len(self.edge) + len(self), -1, np.int32)
        edge[rows] = self.edge
        vertex: Int32 = np.where(edge >= 0, roadmap.edges[edge, 1], -1) if len(roadmap.edges) else edge.copy()
        begins = self.first[:-1] + np.arange(len(self))
        vertex[begins] = start
        known = np.zeros(len(vertex), np.int64)
        known[begins], known[edge >= 0] = begins, np.flatnonzero(edge >= 0)
        return vertex[np.maximum.accumulate(known)].astype(np.int32)


def waits(enter: Int, leave: Int | int) -> Paths:
    """Paths that wait from `enter` i8[n] until `leave`, or that are empty where this is not later."""
    some = enter < leave
    first = np.concatenate([[0], np.cumsum(some)])
    ends = np.broadcast_to(leave, enter.shape)[some]
    return Paths(first=first, edge=np.full(len(ends), -1), enter=enter[some], leave=ends)


def flat(paths: Sequence[RobotPath]) -> Sequence[RobotPath]:
    """Join paths into `Paths`. What does not fit together stays as it is, so that checks can say what is wrong."""
    if type(paths) is Paths or not isinstance(paths, tuple | list):
        return paths
    sound = all(
        type(path) is RobotPath and path.edge.ndim == 1 and path.edge.shape == path.enter.shape == path.leave.shape
        for path in paths
    )
    return Paths.of(paths) if sound else paths


@attrs.frozen(kw_only=True)
class Plan:
    """One path per robot (the paper's *schedule*)."""

    paths: Sequence[RobotPath] = attrs.field(converter=flat)
    """n paths, held as `Paths`."""

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
