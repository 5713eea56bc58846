"""Plans through doors, lifts and mutexes drain under random delays, and robots hold the resources that they are in."""

from importlib.metadata import entry_points

import attrs
import numpy as np
import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st
from mrpbench_tests.instances.random_plans import (
    random_lanes,
    random_plan_with_resources,
    random_starts,
    wander,
    with_random_resources,
)

from mrpbench_core.api import DispatchError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.planning.plan import Budget, RobotPath
from mrpbench_core.model.planning.problem import Rules, features_of
from mrpbench_core.testing.execution.delayed_executor import DelayedExecutor
from mrpbench_core.testing.execution.drain import drain
from mrpbench_core.testing.execution.resource_manager import ResourceManager

SEEDS = st.integers(0, 2**32 - 1)


def released_under_delays(session, problem, plan, random, replans=None):
    """Drain a plan, without conflict and without robots in resources that they do not hold."""
    executor, manager = DelayedExecutor(problem, plan, random), ResourceManager(problem, random)
    drain(session, executor, manager, replans)
    assert executor.fault is None
    assert not executor.reordered
    assert manager.fault is None


def accepted(problem, plan):
    """A session, or None where robots would wait for one another."""
    try:
        return Adg().start(problem, plan)
    except DispatchError as refusal:
        assert "wait for one another" in str(refusal) or " rotate" in str(refusal)  # noqa: PT017
        return None


@settings(deadline=None, max_examples=30)
@given(SEEDS)
def test_plans_of_chance_drain(seed):
    random = np.random.default_rng(seed)
    problem, plan = random_plan_with_resources(random)
    session = accepted(problem, plan)
    event(f"refused: {session is None}")
    if session is not None:
        released_under_delays(session, problem, plan, random)


@settings(deadline=None, max_examples=30)
@given(SEEDS)
def test_plans_that_change_on_the_way_drain(seed):
    random = np.random.default_rng(seed)
    problem, plan = random_plan_with_resources(random)
    problem = attrs.evolve(problem, rules=attrs.evolve(problem.rules, at_goal="stay"))
    if not check_plan(problem, plan).valid or (session := accepted(problem, plan)) is None:
        return

    def replan(released):
        prefixes = tuple(
            RobotPath(edge=path.edge[:count], enter=path.enter[:count], leave=path.leave[:count])
            for path, count in zip(session.plan.paths, released, strict=True)
        )
        committed = attrs.evolve(problem, commitments=prefixes)
        return committed, wander(committed, random, list(prefixes), ticks=5)

    replans = {int(step): replan for step in random.integers(0, 60, 2)}
    released_under_delays(session, problem, plan, random, replans)


@settings(deadline=None, max_examples=30)
@given(SEEDS)
def test_plans_of_prioritized_drain(seed):
    found = {point.name: point for point in entry_points(group="mrpbench.planners")}
    if "prioritized" not in found:
        pytest.skip("no planner prioritized is installed")
    try:
        planner = found["prioritized"].load()()
    except ImportError as error:
        pytest.skip(f"cannot be imported: {error}")
    random = np.random.default_rng(seed)
    problem = with_random_resources(random, random_starts(random, random_lanes(random)))
    goals = random.permutation(len(problem.roadmap.position))[: len(problem)]
    problem = attrs.evolve(problem, goals=tuple(((int(goal),),) for goal in goals), rules=Rules())
    problem = attrs.evolve(problem, features=features_of(problem) | problem.features)
    assert planner.skip(problem) is None
    result = planner.plan(problem, Budget(wall_s=0.2, memory_bytes=1 << 30))
    event(str(result.status))
    if result.plan is not None:
        assert check_plan(problem, result.plan).valid
        if (session := accepted(problem, result.plan)) is not None:
            released_under_delays(session, problem, result.plan, random)
