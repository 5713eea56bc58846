"""Plans through doors, lifts and mutexes drain under random delays, and nobody is let in too many.

A clerk of its own grants what is asked for, when chance will have it, and takes the key away for a while as a lift
does; the floor watches who is where.
"""

from importlib.metadata import entry_points

import attrs
import numpy as np
import pytest
from delayed_floor import Floor, draw_problem, draw_roadmap, squeeze, wander
from hypothesis import event, given, settings
from hypothesis import strategies as st

from mrpbench_core.api import DispatchError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.plan import Budget, Path
from mrpbench_core.model.problem import Rules, features_of
from mrpbench_core.model.roadmap import Resource

SEEDS = st.integers(0, 2**32 - 1)


class Clerk:
    """Hands out keys."""

    def __init__(self, problem, random):
        self.resources = {resource.name: resource for resource in problem.roadmap.resources}
        self.random = random
        self.held = {name: [] for name in self.resources}

    def take(self, requests):
        assert len(set(requests)) == len(requests)
        for name, holders in self.held.items():
            holders[:] = [robot for robot in holders if (robot, name) in requests]
        for robot, name in requests:
            holders = self.held[name]
            if robot not in holders:
                assert len(holders) < self.resources[name].capacity, "asked for before others had left"
                holders.append(robot)

    def granted(self, sure=False):
        pairs = [(robot, name) for name, holders in self.held.items() for robot in holders]
        return tuple(pair for pair in pairs if sure or self.random.random() < 0.3)


def watch(floor, clerk):
    """Who is in a resource holds it."""
    for robot, (route, path) in enumerate(zip(floor.routes, floor.plan.paths, strict=True)):
        at = int(floor.reached[robot])
        moving = floor.progress[robot] > 0
        if floor.gone(robot):
            continue
        for name, resource in clerk.resources.items():
            inside = path.edge[at] in resource.edges if moving else route[at] in resource.vertices
            if inside:
                assert robot in clerk.held[name], f"robot {robot} is in {name} without a key"


def drain(make, session, floor, clerk, replans=None):
    """Run until everybody has arrived."""
    replans = dict(replans or {})
    revision = 0
    for now in range(20_000):
        view = attrs.evolve(make.view(floor.reached, floor.cleared, revision), granted=clerk.granted())
        orders = session.update(float(now), view)
        clerk.take(orders.requests)
        alive = floor.step(now, orders.released)
        watch(floor, clerk)
        if now in replans:
            problem, plan = replans.pop(now)(orders.released)
            try:
                session.adopt(problem, plan)
            except DispatchError:
                continue
            floor.adopt(problem, plan)
            revision += 1
        elif floor.done and not replans:
            return
        elif not alive and not replans:
            for _ in range(3):
                view = attrs.evolve(make.view(floor.reached, floor.cleared, revision), granted=clerk.granted(sure=True))
                again = session.update(float(now), view)
                clerk.take(again.requests)
            assert (again.released > orders.released).any(), "deadlock"
    raise AssertionError("not done in 20,000 steps")


def draw_resources(random, problem):
    """Some parts of the roadmap as resources, with room for all who start in one."""
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


def accepted(problem, plan):
    """A session, or None where robots would wait for one another."""
    try:
        return Adg().start(problem, plan)
    except DispatchError as refusal:
        assert "wait for one another" in str(refusal) or "in a ring" in str(refusal)  # noqa: PT017
        return None


def draw_plan(make, random):
    problem = draw_resources(random, draw_problem(make, random, draw_roadmap(make, random)))
    # Who moves on after it seemed to have gone for good gets others into conflicts: chance could not mend that.
    problem = attrs.evolve(problem, rules=attrs.evolve(problem.rules, at_goal="stay"))
    paths = [make.path(problem.roadmap, [start]) for start in problem.start]
    return problem, squeeze(problem, random, wander(problem, random, paths, ticks=8))


@settings(deadline=None, max_examples=60)
@given(SEEDS)
def test_plans_of_chance_drain(make, seed):
    random = np.random.default_rng(seed)
    problem, plan = draw_plan(make, random)
    session = accepted(problem, plan)
    event(f"refused: {session is None}")
    if session is not None:
        drain(make, session, Floor(problem, plan, random), Clerk(problem, random))


@settings(deadline=None, max_examples=30)
@given(SEEDS)
def test_plans_that_change_on_the_way_drain(make, seed):
    random = np.random.default_rng(seed)
    problem, plan = draw_plan(make, random)
    problem = attrs.evolve(problem, rules=attrs.evolve(problem.rules, at_goal="stay"))
    if not check_plan(problem, plan).valid or (session := accepted(problem, plan)) is None:
        return

    def replan(released):
        prefixes = tuple(
            Path(edge=path.edge[:count], enter=path.enter[:count], leave=path.leave[:count])
            for path, count in zip(session.plan.paths, released, strict=True)
        )
        committed = attrs.evolve(problem, commitments=prefixes)
        return committed, wander(committed, random, list(prefixes), ticks=5)

    replans = {int(step): replan for step in random.integers(0, 60, 2)}
    drain(make, session, Floor(problem, plan, random), Clerk(problem, random), replans)


@settings(deadline=None, max_examples=60)
@given(SEEDS)
def test_plans_of_prioritized_drain(make, seed):
    found = {point.name: point for point in entry_points(group="mrpbench.planners")}
    if "prioritized" not in found:
        pytest.skip("no planner prioritized is installed")
    try:
        planner = found["prioritized"].load()()
    except ImportError as error:
        pytest.skip(f"cannot be imported: {error}")
    random = np.random.default_rng(seed)
    problem = draw_resources(random, draw_problem(make, random, draw_roadmap(make, random)))
    goals = random.permutation(len(problem.roadmap.position))[: len(problem)]
    problem = attrs.evolve(problem, goals=tuple(((int(goal),),) for goal in goals), rules=Rules())
    problem = attrs.evolve(problem, features=features_of(problem) | problem.features)
    assert planner.skip(problem) is None
    result = planner.plan(problem, Budget(wall_s=0.2, memory_bytes=1 << 30))
    event(str(result.status))
    if result.plan is not None:
        assert check_plan(problem, result.plan).valid
        if (session := accepted(problem, result.plan)) is not None:
            drain(make, session, Floor(problem, result.plan, random), Clerk(problem, random))
