"""Problems drawn at random with NumPy, so that a seed and a number name each of them in a soak."""

import itertools
from typing import Any

import numpy as np

from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.testing.instances.problems import problem_on
from mrpbench_core.testing.instances.roadmaps import grid_of, roadmap

Random = np.random.Generator


def random_grid_problem(random: Random, robots: int, size: int = 4, **fields: Any) -> Problem:
    """Robots on a square grid with one blocked cell in five; each start and each goal is taken once."""
    rows = ["".join("#" if random.random() < 0.2 else "." for _ in range(size)) for _ in range(size)]
    road = grid_of(rows)
    if len(road.position) < robots:
        return random_grid_problem(random, robots, size, **fields)
    vertices = len(road.position)
    starts = random.choice(vertices, robots, replace=False)
    goals = [int(goal) for goal in random.choice(vertices, robots, replace=False)]
    return problem_on(road, starts, goals, **fields)


def random_graph(random: Random, vertices: int, longest: int, profiles: int = 1) -> Roadmap:
    """A connected graph of two-way and some one-way lanes between random points."""
    position = random.integers(0, 5, (vertices, 2)) + random.random((vertices, 2)) * 0.2
    pairs = {(v, int(random.integers(v))) for v in range(1, vertices)}
    pairs |= {(b, a) for a, b in pairs}
    for _ in range(vertices):
        a, b = (int(v) for v in random.choice(vertices, 2, replace=False))
        pairs |= {(a, b)} if random.random() < 0.4 else {(a, b), (b, a)}
    edges = sorted(pairs)
    return roadmap(position, edges, random.integers(1, longest + 1, (profiles, len(edges))))


def random_graph_problem(random: Random, robots: int, longest: int = 3, **fields: Any) -> Problem:
    """Robots with one or two goals each on a random graph with edges of 1..longest ticks."""
    profiles = int(random.integers(1, 3))
    road = random_graph(random, int(random.integers(robots + 2, 8)), longest, profiles)
    vertices = len(road.position)
    starts = random.choice(vertices, robots, replace=False)
    goals = [tuple(map(int, random.choice(vertices, random.integers(1, 3), replace=False))) for _ in range(robots)]
    return problem_on(road, starts, goals, profile=random.integers(0, profiles, robots), **fields)


def random_full_problem(random: Random) -> Problem:
    """Little room: as many robots as cells, or one or two less; sometimes two share a start or a goal."""
    width, height = ((2, 2), (3, 2), (4, 1), (3, 1))[int(random.integers(4))]
    vertices = width * height
    robots = max(1, vertices - int(random.integers(3)))
    starts = random.choice(vertices, robots, replace=bool(random.random() < 0.05))
    goals = random.choice(vertices, robots, replace=bool(random.random() < 0.1))
    return problem_on(grid_of(["." * width] * height), starts, goals.tolist())


def random_narrow_problem(random: Random, robots: int) -> Problem:
    """Robots on a path, a cycle, or a tree, with edges of one tick or, all of them, two."""
    vertices = int(random.integers(robots, 8))
    shape = random.choice(["path", "cycle", "tree"])
    pairs = {(v, int(random.integers(v)) if shape == "tree" else v - 1) for v in range(1, vertices)}
    pairs |= {(0, vertices - 1)} if shape == "cycle" and vertices > 2 else set()
    edges = sorted(pairs | {(b, a) for a, b in pairs})
    road = roadmap(random.random((vertices, 2)), edges, np.full(len(edges), random.integers(1, 3)))
    starts = random.choice(vertices, robots, replace=False)
    return problem_on(road, starts, random.choice(vertices, robots, replace=False).tolist())


def random_corridor_problem(random: Random, robots: int, longest: int = 1, **fields: Any) -> Problem:
    """Two hubs with a few bays each, joined by one or two chains; robots start and end anywhere, also in a chain."""
    unused = itertools.count(2)  # 0 and 1 are the hubs
    pairs: list[tuple[int, int]] = []
    for hub in (0, 1):
        pairs += [(hub, next(unused)) for _ in range(random.integers(1, 4))]
    for _ in range(random.integers(1, 3)):
        chain = [0, *(next(unused) for _ in range(random.integers(1, 5))), 1]
        pairs += itertools.pairwise(chain)
    edges = sorted({*pairs, *((b, a) for a, b in pairs)})
    vertices = next(unused)
    position = random.random((vertices, 2)) * 100  # only lanes that share an end are close to one another
    road = roadmap(position, edges, random.integers(1, longest + 1, len(edges)))
    starts, goals = (random.choice(vertices, robots, replace=False) for _ in range(2))
    return problem_on(road, starts, goals.tolist(), **fields)


def random_rules(random: Random) -> dict[str, Any]:
    """Drawn rules and, half of the time, footprints, as fields of `problem_on`."""
    fields: dict[str, Any] = {
        "following": str(random.choice(["allowed", "forbidden"])),
        "at_goal": str(random.choice(["stay", "disappear"])),
    }
    if random.random() < 0.5:
        fields["radius"] = float(random.choice([0.1, 0.3, 0.6]))
    return fields
