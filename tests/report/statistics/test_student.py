"""Quantiles of Student's t against printed tables and SciPy."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.report.statistics.student import quantile


@pytest.mark.parametrize(
    ("level", "freedom", "table"), [(0.95, 1, 6.314), (0.95, 2, 2.920), (0.95, 4, 2.132), (0.975, 9, 2.262)]
)
def test_quantiles_are_those_of_printed_tables(level, freedom, table):
    assert quantile(level, freedom) == pytest.approx(table, abs=5e-4)


@given(st.floats(0.51, 0.999), st.integers(1, 200))
def test_quantiles_are_those_of_scipy(level, freedom):
    stats = pytest.importorskip("scipy.stats")
    assert quantile(level, freedom) == pytest.approx(stats.t.ppf(level, freedom), rel=1e-8)
