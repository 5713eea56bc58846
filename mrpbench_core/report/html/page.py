"""Writes the page of a report."""

import re
from collections.abc import Mapping
from html import escape
from importlib import resources
from pathlib import Path

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import counted
from mrpbench_core.model.runs.status import LEFT_OUT, RunStatus
from mrpbench_core.report.estimation.comparison import SIGNIFICANT, Comparison
from mrpbench_core.report.html.figures import figures
from mrpbench_core.report.html.listing import packed_runs, tone
from mrpbench_core.report.html.origin import origin
from mrpbench_core.report.report import Report
from mrpbench_core.report.rules import RULES
from mrpbench_core.report.tables.table import Shown, Table, p_value, text

FINDINGS = 12
"""Number of differences in the summary."""


def write_report(report: Report, file: Path, replays: Mapping[str, str] | None = None) -> None:
    """Write one self-contained HTML page.

    Args:
        report: the numbers.
        file: the page.
        replays: addresses of replays relative to the page, by run id.

    Raises:
        InputError: the file cannot be written.
    """
    folder = resources.files(__package__) / "template"
    title = " and ".join(dict.fromkeys(results.folder.path.name for results in report.folders))
    parts = {
        "title": escape(title),
        "style": (folder / "style.css").read_text(encoding="utf-8"),
        "summary": _summary(report),
        "tables": "".join(_table(table) for table in report.tables()),
        "figures": figures(report),
        "origin": origin(report),
        "rules": "".join(f"<dt>{escape(name)}</dt><dd>{escape(words)}</dd>" for name, words in RULES),
        "data": packed_runs(report, replays or {}),
        "script": (folder / "runs.js").read_text(encoding="utf-8"),
    }
    page = (folder / "index.html").read_text(encoding="utf-8")
    page = re.sub(r"<!--(\w+)-->", lambda mark: parts[mark[1]], page)  # at once: what is filled in may look like a mark
    try:
        file.write_text(page, encoding="utf-8")
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror or error}", file=file) from None


def _summary(report: Report) -> str:
    runs = report.runs
    total, groups = len(runs), sum(len(setting.groups) for setting in report.settings)
    counts: dict[str, int] = {}
    for status in runs.status:
        counts[status] = counts.get(status, 0) + 1
    ordered = sorted(counts.items(), key=lambda item: (item[0] != RunStatus.SUCCEEDED, item[0] in LEFT_OUT, -item[1]))
    bar = "".join(
        f'<span class="part {tone(status)}" style="flex-grow:{count}" title="{count} {status}"></span>'
        for status, count in ordered
    )
    words = "".join(
        f'<li class="{tone(status)}"><b>{count}</b> {status.replace("_", " ")}</li>' for status, count in ordered
    )
    scenarios = len(set(runs.scenario[runs.scenario >= 0].tolist()))
    return (
        f'<p class="lead">{counted(total, "run")} of {counted(groups, "configuration")} on'
        f" {counted(scenarios, 'scenario')}.</p>"
        f'<div class="bar" role="img" aria-label="{escape(", ".join(f"{n} {s}" for s, n in ordered))}">{bar}</div>'
        f'<ul class="counts">{words}</ul>{_findings(report.comparisons)}'
    )


def _findings(comparisons: tuple[Comparison, ...]) -> str:
    if not comparisons:
        return ""
    found = sorted((entry for entry in comparisons if entry.verdict != "not shown"), key=lambda entry: entry.p_adjusted)
    if not found:
        return (
            f"<p>None of {counted(len(comparisons), 'paired comparison')} shows a difference at adjusted p &lt;"
            f" {SIGNIFICANT:g}. The data do not establish a ranking.</p>"
        )
    items = []
    for entry in found[:FINDINGS]:
        change = escape(str(Shown(entry.found.difference, percent=entry.is_rate, usual=entry.found.difference.n)))
        where = f" ({escape(entry.setting)})" if entry.setting else ""
        found_in = f"{entry.found.above} of {entry.found.difference.n} pairs more, in {entry.found.below} less"
        mixed = " (few large differences against many small ones)" if entry.is_mixed else ""
        items.append(
            f"<li><b>{escape(entry.second)}</b> is <b class='{entry.verdict}'>{entry.verdict}</b> than"
            f" <b>{escape(entry.first)}</b> in <code>{escape(entry.column.name)}</code>{where}: {change} on average, in"
            f" {found_in}{mixed}; adjusted p {'' if entry.p_adjusted < 0.001 else '= '}"
            f"{escape(p_value(entry.p_adjusted))}</li>"
        )
    more = f"<p>… and {len(found) - FINDINGS} more in the table of pairs.</p>" if len(found) > FINDINGS else ""
    return (
        f"<p>Of {counted(len(comparisons), 'paired comparison')}, {len(found)} show a difference at adjusted p &lt;"
        f" {SIGNIFICANT:g}:</p>"
        f'<ul class="findings">{"".join(items)}</ul>{more}'
    )


def _table(table: Table) -> str:
    heads = "".join(
        f'<th scope="col"{_flush(table, i)}>{_breakable(name)}</th>' for i, name in enumerate(table.headings)
    )
    rows = "".join(
        "<tr>" + "".join(f"<td{_flush(table, i)}>{escape(text(cell))}</td>" for i, cell in enumerate(row)) + "</tr>"
        for row in table.rows
    )
    body = (
        f'<div class="wide"><table><thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table></div>' if rows else ""
    )
    many = len(table.rows) > 40
    body = f"<details><summary>{counted(len(table.rows), 'row')}</summary>{body}</details>" if many else body
    return f'<h3>{escape(table.title)}</h3>{body}<p class="note">{escape(table.note)}</p>'


def _flush(table: Table, column: int) -> str:
    return "" if column < table.keys else ' class="number"'


def _breakable(name: str) -> str:
    return escape(name).replace(".", ".<wbr>")
