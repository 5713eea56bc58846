"""Who keeps the plan that it was sent, when there is a new plan for all robots."""

import itertools

import numpy as np
import pytest
from mrpbench_live.rmf.traffic.composing import compose
from mrpbench_live.rmf.traffic.posting import Posted, blockers_of, waypoints_of

from mrpbench_core.api import Plan, Problem, Roadmap, RobotPath

WIDTH, HEIGHT = 6, 4
CELLS = [(x, y) for y in range(HEIGHT) for x in range(WIDTH)]
EDGES = [
    (CELLS.index((x, y)), CELLS.index((x + dx, y + dy)))
    for x, y in CELLS
    for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1))
    if (x + dx, y + dy) in CELLS
]
GRID = Roadmap(
    position=[(float(x), float(y)) for x, y in CELLS],
    level=[0] * len(CELLS),
    heading=np.full(len(CELLS), np.nan),
    edges=EDGES,
    duration=[[1] * len(EDGES)],
    tick=1.0,
)


def problem_of(starts):
    count = len(starts)
    return Problem(
        roadmap=GRID, profile=[0] * count, radius=[0.3] * count, start=starts, ready=[0] * count, goals=((),) * count
    )


def plan_of(visits):
    """A plan from the cells of each robot at each tick."""
    paths = []
    for cells in visits:
        steps = [-1 if a == b else EDGES.index((a, b)) for a, b in itertools.pairwise(cells)]
        paths.append(RobotPath(edge=steps, enter=np.arange(len(steps)), leave=np.arange(len(steps)) + 1))
    return Plan(paths=paths)


def wander(visits, ticks, draws):
    """Continue the cells of each robot: no robot enters a cell that another one is in, leaves or enters."""
    for _ in range(ticks):
        taken = {cells[-1] for cells in visits}
        for cells in visits:
            free = [head for tail, head in EDGES if tail == cells[-1] and head not in taken]
            step = int(draws.choice(free)) if free and draws.random() < 0.8 else cells[-1]
            taken.add(step)
            cells.append(step)
    return visits


def posted_of(composed, before):
    return {
        robot: before[robot] if robot in composed.kept else Posted((b"", 0, robot), None, way, composed.blockers[robot])
        for robot, way in enumerate(composed.waypoints)
    }


def first(problem, plan):
    """What is posted at first."""
    nothing = np.zeros(len(problem), np.int64)
    return posted_of(compose(problem, plan, nothing, nothing, nothing, {}), {})


def waits(problem, composed, reached):
    """What each robot still waits for at each place of its way, as places of the others' ways from their ends."""
    begun = [it.last(segments) for it, segments in zip(composed.waypoints, reached.tolist(), strict=True)]
    return [
        {
            (len(composed.waypoints[robot].vertex) - at, other, len(composed.waypoints[other].vertex) - until)
            for at, others in own.items()
            for other, until in others.items()
            if at >= begun[robot] and until > begun[other]
        }
        for robot, own in enumerate(composed.blockers)
    ]


@pytest.mark.parametrize("seed", range(30))
def test_kept_or_not_robots_wait_for_what_the_new_plan_says(seed):
    draws = np.random.default_rng(seed)
    robots = 6
    visits = wander([[int(cell)] for cell in draws.choice(len(CELLS), robots, replace=False)], 8, draws)
    problem = problem_of([cells[0] for cells in visits])
    before = first(problem, plan_of(visits))
    over = int(draws.integers(0, 6))  # all robots have come as far
    kept_cells = [cells[: over + 1] for cells in visits]
    again = wander([list(cells) for cells in kept_cells], 8 - over, draws) if seed % 3 else visits
    if seed % 3 == 1:  # some go on as they did
        stay = set(draws.choice(robots, 3, replace=False).tolist())
        again = [visits[robot] if robot in stay else kept_cells[robot] for robot in range(robots)]
    plan = plan_of(again)
    reached = np.full(robots, over)
    reached = np.minimum(reached, [len(path.edge) for path in plan.paths])
    composed = compose(problem, plan, reached, reached, reached, before)
    fresh = waypoints_of(problem, plan, reached)
    alone = compose(problem, plan, reached, reached, reached, {})
    assert not alone.kept
    assert alone.blockers == blockers_of(problem, plan, fresh, reached, reached)
    assert waits(problem, composed, reached) == waits(problem, alone, reached)
    for robot, way in enumerate(composed.waypoints):
        assert way.vertex[way.last(reached[robot]) :].tolist() == fresh[robot].vertex.tolist()
        assert [way.last(it) for it in fresh[robot].segments] == [
            len(way.vertex) - len(fresh[robot].vertex) + at for at in range(len(fresh[robot].vertex))
        ]
    for robot in composed.kept:  # blockers that it has not passed are plans that are still there
        begun = before[robot].waypoints.last(over)
        assert composed.blockers[robot] is before[robot].blockers
        assert {other for at, others in before[robot].blockers.items() if at >= begun for other in others} <= set(
            composed.kept
        )
    if not seed % 3:
        assert len(composed.kept) == robots


def row(y, *xs):
    return [CELLS.index((x, y)) for x in xs]


def test_who_waits_for_a_robot_with_another_way_gets_another_plan():
    # 0 drives along the first row; 1 comes into it behind 0, 2 behind 1; 3 drives alone in the last row
    visits = [
        row(0, 0, 1, 2, 3, 4, 5),
        [*row(1, 0, 0), *row(1, 0), *row(0, 0, 1, 2)],
        [*row(2, 0, 0, 0, 0), *row(1, 0), *row(0, 0)],
        row(3, 0, 1, 2, 3, 4, 5),
    ]
    problem = problem_of([cells[0] for cells in visits])
    before = first(problem, plan_of(visits))
    assert before[1].blockers
    assert before[2].blockers
    other = [[*row(0, 0, 1, 2, 3), CELLS.index((3, 1)), CELLS.index((3, 2))], *visits[1:]]
    nothing = np.zeros(4, np.int64)
    assert set(compose(problem, plan_of(other), nothing, nothing, nothing, before).kept) == {3}
    last = [*visits[:2], [*row(2, 0, 0, 0, 0), *row(1, 0, 1)], visits[3]]
    assert set(compose(problem, plan_of(last), nothing, nothing, nothing, before).kept) == {0, 1, 3}
    assert not compose(problem, plan_of(visits), nothing, nothing, nothing, {}).kept
