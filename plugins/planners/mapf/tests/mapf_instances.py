"""Small problems for the tests: grids, drawn graphs, and the MovingAI benchmark."""

import itertools
from pathlib import Path as File

import attrs
import numpy as np

from mrpbench_core.model.plan import Path, Plan
from mrpbench_core.model.problem import Feature, Problem, Rules, features_of
from mrpbench_core.model.roadmap import Resource, Roadmap

STEPS = ((0, 1), (1, 0), (0, -1), (-1, 0))


def roadmap(position, edges, duration) -> Roadmap:
    count = len(position)
    return Roadmap(
        position=position,
        level=np.zeros(count),
        heading=np.full(count, np.nan),
        edges=edges,
        duration=np.atleast_2d(duration),
        tick=1.0,
    )


def grid(rows: list[str]) -> Roadmap:
    """4-connected unit grid of the cells that are `.`, vertices in reading order."""
    cells = [(y, x) for y, row in enumerate(rows) for x, cell in enumerate(row) if cell == "."]
    index = {cell: vertex for vertex, cell in enumerate(cells)}
    edges = [
        (vertex, index[y + dy, x + dx])
        for (y, x), vertex in index.items()
        for dy, dx in STEPS
        if (y + dy, x + dx) in index
    ]
    return roadmap([(x, -y) for y, x in cells], np.array(edges, "i4").reshape(-1, 2), np.ones(len(edges)))


def problem(road: Roadmap, starts, goals, *, radius=None, **fields) -> Problem:
    """`goals`: one vertex or a tuple of vertices per robot; a radius makes footprints count."""
    count = len(starts)
    sets = tuple(((goal,) if isinstance(goal, int) else tuple(goal),) for goal in goals)
    given = {
        "roadmap": road,
        "profile": fields.pop("profile", np.zeros(count)),
        "radius": np.zeros(count) if radius is None else np.broadcast_to(radius, count),
        "start": starts,
        "ready": fields.pop("ready", np.zeros(count)),
        "goals": sets,
        "rules": Rules(following=fields.pop("following", "allowed"), at_goal=fields.pop("at_goal", "stay")),
        **fields,
    }
    footprints = frozenset() if radius is None else frozenset({Feature.FOOTPRINTS})
    return Problem(**given, features=features_of(Problem(**given)) | footprints)


def endless_swap(vertices: int) -> Problem:
    """Two robots at the ends of a path. It has no plan, but no quick test rules one out, since moves take two ticks."""
    road = grid(["." * vertices])
    slow = roadmap(road.position, road.edges, np.full(len(road.edges), 2))
    return problem(slow, [0, vertices - 1], [vertices - 1, 0])


def random_grid_problem(random: np.random.Generator, robots: int, size: int = 4, **fields) -> Problem:
    rows = ["".join("#" if random.random() < 0.2 else "." for _ in range(size)) for _ in range(size)]
    road = grid(rows)
    if len(road.position) < robots:
        return random_grid_problem(random, robots, size, **fields)
    vertices = len(road.position)
    starts = random.choice(vertices, robots, replace=False)
    goals = [int(goal) for goal in random.choice(vertices, robots, replace=False)]
    return problem(road, starts, goals, **fields)


def random_graph(random: np.random.Generator, vertices: int, longest: int, profiles: int = 1) -> Roadmap:
    """A connected graph of two-way and some one-way lanes between random points."""
    position = random.integers(0, 5, (vertices, 2)) + random.random((vertices, 2)) * 0.2
    pairs = {(v, int(random.integers(v))) for v in range(1, vertices)}
    pairs |= {(b, a) for a, b in pairs}
    for _ in range(vertices):
        a, b = (int(v) for v in random.choice(vertices, 2, replace=False))
        pairs |= {(a, b)} if random.random() < 0.4 else {(a, b), (b, a)}
    edges = sorted(pairs)
    return roadmap(position, edges, random.integers(1, longest + 1, (profiles, len(edges))))


def movingai(data: File, name: str, scen: str, robots: int) -> Problem:
    lines = (data / "movingai" / "maps" / f"{name}.map").read_text().splitlines()[4:]
    rows = ["".join("." if cell in ".G" else "#" for cell in line) for line in lines]
    road = grid(rows)
    index = {(int(x), int(-y)): vertex for vertex, (x, y) in enumerate(road.position)}
    table = (data / "movingai" / "scens" / f"{name}-{scen}.scen").read_text().splitlines()[1 : robots + 1]
    tasks = [[int(value) for value in line.split()[4:8]] for line in table]
    assert len(tasks) == robots
    return problem(road, [index[x, y] for x, y, _, _ in tasks], [index[x, y] for _, _, x, y in tasks])


def random_graph_problem(random: np.random.Generator, robots: int, longest: int = 3, **fields) -> Problem:
    """Robots with one or two goals each on a random graph with edges of 1..longest ticks."""
    profiles = int(random.integers(1, 3))
    road = random_graph(random, int(random.integers(robots + 2, 8)), longest, profiles)
    vertices = len(road.position)
    starts = random.choice(vertices, robots, replace=False)
    goals = [tuple(map(int, random.choice(vertices, random.integers(1, 3), replace=False))) for _ in range(robots)]
    return problem(road, starts, goals, profile=random.integers(0, profiles, robots), **fields)


