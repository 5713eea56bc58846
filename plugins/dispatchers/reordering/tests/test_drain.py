"""Plans drain under random delays in a changed order: no robot waits forever, and robots keep apart."""

import attrs
import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st
from mrpbench_dispatchers_reordering import Btpg, Gses, Sadg, searching
from mrpbench_tests.execution.drawn_executions import drained

from mrpbench_core.builtin.dispatchers.adg import Adg

SEEDS = st.integers(0, 2**32 - 1)
EAGER = Gses(period=0, lateness=0, gain=0.001, lookahead=1)
"""Searches as often as possible."""


@pytest.fixture(autouse=True)
def no_order_is_refused(monkeypatch):
    """Fail where the search has found an order with a cycle: the session would go on in the old order."""
    put_next = searching.SearchingSession.put_next

    def checked(self, moves):
        assert put_next(self, moves), "the order found is refused"
        return True

    monkeypatch.setattr(searching.SearchingSession, "put_next", checked)


@settings(deadline=None, max_examples=12)
@given(SEEDS)
@pytest.mark.parametrize("dispatcher", [Gses(), EAGER])
def test_plans_of_chance_drain(dispatcher, seed):
    ended = drained(dispatcher, seed)
    event(f"reordered: {ended and ended.reordered}")


@settings(deadline=None, max_examples=12)
@given(SEEDS)
def test_plans_through_resources_drain(seed):
    ended = drained(EAGER, seed, resources=True)
    event(f"reordered: {ended and ended.reordered}")


@settings(deadline=None, max_examples=12)
@given(SEEDS)
@pytest.mark.parametrize("resources", [False, True])
def test_plans_that_change_on_the_way_drain(resources, seed):
    ended = drained(EAGER, seed, resources, replans=3)
    event(f"reordered: {ended and ended.reordered}")


@settings(deadline=None, max_examples=12)
@given(SEEDS, st.booleans(), st.sampled_from([0, 3]), st.sampled_from([EAGER, Btpg(lookahead=1)]))
def test_speed_profiles_change_nothing_of_what_is_released(seed, resources, replans, dispatcher):
    slowed = attrs.evolve(dispatcher, speed_profiles=True)
    assert drained(slowed, seed, resources, replans) == drained(dispatcher, seed, resources, replans)


@settings(deadline=None, max_examples=5)
@given(SEEDS)
@pytest.mark.parametrize("resources", [False, True])
def test_plans_drain_in_orders_of_another_solver(resources, seed):
    sadg = Sadg(period=5, gain=0.001, lookahead=1, max_deterministic_time=0.05)
    ended = drained(sadg, seed, resources, replans=1)
    event(f"reordered: {ended and ended.reordered}")


def test_orders_change_and_robots_arrive_earlier_than_in_the_order_of_the_plan():
    pairs = [
        (kept, changed) for seed in range(25) if (kept := drained(Adg(), seed)) and (changed := drained(Gses(), seed))
    ]
    assert not any(kept.reordered for kept, _ in pairs)
    assert sum(changed.reordered for _, changed in pairs) >= 3
    assert sum(changed.sum_of_arrivals for _, changed in pairs) < sum(kept.sum_of_arrivals for kept, _ in pairs)


def test_an_execution_repeats_bit_by_bit_where_the_search_is_cut_short():
    for seed in range(4):
        dispatcher = Gses(period=0, lateness=0, gain=0.001, work_limit=10 * seed)
        assert drained(dispatcher, seed) == drained(dispatcher, seed)
