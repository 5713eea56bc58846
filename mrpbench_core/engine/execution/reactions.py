"""New plans around faults: what a planner may not use, and where robots go that cannot reach their goals."""

from itertools import pairwise

import attrs
import numpy as np

from mrpbench_core.checking.reachability import round_trips
from mrpbench_core.engine.execution.destinations import Destinations, heads
from mrpbench_core.engine.execution.faults import FaultEvent, FaultState, approaches
from mrpbench_core.engine.travel import travel_ticks
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Goals, GoalSet, Problem
from mrpbench_core.model.planning.roadmap import Resource, Roadmap
from mrpbench_core.model.planning.type2_edges import moves_of

SPACING = 0.1
"""Metres between the points that stand for the way of a robot that may be anywhere on it."""
RETRY_S = 1.0
"""Simulated seconds after which a plan around faults is asked for again; doubled each time that none is found."""


class Reactions:
    """Asks for plans around faults, unless the fleet is to wait.

    Args:
        faults: of the execution.
        robots: their number.
        yaw: f8[n] radians wanted at the goals, NaN = any.
        sets: the planner takes sets of goals, so that robots that cannot reach theirs may make room.
    """

    def __init__(self, faults: FaultState, robots: int, yaw: Float, sets: bool) -> None:
        self._faults, self._yaw, self._sets = faults, yaw, sets
        self._replans = bool(faults) and faults.settings.reaction != "wait"
        self._gives_up = self._replans and faults.settings.reaction == "give_up"
        self._led_around: tuple[FaultEvent, ...] = ()
        self._not_before, self._wait = 0.0, RETRY_S
        self._none: Bool = np.zeros(robots, bool)
        self.given_up: Bool = np.zeros(robots, bool)
        """bool[n]: the task of the robot is given up."""
        self.astray: Bool = np.zeros(robots, bool)
        """bool[n]: the path of the robot does not lead to its goal."""
        self.cut_off: Bool = np.zeros(robots, bool)
        """bool[n]: no way is left from the robot to its goal."""
        self._asked: tuple[Bool, Bool, tuple[FaultEvent, ...]] = (self.astray, self.cut_off, ())

    @property
    def held(self) -> Bool:
        """The robots bool[n] that others go around: those that stand or are silent."""
        return self._faults.stopped | self._faults.silent if self._replans else self._none

    def update(self) -> Bool:
        """Return the robots bool[n] whose tasks are given up from now on."""
        if not self._gives_up:
            return self._none
        new: Bool = self._faults.stopped & ~self.given_up
        self.given_up = self.given_up | new
        return new

    def reason(self, now: float) -> str | None:
        """Return why a new plan is needed, or None."""
        obstacles = self._obstacles()
        if obstacles == self._led_around or now < self._not_before:
            return None
        begun = [event for event in obstacles if event not in self._led_around]
        event, over = (begun[0], "") if begun else (next(e for e in self._led_around if e not in obstacles), " no more")
        return f"{'' if event.robot < 0 else f'robot {event.robot} '}{event.what}{over}"

    def restricted(self, problem: Problem, plan: Plan, released: Int32, cleared: Int32) -> Problem:
        """Return the problem without the edges that lead closer to what is in the way than robots fit.

        A robot that stands, or of which nothing is known, may be anywhere on what was released to it.
        """
        if not self._obstacles():
            return problem
        roadmap, held = problem.roadmap, self.held
        tail, head = (roadmap.position[roadmap.edges[:, end]] for end in (0, 1))
        level = roadmap.level[roadmap.edges[:, 0]]
        duration = roadmap.duration.copy()
        for profile in np.unique(problem.profile).tolist():
            radius = float(problem.radius[problem.profile == profile].max())
            closed = np.zeros(len(roadmap.edges), bool)
            for event in self._faults.blockages:
                reach = np.full(len(tail), radius + event.radius)
                closed |= (level == event.level) & approaches(np.array(event.place), tail, head, reach)
            for robot in np.flatnonzero(held).tolist():
                vertices = plan.paths[robot].vertices(roadmap, int(problem.start[robot]))
                here = vertices[int(cleared[robot]) : int(released[robot]) + 1]
                reach = np.full(len(tail), radius + problem.radius[robot])
                for place in _points(roadmap.position[here]):
                    closed |= (level == roadmap.level[here[-1]]) & approaches(place, tail, head, reach)
            for resource in roadmap.resources:
                if resource.name in self._faults.broken:
                    closed |= _inward(roadmap, resource)
            duration[profile, closed] = -1
        return attrs.evolve(problem, roadmap=attrs.evolve(roadmap, duration=duration))

    def destinations(self, problem: Problem, plan: Plan, released: Int32, goals_left: Goals) -> Destinations:
        """Return goals for the robots of one batch in a `restricted` problem, given what is left of theirs.

        A robot that stands or is silent away from its goal, or whose task is given up, stays where it comes to rest. So
        does one that cannot reach its goal, but it may make room if the planner takes sets of goals.
        """
        nothing = ((),) * len(problem)
        if not self._replans:
            return Destinations(goals=goals_left, yaw=self._yaw, errands=nothing)
        head = heads(problem, moves_of(problem, plan), released)
        at_goal = [all(here in goal for goal in goals) for here, goals in zip(head.tolist(), goals_left, strict=True)]
        stays = (self.held & ~np.array(at_goal)) | self.given_up
        cut_off = np.zeros(len(problem), bool)
        goals: list[tuple[GoalSet, ...]] = []
        for robot, sequence in enumerate(goals_left):
            here = int(head[robot])
            if stays[robot]:
                goals.append(((here,),))
            elif all(reaches(problem, robot, here, goal) for goal in sequence):
                goals.append(sequence)
            else:
                cut_off[robot] = True
                goals.append((self._room(problem, robot, here),))
        astray = stays | cut_off
        self._asked = astray, cut_off, self._obstacles()
        yaw = np.where(astray, np.nan, self._yaw)
        return Destinations(goals=tuple(goals), yaw=yaw, errands=nothing)

    def asked(self) -> None:
        """Note that a plan around the active faults was asked for."""
        self._asked = (self.astray, self.cut_off, self._obstacles())

    def adopt(self) -> None:
        """Note that the plan asked for last is executed now."""
        self.astray, self.cut_off, self._led_around = self._asked
        self._not_before, self._wait = 0.0, RETRY_S

    def failed(self, now: float) -> None:
        """Note that the plan asked for last does not take effect."""
        self._not_before, self._wait = now + self._wait, 2 * self._wait

    def _obstacles(self) -> tuple[FaultEvent, ...]:
        return self._faults.obstacles if self._replans else ()

    def _room(self, problem: Problem, robot: int, here: int) -> GoalSet:
        if not self._sets:
            return (here,)
        label = round_trips(problem.roadmap, int(problem.profile[robot]))
        return tuple(np.flatnonzero(label == label[here]).tolist())


def reaches(problem: Problem, robot: int, start: int, goal: GoalSet) -> bool:
    """Tell whether a robot alone can drive from a vertex to one of several."""
    if start in goal:
        return True
    ticks = travel_ticks(problem.roadmap, int(problem.profile[robot]), goal, [start])
    return bool(np.isfinite(ticks).any())


def _points(way: Float) -> list[Float]:
    """Points f8[2] along a way f8[k,2], at most `SPACING` apart."""
    points = [way[0]]
    for begin, end in pairwise(way):
        steps = max(1, int(np.ceil(np.hypot(*(end - begin)) / SPACING)))
        points += [begin + (end - begin) * step / steps for step in range(1, steps + 1)]
    return points


def _inward(roadmap: Roadmap, resource: Resource) -> Bool:
    """The edges bool[E] of a door or lift but for those that lead out of it."""
    inside: Int = np.array(resource.vertices, np.int64)
    inward = np.zeros(len(roadmap.edges), bool)
    edges = np.array(resource.edges, np.int64)
    leaves = np.isin(roadmap.edges[edges, 0], inside) & ~np.isin(roadmap.edges[edges, 1], inside)
    inward[edges[~leaves]] = True
    inward[list(resource.passage)] = True
    return inward
