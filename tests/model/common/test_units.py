"""Quantities with units."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.model.common.units import UNITS, quantity, sizes, whole_quantity


@pytest.mark.parametrize(
    ("text", "unit", "expected"),
    [
        ("30 s", "s", 30.0),
        ("5 min", "s", 300.0),
        ("5min", "s", 300.0),
        ("33 ms", "s", 0.033),
        ("1/240", "s", 1 / 240),
        ("1/2 min", "s", 30.0),
        ("1e-3 s", "s", 0.001),
        (".5 h", "s", 1800.0),
        ("10 Hz", "Hz", 10.0),
        ("0.8 km/h", "m/s", 2 / 9),
        ("90 deg/s", "rad/s", math.pi / 2),
        ("-90 deg", "rad", -math.pi / 2),
        ("3 pixel", "pixel", 3.0),
    ],
)
def test_quantities_are_read_in_the_unit_of_the_option(text, unit, expected):
    assert quantity(text, unit) == expected


@pytest.mark.parametrize(
    ("text", "expected"), [("4 GiB", 4 * 2**30), ("1.5 KiB", 1536), ("2 kB", 2000), ("7 B", 7), ("1e3 MB", 10**9)]
)
def test_memory_is_a_whole_number_of_bytes(text, expected):
    result = whole_quantity(text, "B")
    assert result == expected
    assert type(result) is int


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("30", "s"),
        ("30 m", "s"),
        ("30 S", "s"),
        ("thirty s", "s"),
        ("30  s", "s"),
        ("30 s s", "s"),
        ("", "s"),
        ("s", "s"),
        ("1/0", "s"),
        ("1//2", "s"),
        ("1e999999999 s", "s"),
        ("9e999 s", "s"),
        ("nan s", "s"),
        ("0x10 s", "s"),
        ("1_000 s", "s"),
        ("٣ s", "s"),
    ],
)
def test_anything_else_is_refused_in_one_sentence(text, unit):
    with pytest.raises(ValueError, match=r".") as caught:
        quantity(text, unit)
    assert "\n" not in str(caught.value)


def test_half_a_byte_is_refused():
    with pytest.raises(ValueError, match="not a whole number"):
        whole_quantity("0.3 KiB", "B")


def test_an_unknown_unit_names_the_known_ones():
    with pytest.raises(ValueError, match="ms, s, min, h"):
        quantity("3 sec", "s")


@settings(deadline=None, max_examples=60)
@given(st.floats(-1e9, 1e9), st.sampled_from(sorted(UNITS)))
def test_a_number_with_the_unit_of_the_option_is_that_number(number, unit):
    assert quantity(f"{number!r} {unit}", unit) == number


@settings(deadline=None, max_examples=60)
@given(st.integers(-(10**6), 10**6), st.sampled_from([(unit, name) for unit in UNITS for name in sizes(unit)]))
def test_a_larger_unit_multiplies(number, pair):
    unit, name = pair
    assert math.isclose(quantity(f"{number} {name}", unit), number * float(sizes(unit)[name]), rel_tol=1e-15)
