"""From a scenario and an assignment to the problem a planner is given."""

import attrs
import numpy as np

from mrpbench_core.model.fleet import Fleet
from mrpbench_core.model.problem import Feature, GoalSet, Problem, features_of
from mrpbench_core.model.roadmap import Roadmap
from mrpbench_core.model.scenario import Scenario


def build_problem(roadmap: Roadmap, fleet: Fleet, start: np.ndarray, goals: tuple[tuple[GoalSet, ...], ...]) -> Problem:
    """The problem of driving `fleet` from vertices `start` i4[n] to `goals`, with the features it needs.

    Footprints matter where discs of the fleet's radii do not fit on the roadmap side by side: on every roadmap that is
    no raster, and on a raster whose cells are smaller than the two largest robots. On a wider raster the field's usual
    point-like conflicts suffice, since a dispatcher admits no robot to a cell before the last one has cleared it.
    """
    profile = np.array(fleet.profiles[1], np.int32)
    problem = Problem(
        roadmap=roadmap,
        profile=profile,
        radius=fleet.radii,
        start=start,
        ready=np.zeros(len(fleet), "i8"),
        goals=goals,
    )
    wide = 2 * float(np.sort(fleet.radii)[-2:].mean())
    crowded = roadmap.grid is None or wide > roadmap.grid.cell_size + 1e-9
    features = features_of(problem) | ({Feature.FOOTPRINTS} if crowded else set())
    return attrs.evolve(problem, features=features)


def goal_vertices(roadmap: Roadmap, scenario: Scenario) -> list[tuple[int, ...]]:
    """The roadmap vertices of each task's goals, in order; -1 = not on the roadmap."""
    return [tuple(int(vertex) for vertex in roadmap.locate(task.goals[:, :2], task.levels)) for task in scenario.tasks]
