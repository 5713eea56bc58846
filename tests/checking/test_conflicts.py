"""Every rule of `mrpbench_core.model.planning.conflicts`, by hand and against a simulation in half ticks."""

from itertools import combinations

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.checking.conflicts import Conflict, find_conflicts
from mrpbench_core.model.planning.plan import Plan, RobotPath
from mrpbench_core.model.planning.problem import Feature, Rules

FORBIDDEN = Rules(following="forbidden")
FOOTPRINTS = frozenset({Feature.FOOTPRINTS})


@pytest.fixture(scope="module")
def conflicts(make):
    """The conflicts of robots that go these routes, each a start and the steps of `make.path`."""

    def find(roadmap, *routes, **fields):
        problem = make.problem(roadmap, [route[0] for route in routes], **fields)
        plan = Plan(paths=tuple(make.path(roadmap, *route[1:]) for route in routes))
        return find_conflicts(problem, plan, 100)

    return find


def kinds(found):
    return [conflict.kind for conflict in found]


def test_two_robots_that_arrive_at_one_vertex_conflict(make, conflicts):
    found = conflicts(make.grid(1, 3), (0, (0, 1, 1)), (2, (2, 1, 1)))
    assert found == [Conflict("vertex", (0, 1), (1, 1), 1)]
    assert str(found[0]) == "vertex conflict of robots 0 and 1 at vertex 1, tick 1"


@pytest.mark.parametrize("late", [0, 2**62])
def test_robots_meet_however_late_it_is(make, conflicts, late):
    found = conflicts(make.grid(1, 3), (0, (0, 0, late), (0, 1, late + 1)), (2, (2, 2, late + 1), (2, 1, late + 2)))
    assert found == [Conflict("vertex", (0, 1), (1, 1), late + 2)]


def test_a_robot_that_stays_at_its_goal_is_in_the_way_forever(make, conflicts):
    lane = make.grid(1, 3)
    assert conflicts(lane, (1,), (0, (0, 0, 7), (0, 1, 8), (1, 2, 9))) == [Conflict("vertex", (0, 1), (1, 1), 8)]
    assert not conflicts(lane, (1,), (0, (0, 0, 7), (0, 1, 8), (1, 2, 9)), rules=Rules(at_goal="disappear"))


def test_standing_times_are_closed(make, conflicts):
    """One robot may not arrive in the tick in which another departs: it would be there too."""
    cross = make.grid(3, 3, ticks=2)
    leaves_at_two = (4, (4, 4, 2), (4, 5, 4))
    assert conflicts(cross, leaves_at_two, (1, (1, 4, 2))) == [Conflict("vertex", (0, 1), (4, 4), 2)]
    assert not conflicts(cross, leaves_at_two, (1, (1, 1, 1), (1, 4, 3)))


def test_following_is_allowed_unless_forbidden(make, conflicts):
    train = make.grid(1, 4), (0, (0, 1, 1), (1, 2, 2)), (1, (1, 2, 1), (2, 3, 2))
    assert not conflicts(*train)
    assert conflicts(*train, rules=FORBIDDEN) == [
        Conflict("following", (0, 1), (0, 1), 0),
        Conflict("following", (0, 1), (1, 2), 1),
    ]
    apart = make.grid(1, 4), (0, (0, 0, 1), (0, 1, 2)), (1, (1, 2, 1))
    assert not conflicts(*apart, rules=FORBIDDEN)


def test_following_on_one_long_edge(make, conflicts):
    slow = make.grid(1, 3, ticks=3)
    behind = slow, (1, (1, 2, 3)), (0, (0, 0, 1), (0, 1, 4), (1, 1, 5))
    assert kinds(conflicts(*behind, rules=FORBIDDEN)) == ["following"]
    one_edge = attrs.evolve(make.grid(1, 3), duration=[[1, 1, 4, 4]])
    pair = one_edge, (1, (1, 2, 4), (2, 2, 4)), (0, (0, 1, 1), (1, 2, 6))
    assert "following" in kinds(conflicts(*pair, rules=FORBIDDEN))
    assert kinds(conflicts(*pair)) == ["vertex"]  # only since the first stays at its end


