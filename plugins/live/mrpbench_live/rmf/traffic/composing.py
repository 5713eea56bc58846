"""What a plan says to each robot, and who can keep the plan that it has."""

from collections.abc import Collection, Mapping, Sequence

import attrs
import numpy as np

from mrpbench_core.api import Int, Plan, Problem
from mrpbench_live.rmf.traffic.posting import Blockers, Posted, Waypoints, blockers_of, waypoints_of


@attrs.frozen
class Composed:
    """What a plan says."""

    waypoints: Sequence[Waypoints]
    blockers: Sequence[Blockers]
    kept: Collection[int]
    """Robots to which their last plan says the same; its waypoints count for them, also those that are over."""


def compose(
    problem: Problem, plan: Plan, reached: Int, released: Int, before: Int, posted: Mapping[int, Posted]
) -> Composed:
    """Return what a plan says to each robot.

    A robot keeps its plan if its way is the same, and all that it waits for on it, by plans that are kept as well.

    Args:
        problem: that the plan solves.
        plan: of all robots.
        reached: i8[n] leading segments that are over.
        released: i8[n] leading segments that are released.
        before: i8[n] what is `reached`, as segments of the plan before.
        posted: what was posted of that plan, to robots that may keep it.

    Raises:
        DispatchError: outside robots cannot follow it, see `blockers_of`.
    """
    waypoints = waypoints_of(problem, plan, reached)
    blockers = blockers_of(problem, plan, waypoints, reached, released)
    begun = {robot: it.waypoints.last(int(before[robot])) for robot, it in posted.items()}
    kept = set()
    for robot, it in posted.items():
        begin, own = begun[robot], waypoints[robot]
        if np.array_equal(it.waypoints.vertex[begin:], own.vertex):
            known = _left(it.blockers, begin, begin + own.last(int(released[robot])), begun)
            if known == blockers[robot]:
                kept.add(robot)
    waits_for = {
        robot: {other for at, others in posted[robot].blockers.items() if at >= begun[robot] for other in others}
        for robot in kept
    }
    while others := {robot for robot in kept if not waits_for[robot] <= kept}:
        kept -= others
    return Composed(
        waypoints=[
            _joined(posted[robot].waypoints, begun[robot], own) if robot in kept else own
            for robot, own in enumerate(waypoints)
        ],
        blockers=[
            posted[robot].blockers if robot in kept else _counted(own, kept, begun)
            for robot, own in enumerate(blockers)
        ],
        kept=kept,
    )


def _left(blockers: Blockers, begin: int, allowed: int, begun: Mapping[int, int]) -> Blockers:
    """Return what a robot still waits for from where it may drive to, all counted from where robots are."""
    left = {
        at - begin: {other: until - begun[other] for other, until in others.items() if until > begun.get(other, until)}
        for at, others in blockers.items()
        if at >= allowed
    }
    return {at: others for at, others in left.items() if others}


def _joined(posted: Waypoints, begin: int, own: Waypoints) -> Waypoints:
    """Return the waypoints of a plan that is kept, by the segments of the new one."""
    return Waypoints(np.concatenate([np.full(begin, own.segments[0]), own.segments]), posted.vertex)


def _counted(blockers: Blockers, kept: Collection[int], begun: Mapping[int, int]) -> Blockers:
    """Return blockers, which are counted from where robots are, by the plans that these have."""
    return {
        at: {other: until + (begun[other] if other in kept else 0) for other, until in others.items()}
        for at, others in blockers.items()
    }
