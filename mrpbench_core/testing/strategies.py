"""Hypothesis strategies for grids and roadmaps, problems, plans, fleets and scenarios, small by default.

Needs Hypothesis: `pip install hypothesis`.
"""

from itertools import pairwise

import attrs
import numpy as np
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.common.fleet import Fleet, Lidar, RobotModel
from mrpbench_core.model.planning.assignment import AssignmentProblem
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Feature, GoalSet, Problem, Rules
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.testing.drawing import build, grid, unit_path


@st.composite
def grids(draw: st.DrawFn, most_rows: int = 4, most_columns: int = 5, walls: bool = True) -> Roadmap:
    """Four-connected grids of unit steps, at least one cell free; with `walls`, up to a third of the cells blocked."""
    rows, columns = draw(st.integers(1, most_rows)), draw(st.integers(1, most_columns))
    cells = [(row, column) for row in range(rows) for column in range(columns)]
    most = len(cells) // 3 if walls else 0
    return grid(rows, columns, draw(st.sets(st.sampled_from(cells), max_size=most)))


@st.composite
def roadmaps(draw: st.DrawFn, most_rows: int = 4, most_columns: int = 5, most_ticks: int = 3) -> Roadmap:
    """Grids whose edges take up to `most_ticks` ticks, some of them closed in one direction."""
    drawn = draw(grids(most_rows, most_columns))
    ticks = st.sampled_from([*range(1, most_ticks + 1), -1])
    count = len(drawn.edges)
    row = draw(st.lists(ticks, min_size=count, max_size=count))
    return attrs.evolve(drawn, duration=np.array(row, "i4").reshape(1, count))


@st.composite
def assignment_problems(draw: st.DrawFn, most: int = 5) -> AssignmentProblem:
    """Costs of up to `most` robots and tasks, from 0 to 100, with ties and forbidden pairs; not all are feasible."""
    cost = st.floats(0, 100) | st.integers(0, 5).map(float) | st.just(float("inf"))
    shape = draw(st.tuples(st.integers(0, most), st.integers(0, most)))
    return AssignmentProblem(costs=draw(arrays("f8", shape, elements=cost)))


@st.composite
def problems(
    draw: st.DrawFn,
    roadmap: st.SearchStrategy[Roadmap] | None = None,
    most_robots: int = 4,
    features: frozenset[Feature] = frozenset(),
) -> Problem:
    """Robots with distinct starts and distinct goals on a roadmap; not every problem has a plan.

    Args:
        draw: from Hypothesis.
        roadmap: where, by default `grids()`.
        most_robots: fewer where there are fewer vertices.
        features: of these, `goal_sets`, `goal_sequences`, `footprints` and `following_forbidden` are drawn half of the
            time.
    """
    chosen = draw(grids() if roadmap is None else roadmap)
    vertices = range(len(chosen.position))
    robots = draw(st.integers(1, min(most_robots, len(vertices))))
    starts = draw(st.permutations(vertices))[:robots]
    goals: list[tuple[int, ...]] = [(vertex,) for vertex in draw(st.permutations(vertices))[:robots]]
    if Feature.GOAL_SETS in features and draw(st.booleans()):
        goals = [(*goal, draw(st.sampled_from([v for v in vertices if v not in goal] or [*goal]))) for goal in goals]
        goals = [tuple(sorted(set(goal))) for goal in goals]
    sequences: list[tuple[GoalSet, ...]] = [(goal,) for goal in goals]
    if Feature.GOAL_SEQUENCES in features and draw(st.booleans()):
        before = st.lists(st.sampled_from(vertices).map(lambda vertex: (vertex,)), max_size=2)
        sequences = [(*draw(before), goal) for goal in goals]
    footprints = Feature.FOOTPRINTS in features and draw(st.booleans())
    following = Feature.FOLLOWING_FORBIDDEN in features and draw(st.booleans())
    return build(
        chosen,
        starts,
        goals,
        goals=tuple(sequences),
        radius=draw(st.sampled_from([0.1, 0.3, 0.45])),
        features={Feature.FOOTPRINTS} if footprints else (),
        rules=Rules(
            following="forbidden" if following else "allowed", at_goal=draw(st.sampled_from(["stay", "disappear"]))
        ),
    )


@st.composite
def plans(draw: st.DrawFn, most_robots: int = 4, most_ticks: int = 8) -> tuple[Problem, Plan]:
    """A problem on a grid and a plan without conflicts: a random walk, whose ends become the goals."""
    roadmap = draw(grids())
    vertices = range(len(roadmap.position))
    starts = draw(st.permutations(vertices))[: draw(st.integers(1, min(most_robots, len(vertices))))]
    neighbours: list[list[int]] = [[vertex] for vertex in vertices]
    edge_of = {}
    for edge, (tail, head) in enumerate(roadmap.edges.tolist()):
        neighbours[tail].append(head)
        edge_of[tail, head] = edge
    routes = [[start] for start in starts]
    for _ in range(draw(st.integers(0, most_ticks))):
        taken: dict[int, int] = {}
        here = {route[-1]: robot for robot, route in enumerate(routes)}
        for robot, route in enumerate(routes):
            wanted = draw(st.sampled_from(neighbours[route[-1]]))
            # A vertex counts as free only if no robot stands there now, since later robots have not chosen yet.
            free = wanted not in taken and here.get(wanted, robot) == robot
            taken[wanted if free else route[-1]] = robot
        for vertex, robot in taken.items():
            routes[robot].append(vertex)
    paths = [unit_path(edge_of.get(step, -1) for step in pairwise(route)) for route in routes]
    made = build(roadmap, starts, [(route[-1],) for route in routes])
    plan = Plan(paths=tuple(paths))
    assert check_plan(made, plan).valid
    return made, plan


@st.composite
def fleets(draw: st.DrawFn, most_robots: int = 4, kinds: int = 2) -> Fleet:
    """Robots of up to so many kinds, with footprints of eight corners."""
    models = []
    for kind in range(draw(st.integers(1, kinds))):
        radius = draw(st.floats(0.05, 0.4))
        angle = np.arange(8) * np.pi / 4
        models.append(
            RobotModel(
                name=f"kind {kind}",
                footprint=radius * np.column_stack([np.cos(angle), np.sin(angle)]),
                max_speed=draw(st.floats(0.1, 2.0)),
                max_turn_rate=draw(st.floats(0.5, 4.0)),
                lidar=draw(st.sampled_from([None, Lidar(beams=36), Lidar(beams=8, range=10.0)])),
            )
        )
    return Fleet(robots=tuple(draw(st.lists(st.sampled_from(models), min_size=1, max_size=most_robots))))


@st.composite
def scenarios(draw: st.DrawFn, most_robots: int = 5) -> Scenario:
    """Starts and one task for each robot, within 10 m."""
    robots = draw(st.integers(1, most_robots))
    place = st.floats(0.0, 10.0)
    poses = st.tuples(place, place, st.one_of(st.just(float("nan")), st.floats(-3.0, 3.0)))
    tasks = tuple(Task(goals=np.array([draw(poses)])) for _ in range(robots))
    starts = draw(st.lists(poses, min_size=robots, max_size=robots))
    return Scenario(start=np.array(starts), start_level=np.zeros(robots, np.int16), tasks=tasks)
