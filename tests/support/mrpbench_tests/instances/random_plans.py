"""Plans that no planner has made: robots walk about at random, and moves that conflict are dropped."""

from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.planning.plan import Plan, RobotPath
from mrpbench_core.model.planning.problem import Feature, Problem, Rules
from mrpbench_core.model.planning.roadmap import Resource, Roadmap
from mrpbench_core.testing.drawing import build, timed_path
from mrpbench_tests.instances.random_problems import Random
from mrpbench_tests.instances.roadmaps import two_way, two_way_grid

NOTHING = timed_path([], [], [])


def random_lanes(random: Random) -> Roadmap:
    """A grid; or a grid with bent, missing, crossing lanes of different durations; or lanes that cross one another."""
    rows, columns = (int(size) for size in random.integers(2, 5, 2))
    kind = random.choice(["grid", "bent", "weave"])
    if kind == "weave":
        return _weave(random, rows, columns)
    grid = two_way_grid(rows, columns)
    if kind == "grid":
        return grid
    corners = [v for v in range((rows - 1) * columns) if (v + 1) % columns]
    lanes = grid.edges[::2].tolist()
    lanes += [pair for v in corners for pair in ((v, v + columns + 1), (v + 1, v + columns)) if random.random() < 0.3]
    lanes = [lane for lane in lanes if random.random() < 0.9]
    bent = grid.position + random.uniform(-0.2, 0.2, grid.position.shape)
    return two_way(bent, lanes, duration=random.integers(1, 6, len(lanes)))


def _weave(random: Random, rows: int, columns: int) -> Roadmap:
    """Long lanes that cross one another between their ends, each end joined to that of the next lane beside it."""
    across = [((-1, y), (columns, y)) for y in range(rows)]
    along = [((x, -1), (x, rows)) for x in range(columns)]
    points = [point for lane in across + along for point in lane]
    lanes = [(v, v + 1) for v in range(0, len(points), 2)]
    lanes += [(v, v + 2) for v in range(len(points) - 2) if v not in (2 * rows - 2, 2 * rows - 1)]
    return two_way(points, lanes, duration=random.integers(1, 4, len(lanes)))


def random_starts(random: Random, roadmap: Roadmap) -> Problem:
    """Robots on a roadmap that may end anywhere, with drawn rules and footprints."""
    robots = int(random.integers(2, max(3, int(len(roadmap.position) * random.uniform(0.3, 1.2)))))
    starts = random.permutation(len(roadmap.position))[:robots]
    robots = len(starts)
    nowhere = Plan(paths=(NOTHING,) * robots)
    problem = attrs.evolve(
        build(roadmap, starts, [()] * robots),
        radius=random.choice([0.1, 0.2, 0.4], robots),
        goals=((),) * robots,
        rules=Rules(
            following=str(random.choice(["allowed", "allowed", "forbidden"])),
            at_goal=str(random.choice(["stay", "stay", "disappear"])),
        ),
        features=frozenset({Feature.FOOTPRINTS}) if random.random() < 0.4 else frozenset(),
    )
    return problem if check_plan(problem, nowhere).valid else attrs.evolve(problem, radius=np.full(robots, 0.1))


def wander(problem: Problem, random: Random, paths: Sequence[RobotPath], ticks: int) -> Plan:
    """Lengthen paths by a random walk without conflicts: proposed moves are dropped while they conflict."""
    edges = problem.roadmap.edges
    begin = max((int(path.leave[-1]) for path in paths if len(path)), default=0)
    for now in range(begin, begin + ticks):
        idle = [robot for robot, path in enumerate(paths) if not len(path) or path.leave[-1] <= now]
        at = {robot: int(paths[robot].vertices(problem.roadmap, problem.start[robot])[-1]) for robot in idle}
        moves = {
            robot: int(random.choice(ways))
            for robot, vertex in at.items()
            if len(ways := np.flatnonzero(edges[:, 0] == vertex)) and random.random() < 0.8
        }
        ring = _ring(random, edges, at)
        moves = ring if ring and random.random() < 0.5 else moves | ring
        while True:
            tried = [_moved(problem, robot, path, moves.get(robot), now) for robot, path in enumerate(paths)]
            conflicts = check_plan(problem, Plan(paths=tuple(tried))).conflicts
            guilty = {next((robot for robot in conflict.robots if robot in moves), -1) for conflict in conflicts}
            if -1 in guilty:  # of three robots in a resource a conflict names two
                assert problem.roadmap.resources
                assert moves
                guilty = set(moves)
            if not guilty:
                break
            for robot in guilty:
                del moves[robot]
        paths = tried
    return Plan(paths=tuple(paths))


