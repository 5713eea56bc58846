"""The metric `draws` on arrivals counted by hand."""

import attrs
import numpy as np
import pytest
from mrpbench_metrics_standard import Draws


@pytest.fixture
def drawn(executed):
    """Three draws of two robots; in the last one a robot does not arrive."""
    run = executed(range(2), [[(0, 0)] * 2] * 2, [[0, 1]] * 2, [[(0, 0), (1, 0)]] * 2)
    channels = {
        "draw": np.arange(3),
        "draw_arrival": np.array([[4.0, 10.0], [6.0, 14.0], [5.0, np.nan]]),
        "draw_waiting": np.array([[0.0, 1.0], [2.0, 3.0], [7.0, 8.0]]),
    }
    return attrs.evolve(
        run, channels={**run.channels, **{name: lambda rows=rows: rows for name, rows in channels.items()}}
    )


def test_draws_in_which_all_arrive_are_summarized(drawn):
    values = Draws().measure(drawn)
    assert (values["draws"], values["arrived"]) == (3, 2)
    assert (values["makespan_mean_s"], values["makespan_p50_s"]) == (12, 12)
    assert values["makespan_p95_s"] == pytest.approx(10 + 0.95 * 4)
    assert (values["makespan_low_s"], values["makespan_high_s"]) == pytest.approx(
        (12 - 1.96 * 2, 12 + 1.96 * 2), rel=1e-4
    )
    assert (values["arrival_mean_s"], values["waiting_mean_s"]) == (8.5, 3)
    assert set(values) == {column.name for column in Draws.columns}


def test_without_arrivals_only_the_counts_are_known(drawn):
    nobody = {**drawn.channels, "draw_arrival": lambda: np.full((3, 2), np.nan)}
    values = Draws().measure(attrs.evolve(drawn, channels=nobody))
    assert {name: value for name, value in values.items() if value is not None} == {"draws": 3, "arrived": 0}


def test_a_single_draw_has_no_interval(drawn):
    one = {name: lambda name=name: drawn.channel(name)[:1] for name in ("draw", "draw_arrival", "draw_waiting")}
    values = Draws().measure(attrs.evolve(drawn, channels={**drawn.channels, **one}))
    assert values["makespan_mean_s"] == 10
    assert values["makespan_low_s"] is values["makespan_high_s"] is None
