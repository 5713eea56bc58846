"""Main effects compare the levels of a factor within scenario and combination of the other factors."""

import numpy as np
import pytest

from mrpbench_core.report.estimation.comparison import compare_settings
from mrpbench_core.report.estimation.effects import find_effects
from mrpbench_core.report.report import make_report

COMBINATIONS = [(planner, controller) for planner in ("a", "b") for controller in ("dwb", "mppi", "rpp")]


def driven(record, planner, controller, seed, cost):
    return record(planner, seed, cost=cost, config={"controller": {"plugin": controller}}, tag=controller)


@pytest.fixture
def effects(results):
    """Return a function that gives report and effects of records."""

    def found(records):
        report = make_report([results(records)], ["planning.cost"])
        (setting,) = report.settings
        return report, {effect.setting.name.split(",")[0]: effect for effect in find_effects(setting)}

    return found


def compared(report, effect):
    comparisons = compare_settings(report.runs, [effect.setting], report.compared)
    return {(c.first, c.second): c for c in comparisons if c.column.name == "planning.cost"}


@pytest.mark.parametrize("share", [0.0, 0.3, 0.8])
def test_differences_are_means_over_what_both_levels_have(effects, record, share):
    """Whatever values are missing, differences are averaged within scenarios, and then over these."""
    random = np.random.default_rng(7)
    cost = {
        (seed, *pair): None if random.random() < share else random.uniform(0, 100)
        for seed in range(6)
        for pair in COMBINATIONS
    }
    records = [driven(record, *key[1:], key[0], value) for key, value in cost.items()]
    report, found = effects(records)
    assert list(found) == ["planner", "controller"]
    differences = []
    for seed in range(6):
        cells = [(cost[seed, "a", c], cost[seed, "b", c]) for c in ("dwb", "mppi", "rpp")]
        within = [second - first for first, second in cells if first is not None and second is not None]
        differences += [np.mean(within)] if within else []
    comparison = compared(report, found["planner"])["a", "b"]
    assert comparison.paired.difference.n == len(differences)
    assert comparison.paired.difference.value == pytest.approx(np.mean(differences), abs=1e-9)


def test_a_lost_hard_combination_does_not_favour_the_one_that_lost_it(effects, record):
    """`b` is 1 s slower everywhere, but has no value with `rpp`, where all are slow."""
    records = [
        driven(record, p, c, seed, None if (p, c) == ("b", "rpp") else seed + (p == "b") + 100 * (c == "rpp"))
        for seed in range(12)
        for p, c in COMBINATIONS
    ]
    report, found = effects(records)
    comparison = compared(report, found["planner"])["a", "b"]
    assert comparison.paired.difference.value == pytest.approx(1.0)
    assert comparison.verdict == "worse"
    assert comparison.paired.difference.n == 12  # scenarios, not scenarios times controllers


def test_combinations_that_only_some_levels_have_are_left_out(effects, record):
    pairs = [("a", "dwb"), ("b", "dwb"), ("a", "mppi")]
    _, found = effects([driven(record, p, c, seed, 1.0) for seed in range(3) for p, c in pairs])
    assert found["planner"].setting.name == "planner, with dwb"
    assert found["controller"].setting.name == "controller, with a"


@pytest.mark.parametrize("pairs", [[("a", "dwb"), ("b", "mppi")], [("a", "dwb"), ("b", "dwb")]])
def test_there_are_no_effects_of_one_factor_or_of_factors_that_change_together(effects, record, pairs):
    assert not effects([driven(record, p, c, seed, 1.0) for seed in range(3) for p, c in pairs])[1]
