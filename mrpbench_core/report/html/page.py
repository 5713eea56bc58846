"""Writes the page of a report."""

from collections import Counter
from collections.abc import Mapping, Sequence
from html import escape
from importlib import resources
from pathlib import Path

from mrpbench_core.files.text import counted
from mrpbench_core.model.runs.status import LEFT_OUT, RunStatus
from mrpbench_core.report.estimation.comparison import SIGNIFICANT, Comparison
from mrpbench_core.report.html.figures import figures
from mrpbench_core.report.html.listing import LISTED, packed_runs, tone
from mrpbench_core.report.html.origin import origin
from mrpbench_core.report.report import Report
from mrpbench_core.report.rules import RULES
from mrpbench_core.report.tables.table import Shown, Table, p_value, text
from mrpbench_core.report.template import PageTemplate

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
    counts = _counts(report)
    widths = (f".part:nth-child({place}) {{ flex-grow: {count}; }}\n" for place, (_, count) in enumerate(counts, 1))
    code = {
        "style": (folder / "style.css").read_text(encoding="utf-8") + "".join(widths),
        "script": (folder / "runs.js").read_text(encoding="utf-8"),
    }
    parts = {
        "title": escape(title),
        "summary": _summary(report, counts),
        "tables": "".join(_table(table) for table in report.tables()),
        "figures": figures(report),
        "origin": origin(report),
        "rules": "".join(f"<dt>{escape(name)}</dt><dd>{escape(words)}</dd>" for name, words in RULES),
        "listed": _left_out(report),
        "data": packed_runs(report, replays or {}),
    }
    PageTemplate(folder / "index.html", code).write(file, f"{title} · mrpbench report", parts)


def _left_out(report: Report) -> str:
    """Say which runs the list does not have."""
    count = len(report.runs)
    if count <= LISTED:
        return ""
    return (
        f'<p class="note">The list has {LISTED} of {count} runs: failed ones first, and every configuration in turn.'
        " Tables and figures are of all runs. <code>mrpbench report --parquet FILE</code> writes all runs.</p>"
    )


def _counts(report: Report) -> list[tuple[str, int]]:
    """Number of runs of each status: succeeded, failures, those that do not count."""
    counts = Counter(report.runs.status)
    return sorted(counts.items(), key=lambda item: (item[0] != RunStatus.SUCCEEDED, item[0] in LEFT_OUT, -item[1]))


def _summary(report: Report, counts: Sequence[tuple[str, int]]) -> str:
    runs = report.runs
    total, groups = len(runs), sum(len(setting.groups) for setting in report.settings)
    bar = "".join(
        f'<span class="part {tone(status)}" title="{escape(f"{count} {status}")}"></span>' for status, count in counts
    )
    words = "".join(
        f'<li class="{tone(status)}"><b>{count}</b> {escape(status.replace("_", " "))}</li>' for status, count in counts
    )
    scenarios = len(set(runs.scenario[runs.scenario >= 0].tolist()))
    return (
        f'<p class="lead">{counted(total, "run")} of {counted(groups, "configuration")} on'
        f" {counted(scenarios, 'scenario')}.</p>"
        f'<div class="bar" role="img" aria-label="{escape(", ".join(f"{n} {s}" for s, n in counts))}">{bar}</div>'
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
