"""Plans drain under random delays, without deadlock, without conflict, and in the order of the plan."""

from collections import defaultdict
from importlib.metadata import entry_points
from itertools import combinations, pairwise

import attrs
import numpy as np
import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st
from mrpbench_tests.instances.random_plans import random_lanes, random_plan, random_starts, wander

from mrpbench_core.api import DispatchError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.engine.execution.commitments import commitments
from mrpbench_core.model.planning.plan import Budget, Plan
from mrpbench_core.model.planning.problem import Feature, Rules, features_of
from mrpbench_core.testing.execution.delayed_executor import DelayedExecutor
from mrpbench_core.testing.execution.drain import drain

SEEDS = st.integers(0, 2**32 - 1)


def released_under_delays(session, problem, plan, random):
    """The executor, after all robots have arrived."""
    executor = DelayedExecutor(problem, plan, random)
    drain(session, executor)
    assert executor.fault is None
    assert not executor.reordered
    return executor


def accepted(problem, plan, take):
    """The result of `take` for a plan, or None if it refuses the plan for a cycle that exists."""
    try:
        return take(problem, plan)
    except DispatchError as refusal:
        assert "wait for one another" in str(refusal) or " rotate, and robots " in str(refusal), refusal  # noqa: PT017
        assert cycle_in(problem, plan)
        return None


def cycle_in(problem, plan):
    """Tell, by a search of its own, whether moves wait for one another: at each vertex, who comes for who went."""
    after = defaultdict(set)
    visits = defaultdict(list)  # of each vertex: (arrival, move in, move out)
    for robot, path in enumerate(plan.paths):
        moves = [(robot, segment) for segment in np.flatnonzero(path.edge >= 0).tolist()]
        arrivals = [-1, *(int(path.leave[segment]) for _, segment in moves)]
        vertices = [int(problem.start[robot]), *(int(problem.roadmap.edges[path.edge[at], 1]) for _, at in moves)]
        for vertex, *visit in zip(vertices, arrivals, [None, *moves], [*moves, None], strict=True):
            visits[vertex].append(visit)
        for one, other in pairwise(moves):
            after[one].add(other)
    for here in visits.values():
        for (_, _, out), (_, into, _) in combinations(sorted(here, key=lambda visit: visit[0]), 2):
            if out is not None and into is not None and out[0] != into[0]:
                after[out].add(into)
    nodes = set(after) | {node for those in after.values() for node in those}
    while free := nodes - {node for one in nodes for node in after[one]}:
        nodes -= free
    return bool(nodes)


@settings(deadline=None, max_examples=40)
@given(SEEDS)
def test_plans_of_chance_drain(seed):
    random = np.random.default_rng(seed)
    problem, plan = random_plan(random)
    session = accepted(problem, plan, Adg().start)
    event(f"refused: {session is None}")
    if session is not None:
        executor = released_under_delays(session, problem, plan, random)
        event(f"rings: {executor.rings > 0}")


@settings(deadline=None, max_examples=40)
@given(SEEDS)
def test_plans_that_change_on_the_way_drain(seed):
    random = np.random.default_rng(seed)
    problem, plan = random_plan(random)

    def replan(released):
        now, due = late[-1], late[-1] + int(random.integers(0, 40))
        late.append(due)
        ready = now + random.integers(0, 5, len(problem))
        prefixes = commitments(problem, session.plan, released, executor.reached, ready, due)
        committed = attrs.evolve(problem, commitments=prefixes)
        assert check_plan(committed, Plan(paths=prefixes)).valid, "what was released conflicts once it is retimed"
        return committed, wander(committed, random, list(prefixes), ticks=5)

    problem = attrs.evolve(problem, rules=attrs.evolve(problem.rules, at_goal="stay"))
    if check_plan(problem, plan).valid and (session := accepted(problem, plan, Adg().start)) is not None:
        executor = DelayedExecutor(problem, plan, random)
        late = [int(random.integers(0, 40))]
        drain(session, executor, replans={int(step): replan for step in random.integers(0, 60, 3)})
        assert executor.fault is None
        assert not executor.reordered


@settings(deadline=None, max_examples=40)
@given(SEEDS)
@pytest.mark.parametrize("name", ["example", "prioritized", "cbs"])
def test_plans_of_planners_drain(name, seed):
    found = {point.name: point for point in entry_points(group="mrpbench.planners")}
    if name not in found:
        pytest.skip(f"no planner {name} is installed")
    try:
        planner = found[name].load()()
    except ImportError as error:
        pytest.skip(f"planner {name} cannot be imported: {error}")
    random = np.random.default_rng(seed)
    problem = random_starts(random, random_lanes(random))
    if name == "cbs" and len(problem) > 5:
        return
    goals = random.permutation(len(problem.roadmap.position))[: len(problem)]
    problem = attrs.evolve(problem, goals=tuple(((int(goal),),) for goal in goals), rules=Rules())
    for features in (features_of(problem), features_of(problem) | {Feature.FOOTPRINTS}):
        asked = attrs.evolve(problem, features=features)
        if planner.skip(asked) is None:
            result = planner.plan(asked, Budget(wall_s=0.2, memory_bytes=1 << 30))
            event(str(result.status))
            if result.plan is not None and (session := accepted(asked, result.plan, Adg().start)) is not None:
                released_under_delays(session, asked, result.plan, random)
