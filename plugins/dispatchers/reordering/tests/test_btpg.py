"""Plans drain under `btpg`, and whichever way its open orders are decided, no robots wait in a cycle."""

import numpy as np
import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st
from mrpbench_dispatchers_reordering import Btpg, btpg
from mrpbench_dispatchers_reordering.visits import NONE
from mrpbench_tests.execution.drawn_executions import drained
from mrpbench_tests.instances.random_plans import random_plan, random_plan_with_resources
from mrpbench_tests.instances.roadmaps import two_way

from mrpbench_core.api import DispatchError
from mrpbench_core.checking.strong_components import strong_components
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.testing.drawing import build, path_through, timed_path
from mrpbench_core.testing.execution.delayed_executor import DelayedExecutor
from mrpbench_core.testing.execution.drain import drain
from mrpbench_core.testing.suites.dispatcher import DispatcherConformance

SEEDS = st.integers(0, 2**32 - 1)


class TestBtpg(DispatcherConformance):
    keeps_apart = True

    def make(self):
        return Btpg()


@pytest.fixture(autouse=True)
def no_order_is_refused(monkeypatch):
    """Fail where an open order has a cycle: the session would go on in the old order."""
    put_next = btpg.BtpgSession.put_next

    def checked(self, moves):
        assert put_next(self, moves), "an open order is refused"
        return True

    monkeypatch.setattr(btpg.BtpgSession, "put_next", checked)


@settings(deadline=None, max_examples=25)
@given(SEEDS, st.booleans())
def test_every_choice_of_open_orders_is_without_cycles(seed, resources):
    random = np.random.default_rng(seed)
    problem, plan = (random_plan_with_resources if resources else random_plan)(random)
    try:
        session = Btpg().start(problem, plan)
    except DispatchError:
        return
    groups = np.unique(session.group[session.group != NONE])
    event(f"open: {min(len(groups), 5)}")
    graph, visits, (first, second) = session.graph, session.visits, session.pairs
    along = np.flatnonzero(np.diff(graph.moves.robot) == 0)
    for _ in range(6):
        switched = np.isin(session.group, groups[random.random(len(groups)) < 0.5])
        one, other = np.where(switched, second, first), np.where(switched, first, second)
        before, after = visits.end[one], visits.begin[other]
        some = (before != NONE) & (after != NONE)
        before = np.concatenate([before[some], graph.resources.before, along])
        after = np.concatenate([after[some], graph.resources.after, along + 1])
        assert strong_components(before.tolist(), after.tolist()) == list(graph.rotations.values())


@settings(deadline=None, max_examples=25)
@given(SEEDS, st.integers(0, 12))
def test_the_groups_of_the_earliest_visits_are_tried_first(seed, limit):
    problem, plan = random_plan(np.random.default_rng(seed))
    try:
        sessions = [Btpg(group_limit=it).start(problem, plan) for it in (limit, 10_000)]
    except DispatchError:
        return
    visits, (first, _) = sessions[1].visits, sessions[1].pairs
    some, every = (session.group for session in sessions)
    if not limit:
        assert not len(some)
        return
    least = {group: visits.arrival[first[every == group]].min() for group in np.unique(every[every != NONE])}
    tried = {group for group in least if (some[every == group] != NONE).any()}
    event(f"left out: {min(len(least) - len(tried), 3)}")
    assert ((some != NONE) == np.isin(every, list(tried))).all()
    assert max((least[group] for group in tried), default=0) <= min(
        (least[group] for group in least.keys() - tried), default=np.inf
    )


def later(path, ticks):
    """The same path after a wait."""
    return timed_path([-1, *path.edge], [0, *path.enter + ticks], [ticks, *path.leave + ticks]) if ticks else path


@pytest.mark.parametrize(("gain", "first_goes"), [(0.001, False), (-np.inf, True)])
def test_a_robot_that_comes_early_lets_another_pass_for_which_three_wait_unless_the_first_always_goes(gain, first_goes):
    """Robot 0 drives along an aisle, vertices 4 to 15, and past the goals of three others; robot 1 is at its end."""
    points = [(x, 0) for x in range(17)] + [(15, y) for y in range(1, 5)] + [(16, y) for y in range(1, 4)] + [(4, 1)]
    lanes = [(x, x + 1) for x in range(16)] + [(15, 17), (17, 18), (18, 19), (19, 20)]
    aisle = two_way(points, [*lanes, (21, 17), (22, 18), (23, 19), (4, 24)])
    routes = [[*range(16), 17, 18, 19, 20], [*range(16, 3, -1), 24], *([21 + k, 17 + k] for k in range(3))]
    plan = Plan(paths=tuple(later(path_through(aisle, route), 21 * bool(k)) for k, route in enumerate(routes)))
    problem = build(aisle, [route[0] for route in routes], [(route[-1],) for route in routes])
    executor = DelayedExecutor(problem, plan)
    drain(Btpg(gain=gain, lookahead=1).start(problem, plan), executor)
    assert executor.fault is None
    assert executor.reordered == first_goes


@settings(deadline=None, max_examples=12)
@given(SEEDS, st.booleans(), st.sampled_from([0, 3]))
def test_drawn_plans_drain(seed, resources, replans):
    ended = drained(Btpg(lookahead=1), seed, resources, replans)
    event(f"reordered: {ended and ended.reordered}")


def test_an_execution_repeats_bit_by_bit():
    for seed in range(4):
        assert drained(Btpg(lookahead=1), seed) == drained(Btpg(lookahead=1), seed)
