"""Convert quantities such as `30 s`, `10 Hz`, `4 GiB` or `1/240` to SI units.

The conversion uses exact fractions and rounds once, so that `33 ms` is the same number as `0.033`.
"""

import math
import re
from fractions import Fraction

_DEGREE = Fraction(math.pi) / 180

UNITS: dict[str, dict[str, Fraction]] = {
    "s": {
        "us": Fraction(1, 10**6),
        "ms": Fraction(1, 1000),
        "s": Fraction(1),
        "min": Fraction(60),
        "h": Fraction(3600),
    },
    "m": {"mm": Fraction(1, 1000), "cm": Fraction(1, 100), "m": Fraction(1), "km": Fraction(1000)},
    "m/s": {"mm/s": Fraction(1, 1000), "cm/s": Fraction(1, 100), "m/s": Fraction(1), "km/h": Fraction(1000, 3600)},
    "m/s^2": {"m/s^2": Fraction(1)},
    "rad": {"deg": _DEGREE, "rad": Fraction(1)},
    "rad/s": {"deg/s": _DEGREE, "rad/s": Fraction(1), "rpm": 6 * _DEGREE},
    "rad/s^2": {"deg/s^2": _DEGREE, "rad/s^2": Fraction(1)},
    "Hz": {"Hz": Fraction(1), "kHz": Fraction(1000), "MHz": Fraction(10**6)},
    "kg": {"g": Fraction(1, 1000), "kg": Fraction(1)},
    "B": {
        "B": Fraction(1),
        **{f"{prefix}B": Fraction(1000**power) for power, prefix in enumerate("kMGT", 1)},
        **{f"{prefix}iB": Fraction(1024**power) for power, prefix in enumerate("KMGT", 1)},
    },
}
"""For each SI unit, the units that are accepted for it and their size."""
LARGEST = {
    "s": 1e10,
    "m": 1e5,
    "m/s": 1e3,
    "m/s^2": 1e4,
    "rad": 1e4,
    "rad/s": 1e4,
    "rad/s^2": 1e5,
    "Hz": 1e6,
    "kg": 1e6,
}
"""For each SI unit, the largest magnitude that a setting may have: far above what any fleet needs, and far below what
computations with it cannot represent."""
LARGEST_NUMBER = 1e9
"""The same for numbers without a unit."""
LARGEST_COUNT = 2**63 - 1
"""The same for whole numbers."""

# Exponents and digits are bounded, so that `1e999999999` is never computed.
_NUMBER = r"[-+]?(?:[0-9]{1,30}(?:\.[0-9]{0,30})?|\.[0-9]{1,30})(?:[eE][-+]?[0-9]{1,3})?"
_QUANTITY = re.compile(rf"({_NUMBER})(?:/([0-9]{{1,30}}))?(?: ?([^\s0-9.+-]\S*))?")


def sizes(unit: str) -> dict[str, Fraction]:
    """Return the units that are accepted for `unit`; for an unknown unit, only itself."""
    return UNITS.get(unit, {unit: Fraction(1)})


def exact(text: str, unit: str) -> Fraction:
    """Return the quantity in `unit`; a fraction such as `1/240` needs no unit.

    Raises:
        ValueError: the text is not such a quantity; the message says why.
    """
    known = ", ".join(sizes(unit))
    match = _QUANTITY.fullmatch(text.strip(" "))
    if match is None:
        raise ValueError(f"expected a number of {unit}, got {text!r} (units: {known})")
    number, divisor, written = match.groups()
    if written is None and divisor is None:
        raise ValueError(f"expected a number of {unit}, got the text {text!r}: remove the quotes or add a unit")
    if written is not None and written not in sizes(unit):
        raise ValueError(f"unknown unit {written!r} for a quantity in {unit} (units: {known})")
    if divisor is not None and int(divisor) == 0:
        raise ValueError(f"{text!r} divides by zero")
    return Fraction(number) / int(divisor or 1) * sizes(unit)[written or unit]


def quantity(text: str, unit: str) -> float:
    """Return the quantity in `unit` as the nearest float; see `exact`."""
    try:
        return float(exact(text, unit))
    except OverflowError:
        raise ValueError(f"{text!r} is too large") from None


def whole_quantity(text: str, unit: str) -> int:
    """Return the quantity in `unit` as an int; see `exact`.

    Raises:
        ValueError: also if the quantity is not a whole number of `unit`.
    """
    value = exact(text, unit)
    if value.denominator != 1:
        raise ValueError(f"{text!r} is not a whole number of {unit}")
    return int(value)
