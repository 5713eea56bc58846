"""The same problem with something added at random: commitments, resources, a choice of goals."""

import attrs
import numpy as np

from mrpbench_core.model.planning.plan import Plan, RobotPath
from mrpbench_core.model.planning.problem import Feature, Problem, features_of
from mrpbench_core.model.planning.roadmap import Resource
from mrpbench_core.testing.drawing import timed_path

Random = np.random.Generator


def with_releases(random: Random, problem: Problem) -> Problem:
    """The same problem, but robots have already driven up to a few segments in random directions."""
    return _with_commitments(problem, tuple(_wandering(random, problem, robot) for robot in range(len(problem))))


def with_plan_released(random: Random, problem: Problem, plan: Plan) -> Problem:
    """The same problem, but up to three segments of each robot's path are released already."""
    sizes = random.integers(0, 4, len(plan.paths)).tolist()
    released = tuple(_first_of(path, size) for path, size in zip(plan.paths, sizes, strict=True))
    return _with_commitments(problem, released)


def with_late_release(random: Random, problem: Problem) -> Problem:
    """The same problem for two robots, of which the first is late and slow on a lane, and waits there; or none."""
    ways = np.flatnonzero((problem.roadmap.edges[:, 0] == problem.start[0]) & (problem.duration(0) > 0))
    if not len(ways):
        return problem
    edge, enter = int(random.choice(ways)), int(random.integers(0, 3))
    leave = enter + int(problem.duration(0)[edge]) + int(random.integers(0, 3))
    late = timed_path([-1, edge, -1], [0, enter, leave], [enter, leave, leave + int(random.integers(0, 2))])
    return _with_commitments(problem, (late, _first_of(late, 0)))


def _first_of(path: RobotPath, size: int) -> RobotPath:
    return RobotPath(edge=path.edge[:size], enter=path.enter[:size], leave=path.leave[:size])


def _with_commitments(problem: Problem, released: tuple[RobotPath, ...]) -> Problem:
    changed = attrs.evolve(problem, commitments=released)
    return attrs.evolve(changed, features=features_of(changed) | problem.features)


def _wandering(random: Random, problem: Problem, robot: int) -> RobotPath:
    edge, times, at = [], [0], int(problem.start[robot])
    for _ in range(int(random.integers(3))):
        ways = np.flatnonzero((problem.roadmap.edges[:, 0] == at) & (problem.duration(robot) > 0))
        chosen = int(random.choice([-1, *ways]))
        least = 1 if chosen < 0 else int(problem.duration(robot)[chosen])
        edge.append(chosen)
        times.append(times[-1] + least + int(random.random() < 0.2))
        at = at if chosen < 0 else int(problem.roadmap.edges[chosen, 1])
    return timed_path(edge, times[:-1], times[1:])


def with_resources(random: Random, problem: Problem, capacity: int = 1) -> Problem:
    """The same problem with one or two resources, each a few vertices and the edges between or at them."""
    road = problem.roadmap
    found = []
    for name in "ab"[: int(random.integers(1, 3))]:
        vertices = random.choice(len(road.position), int(random.integers(0, 4)), replace=False)
        ends = np.isin(road.edges, vertices)
        edges = np.flatnonzero(ends.any(axis=1) if random.random() < 0.5 else ends.all(axis=1))
        if not len(vertices):
            edges = random.choice(len(road.edges), min(2, len(road.edges)), replace=False)
        setup = int(random.integers(0, 4))
        elements = {"vertices": tuple(vertices.tolist()), "edges": tuple(edges.tolist())}
        found.append(Resource(name=name, kind="mutex", capacity=capacity, setup_ticks=setup, **elements))
    changed = attrs.evolve(problem, roadmap=attrs.evolve(road, resources=tuple(found)))
    return attrs.evolve(changed, features=features_of(changed) | problem.features & {Feature.FOOTPRINTS})


def with_candidates(random: Random, problem: Problem) -> Problem:
    """The same problem, but each robot may take some of a few goals that all draw from; its own among them."""
    robots, vertices = len(problem), len(problem.roadmap.position)
    own = [int(goal) for goal in random.choice(vertices, robots, replace=False)]
    others = [vertex for vertex in range(vertices) if vertex not in own][: int(random.integers(0, 3))]
    pool = own + others
    sets = [
        tuple(sorted({own[robot], *(goal for goal in pool if random.random() < random.choice([0.3, 1.0]))}))
        for robot in range(robots)
    ]
    goals = tuple((goals,) for goals in sets)
    changed = attrs.evolve(problem, goals=goals)
    return attrs.evolve(changed, features=features_of(changed) | problem.features & {Feature.FOOTPRINTS})
