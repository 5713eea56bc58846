"""Validates each path of a plan against its problem; all paths together, because fleets plan every second."""

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Int
from mrpbench_core.model.planning.plan import Paths, RobotPath
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.visits import visited_goals

LATEST = 2**40
"""The last tick of a path, so that sums of ticks have 64 bits."""
Faults = Iterator[tuple[int, str]]
"""Robots and what is wrong with their paths; of a robot the first counts."""


class Segments(NamedTuple):
    """The segments of paths, one path after another; all i8[k]."""

    robot: Int
    segment: Int
    """Index in the robot's path."""
    edge: Int
    enter: Int
    leave: Int

    def where(self, chosen: Bool) -> "Segments":
        """Some of them."""
        at = chosen.nonzero()[0]  # indices are taken in a fraction of the time of a mask
        return Segments(*(column.take(at) for column in self))

    @property
    def follows(self) -> Bool:
        """bool[k-1]: the one after it is of the same robot."""
        same: Bool = self.robot[1:] == self.robot[:-1]
        return same

    @property
    def first(self) -> Bool:
        """bool[k]: the first one of its robot."""
        return np.append(True, ~self.follows)[: len(self.robot)]


def segments_of(paths: Sequence[RobotPath]) -> Segments:
    """List the segments of paths that have as many edges as times."""
    joined = Paths.of(paths)
    return Segments(joined.robot, joined.segment, joined.edge.astype(np.int64), joined.enter, joined.leave)


def path_faults(problem: Problem, paths: Sequence[RobotPath]) -> dict[int, str]:
    """Return the first fault of each path that has one, by robot."""
    faults: dict[int, str] = {}
    if not isinstance(paths, Paths):
        ragged = [robot for robot, it in enumerate(paths) if not len(it.edge) == len(it.enter) == len(it.leave)]
        faults = dict.fromkeys(ragged, "edge, enter and leave differ in length")
        nothing = RobotPath(edge=np.empty(0, "i4"), enter=np.empty(0, "i8"), leave=np.empty(0, "i8"))
        paths = [nothing if robot in faults else path for robot, path in enumerate(paths)]
    segments = segments_of(paths)
    rules: tuple[Callable[[Problem, Segments], Faults], ...] = (
        _of_edges,
        _of_times,
        _of_moves,
        _of_commitments,
        _of_goals,
    )
    for rule in rules:
        for robot, fault in rule(problem, segments):
            faults.setdefault(robot, fault)
        if faults:  # what a rule relies on holds for the other robots
            segments = segments.where(~np.isin(segments.robot, list(faults)))
    return dict(sorted(faults.items()))


def _of_edges(problem: Problem, segments: Segments) -> Faults:
    unknown = (segments.edge < -1) | (segments.edge >= len(problem.roadmap.edges))
    for robot in segments.robot[unknown].tolist():
        yield robot, "uses an edge that does not exist"


def _of_times(problem: Problem, segments: Segments) -> Faults:
    robots, index, _, enter, leave = segments
    begin = problem.begins[robots]
    for row in np.flatnonzero(segments.first & (enter != begin)).tolist():
        yield int(robots[row]), f"begins at tick {enter[row]} instead of {begin[row]}"
    for row in np.flatnonzero(segments.follows & (enter[1:] != leave[:-1])).tolist():
        yield int(robots[row]), f"segment {index[row] + 1} does not begin when segment {index[row]} ends"
    for row in np.flatnonzero(leave < enter).tolist():
        yield int(robots[row]), f"segment {index[row]} ends before it begins"
    for row in np.flatnonzero(leave > LATEST).tolist():
        yield int(robots[row]), f"segment {index[row]} ends at tick {leave[row]}, later than {LATEST}"


def _of_moves(problem: Problem, segments: Segments) -> Faults:
    moves = segments.where(segments.edge >= 0)
    robots, index, edge, enter, leave = moves
    tail, head = problem.roadmap.edges.take(edge, axis=0).T
    duration = problem.roadmap.duration[problem.profile[robots], edge]
    committed = problem.committed[robots]  # to what may be forbidden since then
    for row in np.flatnonzero((duration < 0) & (index >= committed)).tolist():
        yield int(robots[row]), f"uses edge {edge[row]}, which its motion profile forbids"
    for row in np.flatnonzero(moves.first & (tail != problem.start[robots])).tolist():
        yield int(robots[row]), f"starts at vertex {tail[row]} instead of {problem.start[robots[row]]}"
    for row in np.flatnonzero(moves.follows & (tail[1:] != head[:-1])).tolist():
        yield int(robots[row]), f"jumps to another vertex at segment {index[row + 1]}"
    for row in np.flatnonzero(leave - enter < duration).tolist():
        yield int(robots[row]), f"segment {index[row]} is shorter than the duration of its edge"
    ready = problem.ready[robots]
    for row in np.flatnonzero(moves.first & (enter < ready)).tolist():
        yield int(robots[row]), f"moves at tick {enter[row]}, before it is ready at {ready[row]}"


def _of_commitments(problem: Problem, segments: Segments) -> Faults:
    wanted = segments_of(problem.commitments)
    first = np.searchsorted(segments.robot, np.arange(len(problem) + 1))
    place = first[wanted.robot] + wanted.segment
    fulfilled = place < first[wanted.robot + 1]
    for column in ("edge", "enter", "leave"):
        planned = np.append(getattr(segments, column), -2)[np.where(fulfilled, place, -1)]
        fulfilled &= planned == getattr(wanted, column)
    size = problem.committed
    for robot in np.unique(wanted.robot[~fulfilled]).tolist():
        yield robot, f"does not begin with its committed {size[robot]} segments"


def _of_goals(problem: Problem, segments: Segments) -> Faults:
    if problem.horizon is not None:
        return
    moves = segments.where(segments.edge >= 0)
    end = problem.start.astype(np.int64)
    head = problem.roadmap.edges[moves.edge].reshape(-1, 2)[:, 1]
    end[moves.robot] = head  # of equal robots the last one counts
    visited = visited_goals(problem, moves.robot, head)
    for robot, (sequence, vertex) in enumerate(zip(problem.goals, end.tolist(), strict=True)):
        if sequence and vertex not in sequence[-1]:
            yield robot, f"ends at vertex {vertex} instead of its goal {' or '.join(map(str, sequence[-1]))}"
        elif visited.get(robot, len(sequence)) < len(sequence):
            yield robot, f"does not visit goal {visited[robot]} of its sequence in order"
