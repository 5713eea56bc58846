"""Plans drain under `btpg`, and whichever way its open orders are decided, no robots wait in a cycle."""

import numpy as np
import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st
from mrpbench_dispatchers_reordering import Btpg, btpg
from mrpbench_dispatchers_reordering.visits import NONE

from mrpbench_core.api import DispatchError
from mrpbench_core.checking.strong_components import strong_components
from mrpbench_core.testing.execution.drawn_executions import drained
from mrpbench_core.testing.instances.random_plans import random_plan, random_plan_with_resources
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


@settings(deadline=None, max_examples=12)
@given(SEEDS, st.booleans(), st.sampled_from([0, 3]))
def test_drawn_plans_drain(seed, resources, replans):
    ended = drained(Btpg(lookahead=1), seed, resources, replans)
    event(f"reordered: {ended and ended.reordered}")


def test_an_execution_repeats_bit_by_bit():
    for seed in range(4):
        assert drained(Btpg(lookahead=1), seed) == drained(Btpg(lookahead=1), seed)
