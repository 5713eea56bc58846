"""Writes the page of a report."""

from collections import Counter
from collections.abc import Mapping, Sequence
from html import escape
from importlib import resources
from pathlib import Path

from mrpbench_core.files.text import counted
from mrpbench_core.model.runs.status import LEFT_OUT, RunStatus
from mrpbench_core.report.answer.answer import Answer, make_answer
from mrpbench_core.report.html.answer import advice, answer_section, headline
from mrpbench_core.report.html.figures import figures
from mrpbench_core.report.html.listing import LISTED, packed_runs, tone
from mrpbench_core.report.html.origin import origin
from mrpbench_core.report.html.shell import page_shell, rules_markup
from mrpbench_core.report.html.tables import table_markup
from mrpbench_core.report.report import Report

SECTIONS = {
    "answer": "Answer",
    "examples": "Runs to look at",
    "tables": "Tables",
    "figures": "Figures",
    "runs": "All runs",
    "origin": "Reproduce",
    "rules": "Rules",
}
"""What links in the head of the page call its sections."""


def write_report(
    report: Report,
    file: Path,
    replays: Mapping[str, str] | None = None,
    answer: Answer | None = None,
    examples: str = "",
) -> None:
    """Write one self-contained HTML page.

    Args:
        report: the numbers.
        file: the page.
        replays: addresses of replays relative to the page, by run id.
        answer: of the report; None = it is made here.
        examples: the section with runs to look at, as markup.

    Raises:
        InputError: the file cannot be written.
    """
    folder = resources.files(__package__) / "template"
    styles = [folder / name for name in ("style.css", "answer.css", "tables.css", "narrow.css")]
    scripts = [folder / name for name in ("theme.js", "tables.js", "runs.js")]
    title = " and ".join(dict.fromkeys(results.folder.path.name for results in report.folders))
    counts = _counts(report)
    widths = (f".part:nth-child({place}) {{ flex-grow: {count}; }}\n" for place, (_, count) in enumerate(counts, 1))
    shell = page_shell(styles, scripts, (folder / "body.html").read_text(encoding="utf-8"), "".join(widths))
    answer = answer or make_answer(report)
    parts = {
        "title": escape(title),
        "links": "".join(f'<a href="#{section}">{words}</a>' for section, words in SECTIONS.items()),
        "headline": headline(answer),
        "advice": advice(answer),
        "answer": answer_section(answer),
        "examples": examples,
        "summary": _summary(report, answer, counts),
        "tables": "".join(map(table_markup, report.tables())),
        "figures": figures(report),
        "origin": origin(report),
        "rules": rules_markup(),
        "listed": _left_out(report),
        "data": packed_runs(report, replays or {}),
    }
    shell.write(file, f"{title} · mrpbench report", parts)


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


def _summary(report: Report, answer: Answer, counts: Sequence[tuple[str, int]]) -> str:
    runs = report.runs
    parts = answer.parts or ((answer.whole,) if answer.whole else ())
    names = {name for part in parts for name in part.setting.names}
    within = f" in {counted(len(parts), 'setting')}" if len(parts) > 1 else ""
    bar = "".join(
        f'<span class="part {tone(status)}" title="{escape(f"{count} {status}")}"></span>' for status, count in counts
    )
    words = "".join(
        f'<li class="{tone(status)}"><b>{count}</b> {escape(status.replace("_", " "))}</li>' for status, count in counts
    )
    scenarios = len(set(runs.scenario[runs.scenario >= 0].tolist()))
    return (
        f'<div class="bar" role="img" aria-label="{escape(", ".join(f"{n} {s}" for s, n in counts))}">{bar}</div>'
        f'<ul class="counts"><li>{counted(len(runs), "run")}: {counted(len(names), "configuration")}{within},'
        f" {counted(scenarios, 'scenario')}.</li>{words}</ul>"
    )