def _ring(random: Random, edges: Int32, at: Mapping[int, int]) -> dict[int, int]:
    """Moves of robots, each to where the next one stands, if the draw finds a ring of them."""
    robot_at = {vertex: robot for robot, vertex in at.items()}
    chain, taken = [int(random.choice(list(robot_at)))] if robot_at else [], []
    while chain:
        ways = [
            int(edge)
            for edge in np.flatnonzero(edges[:, 0] == chain[-1])
            if int(edges[edge, 1]) in robot_at and int(edges[edge, 1]) not in chain[len(chain) > 2 :]
        ]
        if not ways:
            break
        taken.append(int(random.choice(ways)))
        if edges[taken[-1], 1] == chain[0]:
            return {robot_at[vertex]: edge for vertex, edge in zip(chain, taken, strict=True)}
        chain.append(int(edges[taken[-1], 1]))
    return {}


def _moved(problem: Problem, robot: int, path: RobotPath, edge: int | None, now: int) -> RobotPath:
    """A path with a move from tick `now`, and a wait before it if needed."""
    if edge is None:
        return path
    last = int(path.leave[-1]) if len(path) else 0
    waits = [-1] * (now > last)
    return timed_path(
        [*path.edge.tolist(), *waits, edge],
        [*path.enter.tolist(), *([last] * len(waits)), now],
        [*path.leave.tolist(), *([now] * len(waits)), now + int(problem.duration(robot)[edge])],
    )


def squeeze(problem: Problem, random: Random, plan: Plan, tries: int = 40) -> Plan:
    """Shorten waits where the plan stays valid, so that robots follow one another closely."""
    for _ in range(tries):
        robot = int(random.integers(len(plan.paths)))
        path = plan.paths[robot]
        waits = np.flatnonzero((path.edge < 0) & (path.leave > path.enter))
        if len(waits):
            segment = random.choice(waits)
            ticks = int(random.integers(1, path.leave[segment] - path.enter[segment] + 1))
            at = np.arange(len(path))
            shorter = RobotPath(
                edge=path.edge, enter=path.enter - ticks * (at > segment), leave=path.leave - ticks * (at >= segment)
            )
            changed = Plan(paths=(*plan.paths[:robot], shorter, *plan.paths[robot + 1 :]))
            plan = changed if check_plan(problem, changed).valid else plan
    return plan


def random_plan(random: Random) -> tuple[Problem, Plan]:
    """A problem and a valid plan."""
    problem = random_starts(random, random_lanes(random))
    return problem, squeeze(problem, random, wander(problem, random, [NOTHING] * len(problem), ticks=8))


def with_random_resources(random: Random, problem: Problem) -> Problem:
    """The same problem with parts of its roadmap as resources, each with room for all robots that start in it."""
    roadmap = problem.roadmap
    resources = []
    for index in range(int(random.integers(1, 4))):
        lanes = np.flatnonzero(random.random(len(roadmap.edges)) < random.choice([0.1, 0.4]))
        places = np.flatnonzero(random.random(len(roadmap.position)) < random.choice([0.0, 0.3]))
        resources.append(
            Resource(
                name=f"r{index}",
                kind="mutex",
                capacity=max(int(random.integers(1, 3)), int(np.isin(problem.start, places).sum())),
                vertices=tuple(places.tolist()),
                edges=tuple(lanes.tolist()),
                setup_ticks=int(random.integers(0, 3)),
            )
        )
    return attrs.evolve(problem, roadmap=attrs.evolve(roadmap, resources=tuple(resources)))


def random_plan_with_resources(random: Random) -> tuple[Problem, Plan]:
    """A problem with resources and a valid plan."""
    problem = with_random_resources(random, random_starts(random, random_lanes(random)))
    # A robot that walks on after it seemed to have disappeared conflicts with others, which dropping moves cannot undo.
    problem = attrs.evolve(problem, rules=attrs.evolve(problem.rules, at_goal="stay"))
    return problem, squeeze(problem, random, wander(problem, random, [NOTHING] * len(problem), ticks=8))
