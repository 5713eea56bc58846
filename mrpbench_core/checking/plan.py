"""Validates a plan against its problem, without code of planners or dispatchers."""

import attrs
import numpy as np

from mrpbench_core.checking.conflicts import Conflict, find_conflicts
from mrpbench_core.model.planning.plan import Path, Plan
from mrpbench_core.model.planning.problem import Problem


@attrs.frozen(kw_only=True)
class PlanReport:
    """The faults of a plan."""

    faults: tuple[str, ...] = ()
    """Reasons why paths are not valid for this problem, one sentence each."""
    conflicts: tuple[Conflict, ...] = ()
    """Conflicts between robots; not searched for, so empty, if there are faults."""

    @property
    def valid(self) -> bool:
        """True if there are neither faults nor conflicts."""
        return not self.faults and not self.conflicts


def check_plan(problem: Problem, plan: Plan, conflict_limit: int | None = None) -> PlanReport:
    """Check every path and, if none has a fault, every pair of robots.

    All rules of `mrpbench_core.model.planning.conflicts` are checked, resources included. A turn is a move between
    vertices at one place, so that headings need no rule of their own.

    Args:
        problem: what was planned.
        plan: what to check.
        conflict_limit: the number of conflicts to report, the earliest first; None = all.
    """
    if len(plan.paths) != len(problem):
        return PlanReport(faults=(f"{len(plan.paths)} paths for {len(problem)} robots",))
    faults = [
        f"robot {robot}: {fault}"
        for robot, path in enumerate(plan.paths)
        if (fault := path_fault(problem, robot, path)) is not None
    ]
    if faults:
        return PlanReport(faults=tuple(faults))
    return PlanReport(conflicts=tuple(find_conflicts(problem, plan, conflict_limit)))


def path_fault(problem: Problem, robot: int, path: Path) -> str | None:
    """The first fault of one path, or None."""
    if not len(path.edge) == len(path.enter) == len(path.leave):
        return "edge, enter and leave differ in length"
    if ((path.edge < -1) | (path.edge >= len(problem.roadmap.edges))).any():
        return "uses an edge that does not exist"
    if len(path) and path.enter[0] != problem.begin(robot):
        return f"begins at tick {path.enter[0]} instead of {problem.begin(robot)}"
    if (path.enter[1:] != path.leave[:-1]).any():
        segment = int(np.flatnonzero(path.enter[1:] != path.leave[:-1])[0])
        return f"segment {segment + 1} does not begin when segment {segment} ends"
    if (path.leave < path.enter).any():
        return f"segment {int(np.flatnonzero(path.leave < path.enter)[0])} ends before it begins"
    return _move_fault(problem, robot, path) or _goal_fault(
        problem, robot, path.vertices(problem.roadmap, int(problem.start[robot]))
    )


def _move_fault(problem: Problem, robot: int, path: Path) -> str | None:
    moves = np.flatnonzero(path.edge >= 0)
    edges = path.edge[moves]
    ends = problem.roadmap.edges[edges]
    duration = problem.duration(robot)[edges]
    committed = len(problem.commitments[robot]) if problem.commitments else 0  # to what may be forbidden since then
    forbidden = (duration < 0) & (moves >= committed)
    if forbidden.any():
        return f"uses edge {edges[forbidden][0]}, which its motion profile forbids"
    if len(moves) and ends[0, 0] != problem.start[robot]:
        return f"starts at vertex {ends[0, 0]} instead of {problem.start[robot]}"
    if (ends[1:, 0] != ends[:-1, 1]).any():
        segment = int(moves[1:][ends[1:, 0] != ends[:-1, 1]][0])
        return f"jumps to another vertex at segment {segment}"
    hasty = path.leave[moves] - path.enter[moves] < duration
    if hasty.any():
        return f"segment {int(moves[hasty][0])} is shorter than the duration of its edge"
    if len(moves) and path.enter[moves[0]] < problem.ready[robot]:
        return f"moves at tick {path.enter[moves[0]]}, before it is ready at {problem.ready[robot]}"
    if problem.commitments:
        prefix = problem.commitments[robot]
        size = len(prefix)
        for name in ("edge", "enter", "leave"):
            if not np.array_equal(getattr(path, name)[:size], getattr(prefix, name)):
                return f"does not begin with its committed {size} segments"
    return None


def _goal_fault(problem: Problem, robot: int, vertices: np.ndarray) -> str | None:
    sequence = problem.goals[robot]
    if not sequence or problem.horizon is not None:
        return None
    if vertices[-1] not in sequence[-1]:
        return f"ends at vertex {vertices[-1]} instead of its goal {' or '.join(map(str, sequence[-1]))}"
    position = 0
    for vertex in vertices:
        while position < len(sequence) and vertex in sequence[position]:  # one visit counts for equal goals in a row
            position += 1
    return None if position == len(sequence) else f"does not visit goal {position} of its sequence in order"
