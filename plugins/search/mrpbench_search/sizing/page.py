"""The page of a search for a fleet: the answer, and robots against throughput, waits, utilisation, energy and money."""

from collections.abc import Callable, Sequence
from html import escape
from importlib import resources
from pathlib import Path

from mrpbench_core.report.html.cells import data_table, plain
from mrpbench_core.report.html.charts import intervals
from mrpbench_core.report.html.shell import page_shell
from mrpbench_core.report.statistics.estimate import IntervalEstimate
from mrpbench_search.sizing.answer import Row, estimate, table

Value = Callable[[Row], float | None]


def write_page(file: Path, name: str, answer: str, rows: Sequence[Row], currency: str, notes: Sequence[str]) -> None:
    """Write one page without scripts of others.

    Args:
        file: the page.
        name: of the study.
        answer: one sentence.
        rows: the fleets that were tried.
        currency: of the prices.
        notes: sentences below.

    Raises:
        InputError: the file cannot be written.
    """
    folder = resources.files("mrpbench_core.report.html") / "template"
    styles = [folder / sheet for sheet in ("style.css", "answer.css", "tables.css", "narrow.css")]
    shell = page_shell(styles, [folder / "theme.js", folder / "tables.js"])
    heads, cells = table(rows, currency)
    markup = data_table(f"{name}-size", heads, [[plain("" if cell is None else cell) for cell in row] for row in cells])
    body = f"<p><b>{escape(answer)}</b></p>{markup}" + f'<div class="charts">{_charts(rows, currency)}</div>'
    body += "".join(f'<p class="note">{escape(note)}</p>' for note in notes)
    shell.write(file, f"{name} · mrpbench size", {"title": escape(name), "links": "", "body": body})


def _charts(rows: Sequence[Row], currency: str) -> str:
    """A chart for each quantity that was measured."""
    charts = [
        _chart(rows, lambda row: row.found.per_hour, "orders per hour", "Orders that are done."),
        _figure(
            intervals([(row.name, 0, estimate(row.found.in_time)) for row in rows], "in time [%]", percent=False),
            "Share of the orders that are done in time, with its one-sided limits.",
        ),
        _chart(rows, lambda row: row.found.p95, "p95 [s]", "95th percentile of service times, mean of the runs."),
        _chart(rows, lambda row: _percent(row.found.utilisation), "busy [%]", "Share of time with a task."),
        _chart(rows, lambda row: _percent(row.found.blocked), "blocked [%]", "Share of time without getting on."),
        _chart(rows, lambda row: _percent(row.found.charging), "charging [%]", "Share of time at chargers."),
        _chart(rows, lambda row: row.found.energy_wh, "Wh per hour", "Energy of the fleet."),
        _chart(rows, lambda row: row.cost, f"{currency} per hour", "Cost of an hour of operation."),
    ]
    return "".join(charts)


def _chart(rows: Sequence[Row], value: Value, label: str, text: str) -> str:
    """A mark for each fleet; nothing if none was measured."""
    known = [(row.name, 0, _point(value(row))) for row in rows]
    return _figure(intervals(known, label, percent=False), text)


def _figure(chart: str, text: str) -> str:
    return f"<figure>{chart}<figcaption>{escape(text)}</figcaption></figure>" if chart else ""


def _point(value: float | None) -> IntervalEstimate | None:
    return None if value is None or value != value else IntervalEstimate(value, float("nan"), float("nan"), 1)


def _percent(share: float | None) -> float | None:
    return None if share is None else 100 * share