def test_robots_swap_nowhere(make, conflicts):
    found = conflicts(make.grid(1, 2), (0, (0, 1, 1)), (1, (1, 0, 1)))
    assert found == [Conflict("swap", (0, 1), (0, 1), 0)]
    assert str(found[0]) == "swap conflict of robots 0 and 1 at edge 0-1, tick 0"
    late = conflicts(make.grid(1, 2, ticks=5), (0, (0, 1, 5)), (1, (1, 1, 4), (1, 0, 9)))
    assert kinds(late) == ["swap"]


def test_overtaking_on_an_edge_is_a_conflict(make, conflicts):
    lane = make.grid(1, 5)
    first = (1, (1, 2, 6), (2, 2, 8), (2, 3, 9))
    assert kinds(conflicts(lane, first, (0, (0, 1, 1), (1, 2, 4), (2, 3, 5), (3, 4, 6)))) == ["overtaking"]
    assert kinds(conflicts(lane, first, (0, (0, 1, 1), (1, 2, 10)))) == []


def test_a_ring_may_turn_at_once(make, conflicts):
    square = make.grid(2, 2)
    ring = (0, (0, 1, 1)), (1, (1, 3, 1)), (3, (3, 2, 1)), (2, (2, 0, 1))
    assert not conflicts(square, *ring)
    assert kinds(conflicts(square, *ring, rules=FORBIDDEN)) == ["following"] * 4
    assert set(kinds(conflicts(square, *ring, features=FOOTPRINTS))) == {"footprint"}


def test_footprints_on_lanes_that_come_close(make, conflicts):
    parallel = make.roadmap([(0, 0), (4, 0), (0, 1), (4, 1)], [(0, 1), (2, 3)], ticks=4)
    both = (0, (0, 1, 4)), (2, (2, 3, 4))
    assert not conflicts(parallel, *both, features=FOOTPRINTS, radius=0.5)  # exactly two radii apart
    assert not conflicts(parallel, *both, features=FOOTPRINTS, radius=[0.3, 0.7])
    assert kinds(conflicts(parallel, *both, features=FOOTPRINTS, radius=[0.4, 0.7])) == ["footprint"] * 3
    assert not conflicts(parallel, *both, radius=2.0)  # the problem does not exclude them
    other_floor = attrs.evolve(parallel, level=[0, 0, 1, 1])
    assert not conflicts(other_floor, *both, features=FOOTPRINTS, radius=2.0)


def test_footprints_on_lanes_that_cross_between_their_ends(make, conflicts):
    cross = make.roadmap([(-1, 0), (1, 0), (0, -1), (0, 1)], [(0, 1), (2, 3)], ticks=2)
    assert conflicts(cross, (0, (0, 1, 2)), (2, (2, 2, 1), (2, 3, 3)), features=FOOTPRINTS) == [
        Conflict("footprint", (0, 1), (0, 1), 1)
    ]
    assert not conflicts(cross, (0, (0, 1, 2)), (2, (2, 2, 2), (2, 3, 4)), features=FOOTPRINTS)
    assert not conflicts(cross, (0, (0, 1, 2)), (2, (2, 2, 1), (2, 3, 3)))


def test_a_robot_that_only_passes_a_vertex_is_there_at_that_tick(make, conflicts):
    """At tick 2 one is at the corner, the other in the middle of a lane that runs close by."""
    points = [(0, 0), (2, 0), (2, -2), (2.2, 0.3), (2.2, -1.7)]
    near = make.roadmap(points, [(0, 1), (1, 2), (3, 4)], ticks=2)
    found = conflicts(near, (0, (0, 1, 2), (1, 2, 4)), (3, (3, 3, 1), (3, 4, 3)), features=FOOTPRINTS, radius=0.12)
    assert Conflict("footprint", (0, 1), (1, 1), 2) in found


