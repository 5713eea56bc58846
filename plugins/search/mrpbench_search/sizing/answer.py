"""What a search for a fleet says: one sentence, and a row for each fleet that was tried."""

from collections.abc import Mapping, Sequence
from typing import Any

import attrs

from mrpbench_core.files.text import counted
from mrpbench_core.report.answer.wording import listed
from mrpbench_core.report.statistics.estimate import IntervalEstimate
from mrpbench_search.saturation.rates import Verdict as Queues
from mrpbench_search.sizing.fleets import FleetFigures, Limits, Verdict, smallest
from mrpbench_search.sizing.prices import Prices
from mrpbench_search.sizing.search import Fleets

ALL_BUSY = 0.9
"""Utilisation from which on robots or chargers are what is lacking."""
SOME = 0.05
"""Share of the robots' time in which they wait for lifts, from which on lifts are what is lacking."""


@attrs.frozen(kw_only=True)
class Load:
    """What a fleet is to do."""

    orders: str
    """As the user wrote it, like the next."""
    p95: str | None
    bound_s: float


def sentence(name: str, fleets: Fleets, load: Load) -> str:
    """Say which fleet is the smallest one that serves the orders, and what the next smaller one lacks."""
    low, high = smallest(fleets.verdicts)
    words = f"{load.orders} orders" + (f" within {load.p95}" if load.p95 else "")
    if high is None:
        if not fleets.tried:
            return f"{name}: nothing is shown"
        largest = max(fleets.tried)
        found = fleets.tried[largest]
        if fleets.limit:
            why = f": {fleets.limit}"
        elif found.verdict is Verdict.DOES_NOT:
            why = f": {lacking(found, largest)} run out first"
        else:
            why = f"; {largest} may do, which {_evidence(found)}"
        return f"{name}: up to {counted(largest, 'robot')} no fleet is shown to serve {words}{why}"
    first = f"{counted(high, 'robot')}{_chargers(fleets)} serve{'s' if high == 1 else ''} {words}"
    parts = [first + _in_time(fleets.tried[high])]
    maybe = range(high - 1, low - 1, -1)
    parts += [f"{size} may do, which {_evidence(fleets.tried[size])}" for size in maybe if size in fleets.tried]
    if untried := [str(size) for size in maybe if size not in fleets.tried]:
        parts.append(f"{listed(untried)} may do, which {'was' if len(untried) == 1 else 'were'} not tried")
    if low > 1:
        smaller = fleets.tried[low - 1]
        words = f"{low - 1} {'does' if low == 2 else 'do'} not{_in_time(smaller)}"
        parts.append(f"{words}: {lacking(smaller, low - 1)} run out first")
    return f"{name}: {'; '.join(parts)}"


def _in_time(found: FleetFigures) -> str:
    """The share of the orders in time, with the limit that decides."""
    if found.in_time is None:
        return ""
    share = found.in_time
    limit = f"at most {share.high:.1%}" if found.verdict is Verdict.DOES_NOT else f"at least {share.low:.1%}"
    return f" ({share.mean:.1%} of them in time, {limit})"


def _evidence(found: FleetFigures) -> str:
    """What the runs of an undecided fleet show."""
    if found.in_time is None:
        return f"{counted(found.runs, 'run')} do not show"
    share = found.in_time
    queues = "" if found.growth.verdict is Queues.BOUNDED else "; queues are not shown to be bounded"
    in_time = f"{share.mean:.1%} [{share.low:.1%}, {share.high:.1%}] in time"
    return f"{counted(found.runs, 'run')} do not show ({in_time}{queues})"


def _chargers(fleets: Fleets) -> str:
    """The fewest chargers that are shown to do."""
    if not fleets.chargers:
        return ""
    low, high = smallest(fleets.charger_verdicts)
    assert high is not None  # those of the study do
    return f" with {counted(high, 'charger')}" + (f" ({low} may do)" if low < high else "")


