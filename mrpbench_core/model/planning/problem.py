"""The problem of a planner: robots on a roadmap, with goals and rules."""

from collections.abc import Sequence
from enum import StrEnum
from itertools import chain

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float, Int, Int32, array
from mrpbench_core.model.planning.plan import Paths, RobotPath, flat
from mrpbench_core.model.planning.roadmap import Roadmap

GoalSet = tuple[int, ...]
"""Roadmap vertices; a robot reaches the set by reaching any of them."""
Goals = tuple[tuple[GoalSet, ...], ...]
"""For each robot the goal sets to visit in order."""


class Feature(StrEnum):
    """A property that problems may have and planners may support."""

    EDGE_DURATIONS = "edge_durations"
    """The duration of some edge is not one tick."""
    FOOTPRINTS = "footprints"
    """Robots are discs of `Problem.radius`: elements of the roadmap closer than two radii exclude one another."""
    RESOURCES = "resources"
    PROFILES = "profiles"
    """More than one motion profile."""
    HEADINGS = "headings"
    """Some vertices prescribe a yaw. A move that turns on the spot is an edge between vertices at one place."""
    GOAL_SETS = "goal_sets"
    GOAL_SEQUENCES = "goal_sequences"
    """Some robot has several goals, which it visits in order, or none."""
    SHARED_GOALS = "shared_goals"
    """Robots have the same goal, where not all of them can be at the same time. Only with a horizon."""
    COMMITMENTS = "commitments"
    SINCE = "since"
    """Some path begins after tick 0, because what its robot drove before is left out."""
    HORIZON = "horizon"
    FOLLOWING_FORBIDDEN = "following_forbidden"


@attrs.frozen(kw_only=True)
class Rules:
    """Conventions of the field that differ between publications."""

    following: str = "allowed"
    """allowed | forbidden: may a robot enter a vertex in the tick in which another leaves it?"""
    at_goal: str = "stay"
    """stay | disappear."""
    k: int = 0
    """Ticks: no conflict although each robot is up to this late anywhere. Planners set it from their option `k`."""


@attrs.frozen(kw_only=True)
class Problem:
    """Everything a planner sees. See `mrpbench_core.model.planning.conflicts` for what counts as a conflict."""

    roadmap: Roadmap
    profile: Int32 = array("i4")
    """i4[n]: row of `Roadmap.duration` for each robot."""
    radius: Float = array("f8")
    """f8[n] metres."""
    start: Int32 = array("i4")
    """i4[n] roadmap vertices."""
    ready: Int = array("i8")
    """i8[n] ticks: a robot stays at its start at least until then."""
    since: Int = array("i8", factory=lambda: np.zeros(0, np.int64))
    """i8[n] ticks, also below 0: the path of a robot begins then, and it occupies nothing before; empty: all at 0."""
    goals: Goals
    """goals[robot] = the goal sets to visit in order; the robot ends at the last. Empty: it may end anywhere."""
    commitments: Sequence[RobotPath] = attrs.field(default=(), converter=flat)
    """Released prefixes, one per robot (possibly empty), with which a new plan must begin; () = none."""
    remaining: Sequence[RobotPath] = attrs.field(default=(), converter=flat)
    """What follows the commitments in the current plan, one per robot, where the planner `reads_remaining`; () = none.
    Commitments, each continued by it, are a plan without conflicts. Nothing has to be kept of it."""
    rules: Rules = Rules()
    horizon: int | None = None
    """Tick from which on paths may end anywhere, where their robots then stay; None = paths lead to the goals."""
    features: frozenset[Feature] = frozenset()

    def __len__(self) -> int:
        return len(self.start)

    def begin(self, robot: int) -> int:
        """Return the tick at which the path of `robot` begins."""
        return int(self.since[robot]) if len(self.since) else 0

    @property
    def begins(self) -> Int:
        """Ticks i8[n] at which the paths of the robots begin."""
        return self.since if len(self.since) else np.zeros(len(self), np.int64)

    @property
    def committed(self) -> Int:
        """Number i8[n] of leading segments to which each robot is committed."""
        return Paths.of(self.commitments).size if self.commitments else np.zeros(len(self), np.int64)

    def duration(self, robot: int) -> Int32:
        """Return the duration i4[E] of each edge for `robot`, in ticks, -1 = forbidden."""
        row: Int32 = self.roadmap.duration[self.profile[robot]]
        return row


def ends_of(problem: Problem) -> list[int]:
    """Return the tick at which the commitments of each robot end; where its path begins if it has none."""
    paths = Paths.of(problem.commitments)
    last = np.append(paths.leave, 0)[paths.first[1:] - 1]
    ends: list[int] = np.where(paths.size > 0, last, problem.begins[: len(paths)]).tolist()
    return ends


def features_of(problem: Problem) -> frozenset[Feature]:
    """Return the features that a planner needs to solve `problem`; the caller adds footprints."""
    features = set()
    used = problem.roadmap.duration
    if ((used != 1) & (used != -1)).any():
        features.add(Feature.EDGE_DURATIONS)
    if len(np.unique(problem.profile)) > 1 and not (used == used[:1]).all():
        features.add(Feature.PROFILES)
    if problem.roadmap.resources:
        features.add(Feature.RESOURCES)
    if not np.isnan(problem.roadmap.heading).all():
        features.add(Feature.HEADINGS)
    if set(map(len, chain.from_iterable(problem.goals))) - {1}:
        features.add(Feature.GOAL_SETS)
    if set(map(len, problem.goals)) - {1}:
        features.add(Feature.GOAL_SEQUENCES)
    last = [sequence[-1] for sequence in problem.goals if sequence and len(sequence[-1]) == 1]
    if problem.horizon is not None and len(set(last)) < len(last):
        features.add(Feature.SHARED_GOALS)
    if problem.committed.any() or problem.ready.any():
        features.add(Feature.COMMITMENTS)
    if problem.since.any():
        features.add(Feature.SINCE)
    if problem.horizon is not None:
        features.add(Feature.HORIZON)
    if problem.rules.following == "forbidden":
        features.add(Feature.FOLLOWING_FORBIDDEN)
    return frozenset(features)
