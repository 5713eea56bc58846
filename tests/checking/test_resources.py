"""Rule 6 of `mrpbench_core.model.planning.conflicts`, by hand and against a count in half ticks."""

import attrs
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.checking.conflicts import Conflict, find_conflicts
from mrpbench_core.model.planning.plan import Plan, RobotPath
from mrpbench_core.model.planning.roadmap import Resource


def found(make, roadmap, resource, *routes):
    """Conflicts of rule 6 of robots that go these routes, each a start and the steps of `make.path`."""
    roadmap = attrs.evolve(roadmap, resources=(resource,))
    problem = make.problem(roadmap, [route[0] for route in routes])
    plan = Plan(paths=tuple(make.path(roadmap, *route[1:]) for route in routes))
    return [conflict for conflict in find_conflicts(problem, plan) if conflict.kind == "resource"]


def through(make, robot_two_enters):
    """Two robots along two lanes of a 2 by 3 grid, whose middle edges are one resource."""
    grid = make.grid(2, 3)
    middle = [edge for edge, ends in enumerate(grid.edges.tolist()) if ends in ([1, 2], [4, 5])]
    wait = () if robot_two_enters == 1 else ((4, 4, robot_two_enters),)
    routes = (0, (0, 1, 1), (1, 2, 2)), (3, (3, 4, 1), *wait, (4, 5, robot_two_enters + 1))
    return grid, middle, routes


def test_one_robot_at_a_time(make):
    grid, middle, routes = through(make, 1)
    door = Resource(name="door", kind="mutex", edges=tuple(middle))
    assert found(make, grid, door, *routes) == [Conflict("resource", (0, 1), (1, 2), 1)]
    assert not found(make, grid, attrs.evolve(door, capacity=2), *routes)


def test_the_next_waits_for_the_setup(make):
    for enters, setup, fine in ((2, 0, True), (2, 1, False), (3, 1, True), (6, 5, False), (7, 5, True)):
        grid, middle, routes = through(make, enters)
        door = Resource(name="door", kind="door", edges=tuple(middle), setup_ticks=setup)
        assert (not found(make, grid, door, *routes)) == fine, (enters, setup)


def test_a_robot_may_come_back_without_setup(make):
    line = make.grid(1, 3)
    door = Resource(name="door", kind="door", vertices=(1,), setup_ticks=9)
    assert not found(make, line, door, (0, (0, 1, 1), (1, 2, 2), (2, 1, 3), (1, 0, 4)))


def test_a_robot_that_ends_in_a_resource_uses_it_forever(make):
    line = make.grid(1, 5)
    lift = Resource(name="lift", kind="lift", vertices=(0, 1, 3))
    assert found(make, line, lift, (0, (0, 1, 1)), (4, (4, 4, 90), (4, 3, 91)))


@settings(deadline=None, max_examples=300)
@given(st.integers(0, 2**32 - 1))
def test_the_validator_agrees_with_a_count(make, seed):
    random = np.random.default_rng(seed)
    grid = make.grid(2, 3)
    resource = Resource(
        name="some",
        kind="mutex",
        capacity=int(random.integers(1, 4)),
        vertices=tuple(np.flatnonzero(random.random(6) < 0.3).tolist()),
        edges=tuple(np.flatnonzero(random.random(len(grid.edges)) < 0.4).tolist()),
        setup_ticks=int(random.integers(0, 4)),
    )
    roadmap = attrs.evolve(grid, resources=(resource,))
    robots = int(random.integers(2, 6))
    starts = random.permutation(6)[:robots]
    paths = [wander(random, grid, start) for start in starts.tolist()]
    problem, plan = make.problem(roadmap, starts), Plan(paths=tuple(paths))
    end = 2 * max((int(path.leave[-1]) for path in paths if len(path)), default=0) + 20
    uses = np.array([in_use(grid, resource, int(start), path, end) for start, path in zip(starts, paths, strict=True)])
    crowded = (uses.sum(axis=0) > resource.capacity).any()
    kinds = {conflict.kind for conflict in find_conflicts(problem, plan)}
    assert ("resource" in kinds) == crowded


def wander(random, grid, at):
    edge, leave = [], []
    for _ in range(random.integers(0, 6)):
        take = int(random.choice(np.flatnonzero(grid.edges[:, 0] == at))) if random.random() < 0.6 else -1
        edge.append(take)
        leave.append(int(random.integers(take >= 0, 4)) + (leave[-1] if leave else 0))
        at = at if take < 0 else int(grid.edges[take, 1])
    return RobotPath(edge=edge, enter=[0, *leave][: len(leave)], leave=leave)


def in_use(grid, resource, at, path, end):
    """Tell whether a robot uses the resource in each half tick: even ones are instants, odd ones the time between."""
    doing = []
    for edge, enter, leave in zip(path.edge.tolist(), path.enter.tolist(), path.leave.tolist(), strict=True):
        standing = at in resource.vertices
        doing += [standing] + [edge in resource.edges if edge >= 0 else standing] * max(0, 2 * (leave - enter) - 1)
        if leave == enter:
            doing.pop()
        at = at if edge < 0 else int(grid.edges[edge, 1])
    doing += [at in resource.vertices] * (end - len(doing))
    setup = 2 * resource.setup_ticks
    return [any(doing[max(0, half - setup) : half + 1]) for half in range(end)]
