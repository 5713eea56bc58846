"""Where the starts and tasks of a scenario are on a roadmap."""

import numpy as np

from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.problem import Goals, GoalSet, Problem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario, Task


def start_vertices(roadmap: Roadmap, scenario: Scenario) -> Int32:
    """The roadmap vertices i4[n] at which robots start; -1 = not on the roadmap. Robots with any yaw start with 0."""
    vertex = roadmap.locate(scenario.start[:, :2], scenario.start_level)
    return roadmap.facing(vertex, np.nan_to_num(scenario.start[:, 2]))


def goal_vertices(roadmap: Roadmap, scenario: Scenario) -> list[tuple[GoalSet, ...]]:
    """The roadmap vertices of each task's errands, in order; (-1,) = no place is on the roadmap."""
    return [tuple(tuple(goal) or (-1,) for goal in goal_yaws(roadmap, task)) for task in scenario.tasks]


def goal_yaws(roadmap: Roadmap, task: Task) -> tuple[dict[int, float], ...]:
    """For each errand of a task the radians wanted at each vertex that will do, NaN = any."""
    vertices = roadmap.facing(roadmap.locate(task.goals[:, :2], task.levels), task.goals[:, 2]).tolist()
    places = task.by_errand([*zip(vertices, task.goals[:, 2].tolist(), strict=True)])
    return tuple({vertex: yaw for vertex, yaw in errand if vertex >= 0} for errand in places)


def first_problem(roadmap: Roadmap, fleet: Fleet, start: Int32, goals: Goals) -> Problem:
    """The problem of driving `fleet` from vertices `start` i4[n] to `goals`, without the features that it needs."""
    return Problem(
        roadmap=roadmap,
        profile=np.array(fleet.profiles[1], np.int32),
        radius=fleet.radii,
        start=start,
        ready=np.zeros(len(fleet), "i8"),
        goals=goals,
    )