def random_full_problem(random: np.random.Generator) -> Problem:
    """Little room: as many robots as cells, or one or two less; sometimes two share a start or a goal."""
    width, height = ((2, 2), (3, 2), (4, 1), (3, 1))[int(random.integers(4))]
    vertices = width * height
    robots = max(1, vertices - int(random.integers(3)))
    starts = random.choice(vertices, robots, replace=bool(random.random() < 0.05))
    goals = random.choice(vertices, robots, replace=bool(random.random() < 0.1))
    return problem(grid(["." * width] * height), starts, goals.tolist())


def random_narrow_problem(random: np.random.Generator, robots: int) -> Problem:
    """Robots on a path, a cycle, or a tree, with edges of one tick or, all of them, two."""
    vertices = int(random.integers(robots, 8))
    shape = random.choice(["path", "cycle", "tree"])
    pairs = {(v, int(random.integers(v)) if shape == "tree" else v - 1) for v in range(1, vertices)}
    pairs |= {(0, vertices - 1)} if shape == "cycle" and vertices > 2 else set()
    edges = sorted(pairs | {(b, a) for a, b in pairs})
    road = roadmap(random.random((vertices, 2)), edges, np.full(len(edges), random.integers(1, 3)))
    starts = random.choice(vertices, robots, replace=False)
    return problem(road, starts, random.choice(vertices, robots, replace=False).tolist())


def random_corridor_problem(random: np.random.Generator, robots: int, longest: int = 1, **fields) -> Problem:
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
    return problem(road, starts, goals.tolist(), **fields)


def with_releases(random: np.random.Generator, asked: Problem) -> Problem:
    """The same problem, but robots have set out already, for no or a few segments, in whatever directions."""
    return _with_commitments(asked, tuple(_wandering(random, asked, robot) for robot in range(len(asked))))


def with_plan_released(random: np.random.Generator, asked: Problem, plan: Plan) -> Problem:
    """The same problem, but up to three segments of each robot's path are released already."""
    sizes = random.integers(0, 4, len(plan.paths)).tolist()
    released = tuple(_first_of(path, size) for path, size in zip(plan.paths, sizes, strict=True))
    return _with_commitments(asked, released)


def with_late_release(random: np.random.Generator, asked: Problem) -> Problem:
    """The same problem for two robots, of which the first is late and slow on a lane, and waits there; or none."""
    ways = np.flatnonzero((asked.roadmap.edges[:, 0] == asked.start[0]) & (asked.duration(0) > 0))
    if not len(ways):
        return asked
    edge, enter = int(random.choice(ways)), int(random.integers(0, 3))
    leave = enter + int(asked.duration(0)[edge]) + int(random.integers(0, 3))
    late = Path(edge=[-1, edge, -1], enter=[0, enter, leave], leave=[enter, leave, leave + int(random.integers(0, 2))])
    return _with_commitments(asked, (late, _first_of(late, 0)))


def _first_of(path: Path, size: int) -> Path:
    return Path(edge=path.edge[:size], enter=path.enter[:size], leave=path.leave[:size])


def _with_commitments(asked: Problem, released: tuple[Path, ...]) -> Problem:
    changed = attrs.evolve(asked, commitments=released)
    return attrs.evolve(changed, features=features_of(changed) | asked.features)


def _wandering(random: np.random.Generator, asked: Problem, robot: int) -> Path:
    edge, times, at = [], [0], int(asked.start[robot])
    for _ in range(int(random.integers(3))):
        ways = np.flatnonzero((asked.roadmap.edges[:, 0] == at) & (asked.duration(robot) > 0))
        chosen = int(random.choice([-1, *ways]))
        least = 1 if chosen < 0 else int(asked.duration(robot)[chosen])
        edge.append(chosen)
        times.append(times[-1] + least + int(random.random() < 0.2))
        at = at if chosen < 0 else int(asked.roadmap.edges[chosen, 1])
    return Path(edge=edge, enter=times[:-1], leave=times[1:])


def with_resources(random: np.random.Generator, asked: Problem, capacity: int = 1) -> Problem:
    """The same problem with one or two resources, each a few vertices and the edges between or at them."""
    road = asked.roadmap
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
    changed = attrs.evolve(asked, roadmap=attrs.evolve(road, resources=tuple(found)))
    return attrs.evolve(changed, features=features_of(changed) | asked.features & {Feature.FOOTPRINTS})


def with_candidates(random: np.random.Generator, asked: Problem) -> Problem:
    """The same problem, but each robot may take some of a few goals that all draw from; its own among them."""
    robots, vertices = len(asked), len(asked.roadmap.position)
    own = [int(goal) for goal in random.choice(vertices, robots, replace=False)]
    others = [vertex for vertex in range(vertices) if vertex not in own][: int(random.integers(0, 3))]
    pool = own + others
    sets = [
        tuple(sorted({own[robot], *(goal for goal in pool if random.random() < random.choice([0.3, 1.0]))}))
        for robot in range(robots)
    ]
    goals = tuple((goals,) for goals in sets)
    changed = attrs.evolve(asked, goals=goals)
    return attrs.evolve(changed, features=features_of(changed) | asked.features & {Feature.FOOTPRINTS})


def random_rules(random: np.random.Generator) -> dict:
    """Some mixture of footprints, ready times and conventions, as fields for `problem`."""
    fields = {
        "following": str(random.choice(["allowed", "forbidden"])),
        "at_goal": str(random.choice(["stay", "disappear"])),
    }
    if random.random() < 0.5:
        fields["radius"] = float(random.choice([0.1, 0.3, 0.6]))
    return fields
