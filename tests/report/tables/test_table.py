"""Numbers, estimates and other cells as text."""

import math

import pytest

from mrpbench_core.report.statistics.estimate import IntervalEstimate
from mrpbench_core.report.tables.table import Shown, decimals, fixed, p_value, text


def estimate(value, low=math.nan, high=math.nan, n=5):
    return IntervalEstimate(value, low, high, n)


@pytest.mark.parametrize(
    ("value", "width", "places"),
    [
        (12.3456, 4.2, 1),  # two digits of the width
        (12.3456, 42.0, 0),
        (12.3456, 420.0, 0),
        (12.3456, 0.042, 3),
        (0.0123, 0.2, 3),  # of a small value one digit more than that
        (0.0123, 0.002, 4),
        (0.0, 0.002, 4),
        (1e-12, 1e-9, 7),
        (12.34, math.nan, 2),  # four digits of a bare value
        (12.34, 0.0, 2),
        (1.234, math.nan, 3),
        (0.01234, math.nan, 5),
        (0.0, math.nan, 0),
        (123456.0, math.nan, 0),
        (-12.34, math.nan, 2),
    ],
)
def test_decimals_show_two_digits_of_an_interval_or_four_of_a_bare_value(value, width, places):
    assert decimals(value, width) == places


@pytest.mark.parametrize(
    ("number", "places", "written"),
    [
        (1.25, 1, "1.2"),
        (-1.26, 1, "-1.3"),
        (-0.001, 2, "0.00"),
        (9_999_999.0, 0, "9999999"),
        (1e7, 0, "1e+07"),
        (-12_345_678.0, 2, "-1.23e+07"),
    ],
)
def test_numbers_are_written_with_decimals_or_a_power_of_ten_and_never_as_minus_zero(number, places, written):
    assert fixed(number, places) == written


@pytest.mark.parametrize(
    ("shown", "written"),
    [
        (Shown(estimate(12.345, 11.1, 13.6), usual=5), "12.3 [11.1, 13.6]"),
        (Shown(estimate(12.345), usual=5), "12.35"),
        (Shown(estimate(12.345), usual=6), "12.35 n=5"),
        (Shown(estimate(12.345)), "12.35 n=5"),
        (Shown(estimate(0.5, 0.2366, 0.7634), percent=True, usual=5), "50 % [24, 76]"),
        (Shown(estimate(0.25), percent=True, usual=4), "25 % n=5"),
    ],
)
def test_an_estimate_has_its_interval_and_its_number_of_units_where_that_is_unusual(shown, written):
    assert text(shown) == written


def test_what_is_not_known_is_a_dash_and_other_cells_are_short():
    assert [text(cell) for cell in (None, math.nan, 0.123456, 12345.6, 3, "cbs")] == [
        "–",
        "–",
        "0.1235",
        "1.235e+04",
        "3",
        "cbs",
    ]


def test_p_values_are_written_as_in_journals():
    assert [p_value(p) for p in (0.0, 0.00099, 0.001, 0.04951, 1.0)] == [
        "< 0.001",
        "< 0.001",
        "0.001",
        "0.050",
        "1.000",
    ]
