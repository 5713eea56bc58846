"""The metrics `delay` and `fairness` on arrivals counted by hand."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_metrics_standard import Delay, Fairness
from mrpbench_metrics_standard.fairness import jain

from mrpbench_core.model.planning.plan import Plan, PlanResult, PlanStatus, RobotPath

# One tick is 0.5 s: planned arrivals 2.5 s, 1.5 s (then a wait at the goal), 0 s.
PLAN = Plan(
    paths=(
        RobotPath(edge=[0, -1, 1], enter=[0, 2, 3], leave=[2, 3, 5]),
        RobotPath(edge=[4, -1], enter=[0, 3], leave=[3, 20]),
        RobotPath(edge=[], enter=[], leave=[]),
    )
)


@pytest.fixture
def late(executed):
    """From t = 10 s, each second: robot 0 completes its third segment at 14 s, robot 1 its only move at 12 s."""
    reached = [[0, 1, 1, 2, 3, 3], [0, 0, 1, 1, 1, 1], [0] * 6]
    points = [[(0, 0), (1, 0), (1, 0), (2, 0)], [(0, 0), (0, 1), (0, 1)], [(0, 0)]]
    run = executed(range(10, 16), [[(0, 0)] * 6] * 3, reached, points)
    result = PlanResult(status=PlanStatus.SOLVED, plan=PLAN)
    return attrs.evolve(run, context=attrs.evolve(run.context, result=result))


def unfinished(run):
    """Robot 0 never completes its last segment."""
    reached = run.channel("reached").copy()
    reached[:, 0] = np.minimum(reached[:, 0], 2)
    return attrs.evolve(run, channels={**run.channels, "reached": lambda: reached})


def test_delay_is_the_arrival_after_the_planned_one(late):
    """4 - 2.5 = 1.5 s, 2 - 1.5 = 0.5 s (the wait at its goal does not count), 0 s."""
    values = Delay().measure(late)
    assert values["robots"] == 3
    assert values["mean_s"] == pytest.approx(2 / 3)
    assert values["p95_s"] == pytest.approx(0.5 + 0.9 * 1.0)
    assert values["max_s"] == 1.5
    assert values["time_ratio"] == pytest.approx((4 + 2) / (2.5 + 1.5))
    assert values["makespan_s"] == 1.5
    assert values["switches"] == 0


def test_a_robot_that_never_arrives_has_no_delay(late):
    values = Delay().measure(unfinished(late))
    assert (values["robots"], values["mean_s"], values["max_s"]) == (2, 0.25, 0.5)
    assert (values["time_ratio"], values["makespan_s"]) == (pytest.approx(2 / 1.5), None)


def test_fairness_of_delays(late):
    values = Fairness().measure(late)
    assert values["jain"] == pytest.approx(2**2 / (3 * (1.5**2 + 0.5**2)))
    assert values["max_over_mean"] == pytest.approx(1.5 * 3 / 2)


def test_fairness_is_unknown_while_a_delay_is(late):
    assert set(Fairness().measure(unfinished(late)).values()) == {None}


def test_a_robot_that_is_early_counts_as_punctual(late):
    prompt = np.array([[0, 0, 0], [3, 1, 0]])  # 1.5 s early, 0.5 s early, punctual
    channels = {"time": lambda: np.array([0.0, 1.0]), "reached": lambda: prompt}
    run = attrs.evolve(late, channels=channels)
    assert Delay().measure(run)["mean_s"] == pytest.approx(-2 / 3)
    assert Fairness().measure(run) == {"jain": 1.0, "max_over_mean": None}


@pytest.mark.parametrize("metric", [Delay(), Fairness()])
@pytest.mark.parametrize("missing", ["plan", "time", "reached", "samples"])
def test_values_that_cannot_be_measured_are_null(late, metric, missing):
    if missing == "plan":
        run = attrs.evolve(late, context=attrs.evolve(late.context, result=PlanResult(status=PlanStatus.UNKNOWN)))
    elif missing == "samples":
        run = attrs.evolve(
            late, channels={name: (lambda load=load: load()[:0]) for name, load in late.channels.items()}
        )
    else:
        run = attrs.evolve(late, channels={name: load for name, load in late.channels.items() if name != missing})
    assert metric.measure(run) == {column.name: None for column in metric.columns}


@settings(deadline=None, max_examples=100)
@given(st.lists(st.floats(0, 1e300), min_size=1, max_size=20), st.floats(1e-3, 1e3))
def test_jains_index_lies_between_one_nth_and_one_in_any_unit(shares, unit):
    values = np.array(shares)
    index = jain(values)
    assert 1 / len(values) - 1e-12 <= index <= 1 + 1e-12
    assert jain(values * unit) == pytest.approx(index)
    assert jain(values[::-1]) == index


def test_jains_index_of_k_equal_shares_among_n_is_k_over_n():
    assert [jain(np.array([1.0] * k + [0.0] * (8 - k))) for k in (1, 2, 4, 8)] == [1 / 8, 1 / 4, 1 / 2, 1]
