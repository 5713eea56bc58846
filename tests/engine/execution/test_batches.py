"""Many executions at once take the times, bit for bit, that each of them takes alone."""

import attrs
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mrpbench_tests.instances.random_plans import random_plan, random_plan_with_resources
from mrpbench_tests.instances.roadmaps import two_way_grid

from mrpbench_core.api import BatchSession, DispatchError, DispatcherSession
from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.config.delays import Delays
from mrpbench_core.engine.execution.delays import DelayStream
from mrpbench_core.engine.execution.schedule import Schedule
from mrpbench_core.engine.execution.schedule_loop import ScheduleLoop
from mrpbench_core.engine.execution.worst_case import Adversary
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.model.execution.orders import BatchOrders
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.testing.drawing import build, path_through

DELAYS = st.builds(
    Delays,
    p_delay=st.sampled_from([0.0, 0.01, 0.1, 0.4]),
    max_delay=st.integers(1, 9),
    event_model=st.sampled_from(["bernoulli", "poisson"]),
    duration_model=st.sampled_from(["uniform", "gaussian"]),
    tick=st.sampled_from([0.5, 0.7, 1.0]),
    speed=st.sampled_from([0.0, 0.3]),
    worst_case=st.sampled_from([0, 5]),
)
DISPATCHERS = st.builds(Adg, lookahead=st.sampled_from([1, 2, 8]), group_margin=st.just(0.0))


def alone(schedule, delays, seed, draw, limit, adversary):
    """Arrival and waiting of one execution."""
    stream = DelayStream(delays, len(schedule.context.problem), Seeds(seed), (draw,), adversary)
    loop = ScheduleLoop(schedule, stream, limit)
    loop.run()
    return loop.arrival, loop.waiting


def require_equal(schedule, delays, seed, executions, limit):
    """Compare executions at once with each of them alone."""
    problem, attack = schedule.context.problem, delays.worst_case * delays.tick
    adversary = Adversary(problem, schedule.plan, attack) if attack else None
    session = schedule.batch(executions)
    draws = range(1, executions + 1)
    loop = ScheduleLoop(
        schedule, DelayStream(delays, len(problem), Seeds(seed), draws, adversary), limit, batch=session
    )
    loop.run()
    each = [alone(schedule, delays, seed, draw, limit, adversary) for draw in draws]
    for ours, theirs in zip((loop.arrival, loop.waiting), zip(*each, strict=True), strict=True):
        assert ours.tobytes() == np.concatenate(theirs).tobytes()


@settings(deadline=None, max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.integers(0, 2**32 - 1), DELAYS, DISPATCHERS, st.integers(1, 4), st.sampled_from([9.0, 3000.0]))
def test_executions_at_once_are_those_of_each_draw(context_of, seed, delays, dispatcher, executions, limit):
    problem, plan = random_plan(np.random.default_rng(seed))
    try:
        schedule = Schedule(context_of(problem, plan), dispatcher)
    except DispatchError:
        return
    require_equal(schedule, delays, seed, executions, limit)


@settings(deadline=None, max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.integers(0, 2**32 - 1), DELAYS, DISPATCHERS)
def test_rotations_at_once_are_those_of_each_draw(context_of, seed, delays, dispatcher):
    grid = two_way_grid(2, 3)
    routes = [(2, 1, 4), (4, 4, 3), (3, 3, 0), (0, 0, 1)]
    problem = build(grid, [route[0] for route in routes], [()] * 4)
    problem = attrs.evolve(problem, goals=tuple(((route[-1],),) for route in routes))
    plan = Plan(paths=tuple(path_through(grid, route) for route in routes))
    schedule = Schedule(context_of(problem, plan), dispatcher)
    require_equal(schedule, delays, seed, 3, 3000.0)


def test_plans_that_need_resources_or_profiles_of_speed_are_executed_one_by_one():
    random = np.random.default_rng(0)
    plans = [random_plan_with_resources(random) for _ in range(20)]
    sessions = [Adg().start(*plan) for plan in plans]
    assert any(session.graph.requests for session in sessions)
    for session in sessions:
        assert (session.batch(2) is None) == bool(session.graph.requests)
    assert Adg(speed_profiles=True).start(*random_plan(random)).batch(2) is None
    assert DispatcherSession.batch(sessions[0], 2) is None


@pytest.mark.parametrize(
    ("released", "in_step", "what"),
    [
        (lambda now, n: np.zeros((1, n)), [], "released of shape"),
        (lambda now, n: np.full((2, n), -1), [], "released less than before"),
        (lambda now, n: np.full((2, n), 1 - int(now > 0)), [], "released less than before"),
        (lambda now, n: np.full((2, n), 999), [], "released more segments than there are"),
        (lambda now, n: np.zeros((2, n)), [(0, 2, 0, 0)], "that do not exist"),
        (lambda now, n: np.zeros((2, n)), [(1, 0, 0, 0)], "that do not exist"),
    ],
)
def test_orders_that_break_the_contract_end_the_run(context_of, released, in_step, what):
    class Breaking(BatchSession):
        def update(self, now, seen):
            return BatchOrders(released=released(now, seen.shape[2]), in_step=in_step)

    plans = (random_plan(np.random.default_rng(seed)) for seed in range(99))
    problem, plan = next(found for found in plans if min(map(len, found[1].paths)) > 1)
    schedule = Schedule(context_of(problem, plan), Adg(group_margin=0.0))
    loop = ScheduleLoop(schedule, DelayStream(Delays(), len(problem), Seeds(0), (1, 2)), 99.0, batch=Breaking())
    with pytest.raises(BrokenContractError, match=what):
        loop.run()
