"""Quantities as people write them (`30 s`, `10 Hz`, `4 GiB`, `1/240`) in the SI unit an option holds.

Computed as exact fractions and rounded once, so that `33 ms` is the same number as `0.033`.
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
"""For each SI unit, the units that may be written for it and their size."""

# Exponents and digits are bounded: `1e999999999` must not be computed.
_NUMBER = r"[-+]?(?:[0-9]{1,30}(?:\.[0-9]{0,30})?|\.[0-9]{1,30})(?:[eE][-+]?[0-9]{1,3})?"
_QUANTITY = re.compile(rf"({_NUMBER})(?:/([0-9]{{1,30}}))?(?: ?([^\s0-9.+-]\S*))?")


def sizes(unit: str) -> dict[str, Fraction]:
    """The units that may be written where `unit` is expected; of a unit unknown here, only itself."""
    return UNITS.get(unit, {unit: Fraction(1)})


def exact(text: str, unit: str) -> Fraction:
    """Return the quantity in `unit`; a fraction such as `1/240` may leave the unit out.

    Raises:
        ValueError: a sentence that says what is wrong.
    """
    known = ", ".join(sizes(unit))
    found = _QUANTITY.fullmatch(text.strip(" "))
    if found is None:
        raise ValueError(f"expected a number of {unit}, got {text!r} (units: {known})")
    number, divisor, written = found.groups()
    if written is None and divisor is None:
        raise ValueError(f"expected a number of {unit}, got the text {text!r}: leave out the quotes or write a unit")
    if written is not None and written not in sizes(unit):
        raise ValueError(f"unknown unit {written!r} for a quantity in {unit} (units: {known})")
    if divisor is not None and int(divisor) == 0:
        raise ValueError(f"{text!r} divides by zero")
    return Fraction(number) / int(divisor or 1) * sizes(unit)[written or unit]


def quantity(text: str, unit: str) -> float:
    """Like `exact`, as the nearest float."""
    try:
        return float(exact(text, unit))
    except OverflowError:
        raise ValueError(f"{text!r} is too large") from None


def whole_quantity(text: str, unit: str) -> int:
    """Like `exact`, as an int.

    Raises:
        ValueError: also where the quantity is not a whole number of `unit`.
    """
    value = exact(text, unit)
    if value.denominator != 1:
        raise ValueError(f"{text!r} is not a whole number of {unit}")
    return int(value)
