"""Finds faults that make a scenario impossible for every planner, before one is called."""

from collections.abc import Iterator, Sequence

import numpy as np

from mrpbench_core.checking.reachability import reachable, round_trips
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.planning.conflicts import TOLERANCE
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_core.model.planning.roadmap import Roadmap


def check_scenario(problem: Problem, start_names: Sequence[str] = (), goal_names: Sequence[str] = ()) -> list[str]:
    """The faults of starts and goals, one sentence each, with the names of robots and places.

    Faults are: two robots that start on one vertex or (with the feature `footprints`) closer than the sum of their
    radii; the same for final goals where robots stay; places that are not on the roadmap (vertex -1); goals that a
    robot's motion profile cannot reach from its start in order.

    Args:
        problem: may hold -1 for a start or goal that is not on the roadmap.
        start_names: names of the robots' starts, in order; where missing or empty, coordinates are shown.
        goal_names: names of the robots' final goals, likewise.
    """
    starts, goals = _places(problem, start_names, goal_names)
    faults = [
        f"robot {robot} starts at {starts[robot]}, which is not on the roadmap"
        for robot in np.flatnonzero(problem.start < 0).tolist()
    ]
    faults += _too_close(problem, starts, "both start at", "start at")
    if problem.rules.at_goal == "stay":
        faults += _too_close(problem, goals, "share the goal", "have the goals")
    return [*faults, *_unreachable(problem, starts, goals)]


def check_reach(problem: Problem, start_names: Sequence[str] = (), goal_names: Sequence[str] = ()) -> list[str]:
    """The goals that robots cannot reach from their starts: a part of what `check_scenario` finds."""
    return list(_unreachable(problem, *_places(problem, start_names, goal_names)))


def check_travel(costs: Float, start_names: Sequence[str] = (), goal_names: Sequence[str] = ()) -> list[str]:
    """Robots and tasks that no assignment can serve, one sentence each.

    Robots that can reach no task count if there are at least as many tasks as robots, tasks that no robot can reach if
    there are at least as many robots as tasks.

    Args:
        costs: true travel times f8[n,m], inf = no way.
        start_names: see `check_scenario`.
        goal_names: names of the tasks' goals.
    """
    reach = np.isfinite(costs)
    robots, tasks = costs.shape
    idle = np.flatnonzero(~reach.any(axis=1)).tolist() if robots <= tasks else []
    left = np.flatnonzero(~reach.any(axis=0)).tolist() if tasks <= robots else []
    return [f"robot {robot} can reach no goal from its start{_called(start_names, robot)}" for robot in idle] + [
        f"no robot can reach the goal of task {task}{_called(goal_names, task)}" for task in left
    ]


def _places(problem: Problem, start_names: Sequence[str], goal_names: Sequence[str]) -> tuple["_Places", "_Places"]:
    final = np.array([_final(problem, robot) for robot in range(len(problem))], np.int64)
    starts = _Places(problem.roadmap, problem.start.astype(np.int64), start_names)
    return starts, _Places(problem.roadmap, final, goal_names)


def _called(names: Sequence[str], index: int) -> str:
    return f" {names[index]}" if index < len(names) and names[index] else ""


class _Places:
    """Names for the vertices of a list."""

    def __init__(self, roadmap: Roadmap, vertex: Int, names: Sequence[str]) -> None:
        self._roadmap, self.vertex, self._names = roadmap, vertex, names

    def __getitem__(self, index: int) -> str:
        if index < len(self._names) and self._names[index]:
            return self._names[index]
        vertex = self.vertex[index]
        if vertex < 0:
            return "a place"
        x, y = self._roadmap.position[vertex]
        return f"({x:.2f}, {y:.2f})"


def _final(problem: Problem, robot: int) -> int:
    """The vertex at which a robot must end, -1 if it may choose."""
    sequence = problem.goals[robot]
    return sequence[-1][0] if sequence and len(sequence[-1]) == 1 else -1


def _too_close(problem: Problem, places: _Places, same: str, near: str) -> Iterator[str]:
    """Pairs of robots on one vertex, or with overlapping discs."""
    known = np.flatnonzero(places.vertex >= 0)
    vertex = places.vertex[known]
    position, level = problem.roadmap.position[vertex], problem.roadmap.level[vertex]
    footprints = Feature.FOOTPRINTS in problem.features
    for index, robot in enumerate(known.tolist()):
        gap = np.hypot(*(position - position[index]).T)
        reach = problem.radius[known] + problem.radius[robot]
        together = vertex == vertex[index]
        close = footprints & (gap < reach - TOLERANCE) & (level == level[index])
        for later in (index + 1 + np.flatnonzero((together | close)[index + 1 :])).tolist():
            other = int(known[later])
            if together[later]:
                yield f"robots {robot} and {other} {same} {places[robot]}"
            else:
                where = f"{places[robot]} and {places[other]}"
                yield (
                    f"robots {robot} and {other} {near} {where}, "
                    f"{gap[later]:.2f} m apart, and need {reach[later]:.2f} m"
                )


def _unreachable(problem: Problem, starts: _Places, goals: _Places) -> Iterator[str]:
    reach = _Reach(problem.roadmap)
    for robot, sequence in enumerate(problem.goals):
        profile = int(problem.profile[robot])
        here = {int(problem.start[robot])} - {-1}
        for index, goal_set in enumerate(sequence):
            last = index == len(sequence) - 1
            goal = f"its goal {goals[robot]}" if last else f"goal {index} of its sequence"
            candidates = set(goal_set) - {-1}
            if not candidates:
                yield f"robot {robot} is to reach {goal}, which is not on the roadmap"
                break
            there = {vertex for vertex in candidates if any(reach(profile, source, vertex) for source in here)}
            if here and not there:
                yield f"robot {robot} cannot reach {goal} from its start {starts[robot]}"
                break
            here = there


class _Reach:
    """Tells whether a vertex can be reached; searches only if the two vertices are not connected both ways."""

    def __init__(self, roadmap: Roadmap) -> None:
        self._roadmap = roadmap
        self._label: dict[int, Int] = {}
        self._reachable: dict[tuple[int, int], Bool] = {}

    def __call__(self, profile: int, source: int, target: int) -> bool:
        if profile not in self._label:
            self._label[profile] = round_trips(self._roadmap, profile)
        label = int(self._label[profile][source])
        if label == self._label[profile][target]:
            return True
        if (profile, label) not in self._reachable:
            self._reachable[profile, label] = reachable(self._roadmap, profile, source)
        return bool(self._reachable[profile, label][target])
