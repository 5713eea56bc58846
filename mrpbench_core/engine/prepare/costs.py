"""Cost matrices for assigners."""

from itertools import pairwise

import numpy as np

from mrpbench_core.api.assigner import Cost
from mrpbench_core.engine.travel import through, travel_ticks
from mrpbench_core.model.common.arrays import Float, Int, read_only
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.goals import goal_vertices, start_vertices
from mrpbench_core.model.planning.problem import GoalSet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario


def cost_matrix(kind: Cost, roadmap: Roadmap, fleet: Fleet, scenario: Scenario) -> Float:
    """The cost f8[n,m] of each task for each robot: from its start through all errands of the task, in order.

    Of an errand with several places, the one counts that makes the whole cheapest.

    `euclidean` and `manhattan` are metres between the places of the scenario in the plane, regardless of walls;
    `roadmap` is the shortest travel time in seconds on the roadmap with the robot's motion profile, without other
    robots, inf where there is no way.
    """
    if kind == "roadmap":
        return _travel_times(roadmap, fleet, scenario)
    costs = np.empty((len(scenario.start), len(scenario.tasks)))
    for column, task in enumerate(scenario.tasks):
        places = [scenario.start[:, :2], *map(np.array, task.by_errand([*task.goals[:, :2]]))]
        first, *legs = (_length(there[None] - here[:, None], kind) for here, there in pairwise(places))
        costs[:, column] = through(first, legs).min(axis=1)
    return read_only(costs)


def _length(span: Float, kind: Cost) -> Float:
    length: Float = np.abs(span).sum(-1) if kind == "manhattan" else np.hypot(span[..., 0], span[..., 1])
    return length


def _travel_times(roadmap: Roadmap, fleet: Fleet, scenario: Scenario) -> Float:
    start, goals = start_vertices(roadmap, scenario), goal_vertices(roadmap, scenario)
    profile = np.array(fleet.profiles[1], np.int64)
    costs = np.empty((len(start), len(goals)))
    for row in np.unique(profile):
        robots = np.flatnonzero(profile == row)
        costs[robots] = _profile_times(roadmap, int(row), start[robots].astype(np.int64), goals)
    costs *= roadmap.tick
    return read_only(costs)


def _profile_times(roadmap: Roadmap, profile: int, start: Int, goals: list[tuple[GoalSet, ...]]) -> Float:
    """Ticks f8[robots,tasks] for robots of one motion profile; inf where there is no way or a place is off the map."""
    targets = sorted({vertex for sequence in goals for goal in sequence for vertex in goal} - {-1})
    sources = sorted({*start.tolist(), *targets} - {-1})
    ticks = np.full((len(targets) + 1, len(sources) + 1), np.inf)  # last row and column: not on the roadmap
    ticks[:-1, :-1] = travel_ticks(roadmap, profile, targets, sources)
    row = {vertex: index for index, vertex in enumerate(targets)}
    column = {vertex: index for index, vertex in enumerate(sources)}
    times = np.zeros((len(start), len(goals)))
    for task, sequence in enumerate(goals):
        first, *legs = (
            ticks[np.ix_([row.get(it, -1) for it in there], [column.get(it, -1) for it in here])].T
            for here, there in pairwise([start.tolist(), *sequence])
        )
        times[:, task] = through(first, legs).min(axis=1)
    return times
