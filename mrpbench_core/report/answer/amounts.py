"""Writes means and differences with their units, as the sentences and pictures of an answer show them."""

import math
from collections.abc import Sequence

from mrpbench_core.report.answer.ranking import Place, Ranking
from mrpbench_core.report.reading.columns import direction
from mrpbench_core.report.statistics.estimate import IntervalEstimate
from mrpbench_core.report.tables.table import decimals, exact, fixed

_MILLI = 0.1
"""Seconds below which times are written in milliseconds."""
_SPOKEN = {"1/h": "per hour", "1/s": "per second"}
_DIGITS = 3
"""Significant digits of a number without interval."""


def units(ranking: Ranking, count: int) -> str:
    """Return a number of units of a ranking: `1 run`, `12 scenarios`."""
    return f"{count} {ranking.unit if count != 1 else ranking.unit.removesuffix('s')}"


def quantity(ranking: Ranking, estimate: IntervalEstimate) -> str:
    """Write a mean: `3.2 s [1.1, 5.3]`."""
    return _written(ranking, estimate)


def change(ranking: Ranking, difference: IntervalEstimate) -> str:
    """Write a difference: `3.2 s more [1.1, 5.3]`, of rates `12 points less [3, 21]`."""
    if difference.value < 0:
        turned = IntervalEstimate(-difference.value, -difference.high, -difference.low, difference.n)
        return _written(ranking, turned, " less", points=True)
    return _written(ranking, difference, " more", points=True)


def span(ranking: Ranking) -> str:
    """Write the least and the largest mean, of those over the same units if there are several."""
    ranked = [place for place in ranking.places if place.estimate is not None]
    whole = [place for place in ranked if not place.fails_more]
    values = sorted(place.estimate.value for place in (whole if len(whole) > 1 else ranked) if place.estimate)
    low, high = (_bare(ranking, value) for value in (values[0], values[-1]))
    return low if low == high else f"{low} to {high}"


def largest(ranking: Ranking, places: Sequence[Place]) -> str | None:
    """Write the largest difference to the first place that the intervals allow; None without intervals."""
    differences = [
        place.difference for place in places if place.difference is not None and place.difference.has_interval
    ]
    if not differences:
        return None
    widest = max(max(abs(one.low), abs(one.high)) for one in differences)
    return _bare(ranking, widest, points=True)


def reading(ranking: Ranking) -> str:
    """Say over what the means are, which way is better, and which differences do not matter."""
    column, estimates = ranking.column, [place.estimate for place in ranking.places if place.estimate is not None]
    sentence = f"{'Share' if ranking.is_rate else 'Mean'} over {units(ranking, ranking.ranked)}"
    sentence += " [95 % interval]." if any(estimate.has_interval for estimate in estimates) else "."
    sentence += {1: " More is better.", -1: " Less is better."}.get(direction(column), "")
    if column.threshold is None:
        return f"{sentence} The metric states no threshold."
    least = (
        f"{100 * column.threshold:g} points"
        if ranking.is_rate
        else f"{column.threshold:g} {_SPOKEN.get(column.unit, column.unit)}".strip()
    )
    share = f" or {100 * column.threshold_share:g} %" if column.threshold_share else ""
    return f"{sentence} Differences below {least}{share} do not matter (grey band)."


def scale(ranking: Ranking, largest: float) -> tuple[float, str]:
    """Return the factor and the unit in which numbers up to `largest` are written."""
    if ranking.is_rate:
        return 100.0, "%"
    unit = ranking.column.unit
    return (1000.0, "ms") if unit == "s" and 0 < largest < _MILLI else (1.0, _SPOKEN.get(unit, unit))


def _bare(ranking: Ranking, value: float, *, points: bool = False) -> str:
    return _written(ranking, IntervalEstimate(value, math.nan, math.nan, 1), points=points)


def _written(ranking: Ranking, estimate: IntervalEstimate, way: str = "", *, points: bool = False) -> str:
    ends = tuple(
        map(exact, (estimate.value, estimate.low, estimate.high) if estimate.high > estimate.low else (estimate.value,))
    )
    factor, unit = scale(ranking, max(map(abs, ends)))
    unit = "points" if points and ranking.is_rate else unit
    value, *interval = (end * factor for end in ends)
    if ranking.is_rate:
        places = 0
    elif interval:
        places = decimals(value, interval[1] - interval[0])
    else:
        value = float(f"{value:.{_DIGITS}g}")
        places = max(0, decimals(value, math.nan) - 4 + _DIGITS)  # of which `decimals` gives four
    number = fixed(value, places)
    text = f"{number} {unit}".strip() + way
    return text + f" [{', '.join(fixed(end, places) for end in interval)}]" if interval else text
