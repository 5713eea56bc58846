"""Quantiles of Student's t against printed tables."""

import pytest
from mrpbench_analysis.student import quantile


@pytest.mark.parametrize(
    ("level", "freedom", "table"),
    [(0.95, 1, 6.314), (0.95, 2, 2.920), (0.95, 3, 2.353), (0.95, 4, 2.132), (0.975, 9, 2.262), (0.995, 120, 2.617)],
)
def test_quantiles_are_those_of_printed_tables(level, freedom, table):
    assert quantile(level, freedom) == pytest.approx(table, abs=5e-4)
