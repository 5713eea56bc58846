"""When robots arrive: the only definition, for statuses and metrics alike.

A robot completes its path at the first sample at which it has completed the last move of the path; waits after that
move do not count, because every new plan adds some to the paths of robots that have arrived. It arrives at the first
sample from then on at which it rests at its goal, if it stays there to the end of the execution, rests then, and has
come by its earlier goals in their order. Where these are and where the robot is, true poses say, not the navigator.
"""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int16, Int32
from mrpbench_core.model.execution.route import Route, last_moves
from mrpbench_core.model.planning.problem import GoalSet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.runs.run import FinishedRun, RunContext

REST = np.array([0.05, 0.2])
"""m/s and rad/s below which a robot is at rest."""
OWN = frozenset({"truth", "level", "mode"})
"""Channels that every execution of mrpbench records. Of other fleets, only the completed path is known."""


def arrival_times(run: FinishedRun) -> Float:
    """Simulated seconds f8[n] at which each robot arrived, NaN = it did not."""
    time, reached = run.channel("time"), run.channel("reached")
    arrival = completion_times(time, reached, run.context.routes)
    if not len(time) or not all(run.has(name) for name in OWN):
        return arrival
    context, truth, level = run.first_context(), run.channel("truth"), run.channel("level")
    near = is_at_goal(context, truth[..., :2], level)
    there = near[::-1].cumprod(axis=0)[::-1].astype(bool)  # and does not leave again
    if run.has("command"):  # without physics robots stop at once
        resting = (np.abs(run.channel("truth_twist")) < REST).all(axis=2)
        there &= resting & resting[-1]
    there &= time[:, None] >= arrival
    passed = has_passed_goals(context, truth[..., :2], level)
    return np.where(there.any(axis=0) & passed, time[there.argmax(axis=0)], np.nan)


def completion_times(time: Float, reached: Int32, routes: Sequence[Route]) -> Float:
    """Time f8[n] of the first sample at which each robot has completed the last move of its path; NaN = never."""
    done = reached >= last_moves(routes)
    return np.where(done.any(axis=0), time[done.argmax(axis=0)], np.nan)


def is_at_goal(context: RunContext, place: Float, level: Int16) -> Bool:
    """Tell whether robots are within the tolerance of their last goals.

    Args:
        context: gives the goals.
        place: f8[T,n,2] metres.
        level: i2[T,n].

    Returns:
        bool[T,n].
    """
    there = np.ones(place.shape[:2], bool)
    for robot, goal in enumerate(last_goals(context)):
        away = _distances(context.problem.roadmap, goal, place[:, robot], level[:, robot])
        there[:, robot] = away <= context.goal_tolerance
    return there


def last_goals(context: RunContext) -> list[GoalSet]:
    """The last goal of each robot, of which it may choose; where the planner assigns tasks, the end of its path."""
    problem, plan = context.problem, context.result.plan
    if context.planner_assigns and plan is not None:
        starts = problem.start.tolist()
        return [(path.end(problem.roadmap, start),) for path, start in zip(plan.paths, starts, strict=True)]
    return [sequence[-1] if sequence else () for sequence in problem.goals]


def has_passed_goals(context: RunContext, place: Float, level: Int16) -> Bool:
    """Tell bool[n] whether robots came by all goals before their last one, in order, on straight lines between samples.

    Args:
        context: gives the goals.
        place: f8[T,n,2] metres.
        level: i2[T,n].
    """
    passed = np.ones(len(context.problem), bool)
    for robot, sequence in enumerate(context.problem.goals):
        at = 0
        for goal in sequence[:-1]:
            near = _near_line(context, goal, place[at:, robot], level[at:, robot])
            if not near.any():
                passed[robot] = False
                break
            at += int(near.argmax())
    return passed


def _near_line(context: RunContext, goal: GoalSet, place: Float, level: Int16) -> Bool:
    """bool[T]: the robot comes within the tolerance of the goal between a sample and the next."""
    roadmap, vertices = context.problem.roadmap, np.array(goal)
    span = np.diff(place, axis=0, append=place[-1:])
    offset = roadmap.position[vertices][None] - place[:, None]
    length = np.maximum((span**2).sum(axis=1), 1e-18)[:, None]
    along = np.clip((offset * span[:, None]).sum(axis=2) / length, 0.0, 1.0)
    gap = np.hypot(*np.moveaxis(offset - along[..., None] * span[:, None], -1, 0))
    near: Bool = ((gap <= context.goal_tolerance) & (level[:, None] == roadmap.level[vertices])).any(axis=1)
    return near


def _distances(roadmap: Roadmap, goal: GoalSet, place: Float, level: Int16) -> Float:
    """Metres f8[T] to the nearest vertex of a goal, inf if it has none on the level; 0 if any vertex will do."""
    vertices: Int = np.array(goal, np.int64)
    nearest = np.full(len(place), np.inf)
    if len(vertices) in (0, len(roadmap.position)):
        return np.zeros(len(place))
    for vertex in vertices.tolist():
        away = np.hypot(*(place - roadmap.position[vertex]).T)
        np.minimum(nearest, np.where(level == roadmap.level[vertex], away, np.inf), out=nearest)
    return nearest
