"""A table, independent of the format in which it is written."""

import math
from typing import Any

import attrs

from mrpbench_core.report.statistics.estimate import IntervalEstimate

ROUNDING = 1e-12
"""SI units; no quantity of a run is measured so finely."""
Cell = Any
"""None, text, a number or a `Shown`."""


@attrs.frozen
class Shown:
    """An estimate as a cell of a table."""

    estimate: IntervalEstimate
    percent: bool = False
    usual: int | None = None
    """Number of units that another cell of the row gives; a different number is written after the interval."""

    def __str__(self) -> str:
        estimate, factor = self.estimate, 100.0 if self.percent else 1.0
        value, low, high = (exact(number) * factor for number in (estimate.value, estimate.low, estimate.high))
        places = 0 if self.percent else decimals(value, high - low if estimate.has_interval else math.nan)
        text = fixed(value, places) + (" %" if self.percent else "")
        if estimate.has_interval:
            text += f" [{fixed(low, places)}, {fixed(high, places)}]"
        return text if estimate.n == self.usual else f"{text} n={estimate.n}"


@attrs.frozen(kw_only=True)
class Table:
    """Rows of cells under headings."""

    key: str
    """Name in files."""
    title: str
    headings: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    keys: int
    """Number of leading columns that identify the row."""
    note: str
    """Notes on how to read the table."""


def text(cell: Cell) -> str:
    """Return the text of a cell."""
    if cell is None:
        return "–"
    if isinstance(cell, float):
        return "–" if math.isnan(cell) else f"{exact(cell):.4g}"
    return str(cell)


def p_value(p: float) -> str:
    """Write a p-value as journals do."""
    return "< 0.001" if p < 0.001 else f"{p:.3f}"


def decimals(value: float, width: float) -> int:
    """Number of decimals that show two digits of the interval's width and of the value, or four of a bare value."""
    if not width > 0:
        return max(0, 3 - _magnitude(value)) if value else 0
    places = 1 - _magnitude(width)
    if value and 1 - _magnitude(value) > places:
        places += 1
    return min(7, max(0, places))


def exact(number: float) -> float:
    """Return the number, or 0 if it is so small that only the rounding of sums makes it differ from 0."""
    return 0.0 if abs(number) < ROUNDING else number


def fixed(number: float, places: int) -> str:
    """Write a number with `places` decimals, or with a power of ten if that is too long; never as -0."""
    if abs(number) >= 1e7:
        return f"{number:.3g}"
    written = f"{number:.{places}f}"
    return written.removeprefix("-") if float(written) == 0 else written


def _magnitude(number: float) -> int:
    return math.floor(math.log10(abs(number))) if number else 0
