"""Problems drawn at random with NumPy, so that a seed and a number name each of them in a soak."""

import itertools
import math
from typing import Any

import attrs
import numpy as np

from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Resource, Roadmap
from mrpbench_tests.instances.problems import problem_on
from mrpbench_tests.instances.roadmaps import grid_of, roadmap, two_way

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


def random_building_problem(random: Random, robots: int, capacity: int = 1, junctions: int | None = None) -> Problem:
    """Robots with footprints on a ring of single-file lanes with two to four rooms, most of them behind doors.

    The ring has six to ten `junctions` 3 m apart, two of which a shorter way may join. A doorway, with the
    vertex behind it if there is room for several, holds `capacity` robots. Robots start and end in the rooms or on the
    ring, as many as fit.
    """
    ring = junctions or int(random.integers(6, 11))
    angle = np.arange(ring) * 2 * np.pi / ring
    outwards = np.column_stack([np.cos(angle), np.sin(angle)])
    position = list(outwards * ring * 3 / (2 * np.pi))
    pairs = [(v, (v + 1) % ring) for v in range(ring)]
    if random.random() < 0.5:
        pairs += [(0, ring), (ring, ring // 2)]
        position.append(np.zeros(2))
    stands = list(range(1, ring))
    doors: list[tuple[int, int]] = []  # their first and last vertices
    for junction in random.choice(ring, int(random.integers(2, 5)), replace=False).tolist():
        out, doorway = outwards[junction], len(position)
        side = np.array([-out[1], out[0]])
        position += [position[junction] + 2 * out, position[junction] + 4 * out]
        pairs += [(junction, doorway), (doorway, doorway + 1)]
        for turn in np.linspace(-1.2, 1.2, int(random.integers(2, 5))):
            pairs.append((doorway + 1, len(position)))
            stands.append(len(position))
            position.append(position[doorway + 1] + 2 * (np.cos(turn) * out + np.sin(turn) * side))
        if random.random() < 0.7:
            doors.append((doorway, doorway + (capacity > 1)))
    places = np.array(position)
    length = [float(np.linalg.norm(places[a] - places[b])) for a, b in pairs]
    road = two_way(places, pairs, [math.ceil(2 * metres) for metres in length])
    resources = []
    for number, (first, last) in enumerate(doors):
        inside = np.isin(road.edges, range(first, last + 1)).any(axis=1)
        door = Resource(
            name=f"door {number}",
            kind="door",
            capacity=capacity,
            vertices=tuple(range(first, last + 1)),
            edges=tuple(np.flatnonzero(inside).tolist()),
            setup_ticks=int(random.integers(0, 6)),
        )
        resources.append(door)
    road = attrs.evolve(road, resources=tuple(resources))
    count = min(robots, len(stands))
    starts, goals = (random.choice(stands, count, replace=False) for _ in range(2))
    return problem_on(road, starts, goals.tolist(), radius=0.3)


def random_rules(random: Random) -> dict[str, Any]:
    """Drawn rules and, half of the time, footprints, as fields of `problem_on`."""
    fields: dict[str, Any] = {
        "following": str(random.choice(["allowed", "forbidden"])),
        "at_goal": str(random.choice(["stay", "disappear"])),
    }
    if random.random() < 0.5:
        fields["radius"] = float(random.choice([0.1, 0.3, 0.6]))
    return fields