def lacking(found: FleetFigures, robots: int) -> str:
    """Return what a fleet lacks: chargers or robots that are busy all the time, lifts, or aisles where robots stand.

    Args:
        found: what its runs show.
        robots: their number; one robot alone blocks no other one, and stands only where it serves.
    """
    if found.chargers_busy is not None and found.chargers_busy >= ALL_BUSY:
        return "chargers"
    if found.lifts is not None and found.lifts >= max(SOME, found.blocked / 2):
        return "lifts"
    busy = found.utilisation + (found.charging or 0.0)
    return "robots" if busy >= ALL_BUSY and (robots == 1 or found.blocked < 1 - ALL_BUSY) else "aisles"


@attrs.frozen(kw_only=True)
class Row:
    """A fleet that was tried."""

    robots: int
    chargers: int | None
    verdict: Verdict
    found: FleetFigures
    cost: float | None
    """Per hour of operation."""

    @property
    def name(self) -> str:
        """Its robots, and its chargers."""
        return counted(self.robots, "robot") + (f", {counted(self.chargers, 'charger')}" if self.chargers else "")


def rows_of(fleets: Fleets, prices: Prices | None) -> list[Row]:
    """Return the fleets that were tried, the smallest first, and then the smallest one with fewer chargers."""

    def row(robots: int, chargers: int | None, found: FleetFigures, verdict: Verdict) -> Row:
        cost = None if prices is None else prices.per_hour(robots, chargers or 0, found)
        return Row(robots=robots, chargers=chargers, verdict=verdict, found=found, cost=cost)

    rows = [row(size, fleets.installed, found, fleets.verdicts[size]) for size, found in sorted(fleets.tried.items())]
    high = smallest(fleets.verdicts)[1] or 0
    for count, found in sorted(fleets.chargers.items(), reverse=True):
        if count != fleets.installed:
            rows.append(row(high, count, found, fleets.charger_verdicts[count]))
    return rows


def table(rows: Sequence[Row], currency: str) -> tuple[list[str], list[list[Any]]]:
    """Return the heads and the cells of a table; what no run measures has no column."""
    heads = ["fleet", "", "runs", "orders/h", "p95 [s]", "queues", "busy", "blocked", "runs out"]
    optional: dict[str, Any] = {
        "in time": lambda row: _limits(row.found.in_time),
        "charging": lambda row: _share(row.found.charging),
        "chargers busy": lambda row: _share(row.found.chargers_busy),
        "empty": lambda row: None if row.found.energy_wh is None else f"{row.found.empty:g}",
        "Wh/h": lambda row: None if row.found.energy_wh is None else f"{row.found.energy_wh:.1f}",
        f"{currency}/h": lambda row: None if row.cost is None else f"{row.cost:.2f}",
        "failed": lambda row: row.found.failed or None,
    }
    shown = {head: cell for head, cell in optional.items() if any(cell(row) is not None for row in rows)}
    cells = [[*_cells(row), *(cell(row) for cell in shown.values())] for row in rows]
    return [*heads, *shown], cells


def _cells(row: Row) -> list[Any]:
    found = row.found
    p95 = None if found.p95 is None else f"{found.p95:.1f}"
    out = "" if row.verdict is Verdict.SERVES else lacking(found, row.robots)
    figures = [f"{found.per_hour:.1f}", p95, found.growth.verdict, f"{found.utilisation:.0%}", f"{found.blocked:.0%}"]
    return [row.name, row.verdict, found.runs, *figures, out]


def _limits(found: Limits | None) -> str | None:
    return None if found is None else f"{found.mean:.1%} [{found.low:.1%}, {found.high:.1%}]"


def _share(value: float | None) -> str | None:
    return None if value is None else f"{value:.0%}"


def estimate(found: Limits | None) -> IntervalEstimate | None:
    """Return one-sided limits of a share as an interval in percent, for a chart."""
    return None if found is None else IntervalEstimate(100 * found.mean, 100 * found.low, 100 * found.high, 1)


def document(rows: Sequence[Row]) -> list[Mapping[str, Any]]:
    """Return the rows as plain data."""
    return [
        {"robots": row.robots, "chargers": row.chargers, "verdict": row.verdict, "cost_per_hour": row.cost}
        | attrs.asdict(row.found)
        for row in rows
    ]