def in_half_ticks(problem, plan, end):
    """The element of each robot in each half tick: (vertex, vertex), (tail, head) of an edge, or None after its end."""
    table = []
    for robot, path in enumerate(plan.paths):
        at = int(problem.start[robot])
        doing = [(at, at)]
        for edge, enter, leave in zip(path.edge.tolist(), path.enter.tolist(), path.leave.tolist(), strict=True):
            if leave == enter:
                continue
            ends = (at, at) if edge < 0 else tuple(problem.roadmap.edges[edge].tolist())
            at = ends[1]
            doing += [ends] * (2 * (leave - enter) - 1) + [(at, at)]
        rest = (at, at) if problem.rules.at_goal == "stay" else None
        table.append(doing + [rest] * (2 * end + 1 - len(doing)))
    return table


def simulated(problem, plan, end):
    """(kind, robots) of all conflicts: a simulation with nothing of the validator's."""
    found = set()
    table = in_half_ticks(problem, plan, end)
    position = problem.roadmap.position
    for one, other in combinations(range(len(problem)), 2):
        pair = list(zip(table[one], table[other], strict=True))
        reach = problem.radius[one] + problem.radius[other]
        for half, (a, b) in enumerate(pair):
            if a is None or b is None:
                continue
            moving = (a[0] != a[1]) + (b[0] != b[1])
            same = a == b
            if same and not moving:
                found.add(("vertex", one, other))
            if moving == 2:
                if a == b[::-1]:
                    found.add(("swap", one, other))
                elif same:
                    begins, ends = ([run(half, [p[who] for p in pair])[side] for who in (0, 1)] for side in (0, 1))
                    orderly = (begins[0] - begins[1]) * (ends[0] - ends[1]) > 0
                    if not orderly:
                        found.add(("overtaking", one, other))
                    elif problem.rules.following == "forbidden":
                        found.add(("following", one, other))
                elif problem.rules.following == "forbidden" and (a[1] == b[0] or a[0] == b[1]):
                    found.add(("following", one, other))
            if Feature.FOOTPRINTS in problem.features and not (same and not moving):
                # Lanes of a grid are nearest to one another at an end of one of them.
                gap = min(np.hypot(*(position[p] - position[q])) for p in a for q in b)
                if gap < reach - 1e-9:
                    found.add(("footprint", one, other))
    return found


def run(half, doing):
    """First and last half tick of what a robot does at `half` without a break."""
    first = last = half
    while first > 0 and doing[first - 1] == doing[half]:
        first -= 1
    while last < len(doing) - 1 and doing[last + 1] == doing[half]:
        last += 1
    return first, last


@settings(deadline=None, max_examples=400)
@given(st.integers(0, 2**32 - 1))
def test_the_validator_agrees_with_a_simulation(make, seed):
    random = np.random.default_rng(seed)
    roadmap = make.grid(2, 3)
    robots = int(random.integers(2, 5))
    starts = random.permutation(6)[:robots]
    paths = []
    for start in starts.tolist():
        at, edge, leave = start, [], []
        for _ in range(random.integers(0, 6)):
            ways = np.flatnonzero(roadmap.edges[:, 0] == at)
            take = int(random.choice(ways)) if random.random() < 0.6 else -1
            lasts = int(random.integers(take >= 0, 4))
            edge.append(take)
            leave.append(lasts + (leave[-1] if leave else 0))
            at = at if take < 0 else int(roadmap.edges[take, 1])
        paths.append(RobotPath(edge=edge, enter=[0, *leave][: len(leave)], leave=leave))
    plan = Plan(paths=tuple(paths))
    rules = Rules(
        following=str(random.choice(["allowed", "forbidden"])), at_goal=str(random.choice(["stay", "disappear"]))
    )
    radius = random.choice([0.1, 0.4, 0.6, 0.75], robots)
    features = FOOTPRINTS if random.random() < 0.5 else frozenset()
    problem = make.problem(roadmap, starts, features=features, rules=rules, radius=radius)
    found = {(conflict.kind, *conflict.robots) for conflict in find_conflicts(problem, plan, 10_000)}
    assert found == simulated(problem, plan, end=max((path.leave[-1] for path in paths if len(path)), default=0) + 1)
