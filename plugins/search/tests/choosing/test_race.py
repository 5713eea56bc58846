"""Races of candidates whose outcomes are drawn from known distributions."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_search.choosing.looks import Looks, plan_looks, shared_level
from mrpbench_search.choosing.race import Outcomes, Race, Standing
from scipy.stats import binom

SEEDS = 54


def run(success, values, margin=0.02, level=0.05):
    """Run a race on f8[candidates, seeds] to its end."""
    looks = plan_looks(success.shape[1], len(success), level)
    race = Race(candidates=len(success), looks=looks, margin=margin)
    while (wanted := race.wanted)[0]:
        chosen = np.full(success.shape, np.nan)
        chosen[wanted[0], : wanted[1]] = success[wanted[0], : wanted[1]]
        race.judge(Outcomes(success=chosen, values=np.where(chosen == 1, values, np.nan)))
    return race


def drawn(rng, candidates, spread=0.1):
    """Durations of equal candidates on the same scenarios."""
    return rng.gamma(9, 10, SEEDS) * np.exp(spread * rng.normal(size=(candidates, SEEDS)))


def test_equal_candidates_are_dropped_in_fewer_races_than_the_error():
    races = [run(np.ones((2, SEEDS)), drawn(np.random.default_rng(seed), 2)) for seed in range(60)]
    dropped = sum(bool(race.dropped) for race in races)
    assert dropped <= binom.ppf(0.999, len(races), 0.05)


def test_equal_success_rates_drop_nobody_more_often_than_the_error():
    rng = np.random.default_rng(0)
    races = [run((rng.random((3, SEEDS)) < 0.7).astype(float), np.ones((3, SEEDS))) for _ in range(60)]
    assert sum(bool(race.dropped) for race in races) <= binom.ppf(0.999, len(races), 0.05)


def test_a_clear_loser_is_dropped_at_the_first_look():
    values = drawn(np.random.default_rng(1), 3, spread=0.001)
    values[2] *= 1.5
    race = run(np.ones((3, SEEDS)), values)
    assert race.dropped[2].seeds == race.looks.seeds[0]
    assert race.standing(2) is Standing.WORSE
    assert {race.standing(0), race.standing(1)} == {Standing.BEST, Standing.AS_GOOD}
    assert max(race.seeds.values()) == race.looks.seeds[0]


def test_failures_decide_before_the_metric():
    success, values = np.ones((2, SEEDS)), np.full((2, SEEDS), 10.0)
    success[0, ::2] = 0
    values[0] = 1
    race = run(success, values)
    assert race.standing(0) is Standing.FAILS
    assert race.leader == 1


def test_a_candidate_that_fails_more_often_cannot_win_by_the_metric():
    success, values = np.ones((2, SEEDS)), np.full((2, SEEDS), 10.0)
    success[0, [0, 9, 20]] = 0
    values[0] = 1
    race = run(success, values)
    assert 1 not in race.dropped
    assert race.leader == 1
    assert race.standing(0) is Standing.OPEN


def test_the_same_values_are_as_good_and_end_the_race_early():
    values = np.tile(np.random.default_rng(2).gamma(9, 10, SEEDS), (2, 1))
    race = run(np.ones((2, SEEDS)), values)
    assert race.standing(1) is Standing.AS_GOOD
    assert race.done == 1


def test_candidates_that_differ_by_more_than_the_margin_are_rarely_called_as_good():
    wrong = 0
    for seed in range(60):
        values = drawn(np.random.default_rng(seed), 2, spread=0.02)
        values[1] *= 1.021
        wrong += any(
            standing is Standing.AS_GOOD for standing in map(run(np.ones((2, SEEDS)), values).standing, (0, 1))
        )
    assert wrong <= binom.ppf(0.999, 60, 0.05)


def test_a_candidate_without_a_run_that_counts_leaves_the_race():
    success = np.ones((3, SEEDS))
    success[1] = np.nan
    race = run(success, drawn(np.random.default_rng(3), 3))
    assert race.standing(1) is Standing.NOT_JUDGED
    assert race.leader in (0, 2)


def test_nothing_is_decided_by_too_few_seeds():
    assert plan_looks(5, 3, 0.05).seeds == ()


@given(st.integers(2, 12), st.integers(20, 300), st.floats(0.001, 0.2))
def test_looks_spend_no_more_than_the_error(candidates, seeds, level):
    looks = plan_looks(seeds, candidates, level)
    if not looks.seeds:
        return
    assert list(looks.seeds) == sorted(set(looks.seeds))
    assert looks.seeds[-1] == seeds
    for best in range(1, candidates + 1):
        spent = best * sum(looks.drop_level(best, look) for look in range(len(looks.seeds)))
        assert spent == pytest.approx(level)
    pairs = math.comb(candidates, 2)
    assert pairs * sum(map(looks.margin_level, range(len(looks.seeds)))) == pytest.approx(level)
    assert 0.5 ** looks.seeds[0] <= looks.drop_level(candidates, 0) / (candidates - 1)


@given(st.lists(st.floats(1e-6, 1), min_size=1, max_size=20))
def test_tests_that_can_be_significant_share_the_level(least):
    share = shared_level(0.05, least)
    assert sum(p <= share for p in least) * share <= 0.05 * (1 + 1e-9)


def test_levels_grow_as_candidates_are_dropped():
    looks = Looks(seeds=(10, 20), candidates=4, level=0.05)
    assert looks.drop_level(2, 0) == 2 * looks.drop_level(4, 0)
    assert looks.drop_level(2, 0) == 2 * looks.drop_level(2, 1)
