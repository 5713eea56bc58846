"""Plans as messages: waypoints for the segments of paths, blockers for the order of a plan."""

from collections.abc import Mapping, Sequence
from typing import Any, Self

import attrs
import numpy as np

from mrpbench_core.api import DispatchError, Int, Paths, Plan, Problem
from mrpbench_core.dispatching.rotations import rotations
from mrpbench_core.model.planning.occupations import occupations_of, resource_edges
from mrpbench_core.model.planning.type2_edges import moves_of, type2_edges
from mrpbench_live.rmf.messages import Messages, PlanKey

SLACK = 1e-6
"""metres."""


@attrs.frozen(eq=False)
class Waypoints:
    """The waypoints of one robot: where it is, and the end of each move after that; waits have none."""

    segments: Int
    """i8[k]: leading segments of the path that are over when each is reached."""
    vertex: Int
    """i8[k]."""

    def last(self, segments: int) -> int:
        """Return the last waypoint that is reached when so many segments are over."""
        return max(0, int(np.searchsorted(self.segments, segments, side="right")) - 1)


Blockers = Mapping[int, Mapping[int, int]]
"""Of one robot: by waypoint, the waypoint that each other robot must have reached before it departs."""


@attrs.frozen
class Posted:
    """A plan that a robot was sent."""

    key: PlanKey
    plan_id: Any
    waypoints: Waypoints
    blockers: Blockers


def waypoints_of(problem: Problem, plan: Plan, reached: Int) -> list[Waypoints]:
    """Return the waypoints of each robot, from the `reached` i8[n] leading segments of its path on."""
    paths = Paths.of(plan.paths)
    vertices = paths.vertices(problem.roadmap, problem.start).astype(np.int64)
    found = []
    for robot, begin in enumerate(reached.tolist()):
        edges = paths.edge[paths.first[robot] : paths.first[robot + 1]]
        ends = np.flatnonzero(edges >= 0) + 1
        segments = np.concatenate([[begin], ends[ends > begin]])
        found.append(Waypoints(segments, vertices[paths.first[robot] + robot + segments]))
    return found


def blockers_of(
    problem: Problem, plan: Plan, waypoints: Sequence[Waypoints], reached: Int, released: Int
) -> Sequence[Blockers]:
    """Return the blockers of each robot.

    The order is that of the plan, as in the dispatcher `adg`. Where one robot only has to be out of the other's way,
    the first waypoint is required at which it surely is: the reference executor knows no progress between waypoints.

    Args:
        problem: that the plan solves.
        plan: in whose order robots pass.
        waypoints: of all robots.
        reached: i8[n] leading segments that are over.
        released: i8[n] leading segments that are released already, whose blockers have passed.

    Raises:
        DispatchError: robots rotate, which those that drive by themselves cannot do in step.
    """
    moves = moves_of(problem, plan)
    order = type2_edges(problem, moves, resource_edges(problem, occupations_of(problem, moves)))
    if cycle := rotations(problem, moves, order, 0.0):
        robots = sorted({int(moves.robot[move]) for move in cycle[0]})
        raise DispatchError(f"robots {', '.join(map(str, robots))} rotate, which outside robots cannot do in step")
    before, after, completed = order
    robot, segment, other = moves.robot[after], moves.segment[after], moves.robot[before]
    open_to = segment >= np.maximum(reached, released)[robot]
    robot, segment, other, before = (it[open_to] for it in (robot, segment, other, before))
    table = _Table.of(waypoints)
    required = table.first_after(other, moves.segment[before] + 1)
    _drive_clear(problem, table, required, np.flatnonzero(~completed[open_to]), moves.tail[before], robot, other)
    waypoint = np.maximum(table.first_after(robot, segment + 1) - 1, 0)
    rows = np.stack([robot, waypoint, other, required], axis=1)[required > 0]
    found: list[dict[int, dict[int, int]]] = [{} for _ in waypoints]
    for departs, at, waits_for, until in rows[np.lexsort(rows.T[::-1])].tolist():  # the greatest is the last
        found[departs].setdefault(at, {})[waits_for] = until
    return found


@attrs.frozen(eq=False)
class _Table:
    """The waypoints of all robots, one robot after another."""

    first: Int
    """i8[n+1]: those of robot i are the rows from `first[i]` to `first[i+1]`."""
    key: Int
    """i8[W], ascending: the robot times `stride`, and the segments that are over at the waypoint."""
    vertex: Int
    """i8[W]."""
    stride: int

    @classmethod
    def of(cls, waypoints: Sequence[Waypoints]) -> Self:
        """Join the waypoints of robots."""
        segments = np.concatenate([it.segments for it in waypoints])
        stride, sizes = int(segments.max()) + 2, [len(it.segments) for it in waypoints]
        return cls(
            first=np.concatenate([[0], np.cumsum(sizes)]),
            key=np.repeat(np.arange(len(waypoints)), sizes) * stride + segments,
            vertex=np.concatenate([it.vertex for it in waypoints]),
            stride=stride,
        )

    def first_after(self, robot: Int, segments: Int) -> Int:
        """The first waypoint i8[k] of each robot at which so many segments are over; their number if there is none."""
        row: Int = np.searchsorted(self.key, robot * self.stride + np.minimum(segments, self.stride - 1))
        return row - self.first[robot]


def _drive_clear(
    problem: Problem, table: _Table, required: Int, rows: Int, vertex: Int, robot: Int, other: Int
) -> None:
    """Raise required waypoints of some rows until `robot` fits at `vertex` while `other` is there, or to the last."""
    roadmap, radius = problem.roadmap, problem.radius
    last = table.first[other + 1] - table.first[other] - 1
    while len(rows := rows[required[rows] <= last[rows]]):
        there, here = table.vertex[table.first[other[rows]] + required[rows]], vertex[rows]
        shift = roadmap.position[there] - roadmap.position[here]
        fits = np.hypot(shift[:, 0], shift[:, 1]) >= radius[robot[rows]] + radius[other[rows]] - SLACK
        rows = rows[~(fits | (roadmap.level[there] != roadmap.level[here]))]
        required[rows] += 1
    np.minimum(required, last, out=required)


def message_of(
    messages: Messages,
    problem: Problem,
    own: Posted,
    posted: Mapping[int, Posted],
    names: Sequence[str],
    start: Any,
) -> Any:
    """Return the `Plan` of one robot; the progress of a waypoint is its index, as in the reference plan server.

    Args:
        messages: the types.
        problem: that the plan solves.
        own: plan of the robot.
        posted: the plans of all robots.
        names: of all robots.
        start: its time.
    """
    package = "rmf_prototype_msgs"

    def dependency(other: int, required: int) -> Any:
        return messages.new(
            f"{package}/TrafficDependency",
            name=names[other],
            plan_id=posted[other].plan_id,
            required_progress=float(required),
        )

    found = [
        messages.new(
            f"{package}/Waypoint",
            position=problem.roadmap.position[vertex].tolist(),
            progress=float(index),
            departure_blockers=[dependency(*it) for it in sorted(own.blockers.get(index, {}).items())],
        )
        for index, vertex in enumerate(own.waypoints.vertex.tolist())
    ]
    return messages.new(f"{package}/Plan", waypoints=found, start_time=start, plan_id=own.plan_id)
