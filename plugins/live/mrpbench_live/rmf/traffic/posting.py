"""Plans as messages: waypoints for the segments of paths, blockers for the order of a plan."""

from collections.abc import Mapping, Sequence
from typing import Any

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


@attrs.frozen
class Posted:
    """A plan that a robot was sent."""

    key: PlanKey
    plan_id: Any
    waypoints: Waypoints


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
) -> dict[tuple[int, int], dict[int, int]]:
    """Return the waypoint that each other robot must have reached before one departs: by (robot, waypoint), by robot.

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
    found: dict[tuple[int, int], dict[int, int]] = {}
    for before, after, completed in zip(*(column.tolist() for column in order), strict=True):
        robot, segment = int(moves.robot[after]), int(moves.segment[after])
        other, passed = int(moves.robot[before]), int(moves.segment[before]) + 1
        if segment < max(reached[robot], released[robot]):
            continue
        required = int(np.searchsorted(waypoints[other].segments, passed))
        if not completed:
            required = _clear(problem, waypoints[other], required, int(moves.tail[before]), robot, other)
        if required > 0:
            blockers = found.setdefault((robot, waypoints[robot].last(segment)), {})
            blockers[other] = max(blockers.get(other, 0), required)
    return found


def _clear(problem: Problem, way: Waypoints, first: int, vertex: int, robot: int, other: int) -> int:
    """The first waypoint of `other`, from one on, at which `robot` fits at a vertex."""
    shift = problem.roadmap.position[way.vertex[first:]] - problem.roadmap.position[vertex]
    clear = np.hypot(shift[:, 0], shift[:, 1]) >= problem.radius[robot] + problem.radius[other] - SLACK
    clear |= problem.roadmap.level[way.vertex[first:]] != problem.roadmap.level[vertex]
    return first + (int(clear.argmax()) if clear.any() else len(clear) - 1)


def message_of(
    messages: Messages,
    problem: Problem,
    own: Posted,
    blockers: Mapping[int, Mapping[int, int]],
    posted: Mapping[int, Posted],
    names: Sequence[str],
    start: Any,
) -> Any:
    """Return the `Plan` of one robot; the progress of a waypoint is its index, as in the reference plan server.

    Args:
        messages: the types.
        problem: that the plan solves.
        own: plan of the robot.
        blockers: by waypoint, the waypoints that other robots must have reached.
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
            departure_blockers=[dependency(*it) for it in sorted(blockers.get(index, {}).items())],
        )
        for index, vertex in enumerate(own.waypoints.vertex.tolist())
    ]
    return messages.new(f"{package}/Plan", waypoints=found, start_time=start, plan_id=own.plan_id)
