"""Writes the pages of a site. Every page is one file that loads no other, as reports are."""

import json
from collections.abc import Mapping, Sequence
from html import escape
from importlib import resources
from pathlib import Path
from typing import Any
from urllib.parse import quote

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.output import write_page_file
from mrpbench_core.files.text import counted
from mrpbench_core.report.html.cells import Td, data_table, plain
from mrpbench_core.report.html.shell import page_shell, rules_markup
from mrpbench_core.report.reading.columns import heading
from mrpbench_core.report.template import PageTemplate
from mrpbench_publish.files.description import Description
from mrpbench_publish.site.boards import Board, Cell, Row


@attrs.frozen(kw_only=True)
class Entry:
    """A bundle of the site."""

    file: str
    """Name of its zip file in `bundles/`."""
    sha256: str
    description: Description | None
    """None if the bundle could not be read."""
    verdict: Mapping[str, Any]
    runs: int
    replays: Mapping[str, str]
    """Addresses of replays, relative to the site, by run id."""

    @property
    def passed(self) -> bool:
        """True if its verification found nothing."""
        return self.verdict.get("passed") is True

    @property
    def address(self) -> str:
        """Address of its page, relative to the site."""
        return f"bundles/{self.sha256[:12]}.html"

    @property
    def title(self) -> str:
        """Title of the data, or the name of the file."""
        return self.file if self.description is None else self.description.title

    @property
    def judgement(self) -> str:
        """The verdict in words."""
        checks = [check for check in self.verdict.get("checks") or () if isinstance(check, dict)]
        if not self.passed:
            return counted(sum(len(check.get("findings") or ()) for check in checks), "finding")
        passed = {check.get("name") for check in checks if check.get("outcome") == "passed"}
        if "study" not in passed:
            return "no finding, study not checked"
        return "verified, runs repeated" if "repetition" in passed else "verified, no run repeated"


def write_site(entries: Sequence[Entry], boards: Sequence[Board], title: str, folder: Path) -> None:
    """Write all pages, and the boards as JSON.

    Raises:
        InputError: a file cannot be written.
    """
    page = _template()
    for board in boards:
        parts = {"body": _board(board, entries), "links": _home("../index.html")}
        page.write(_made(folder / board.address), f"{board.title} · {title}", parts)
        text = json.dumps(board.document(), ensure_ascii=False, allow_nan=False, separators=(",", ":"))
        write_page_file(folder / f"boards/{board.number}.json", text + "\n")
    for entry in entries:
        parts = {"body": _bundle(entry), "links": _home("../index.html")}
        page.write(_made(folder / entry.address), f"{entry.title} · {title}", parts)
    page.write(_made(folder / "index.html"), title, {"body": _index(entries, boards), "links": _home("index.html")})


def _template() -> PageTemplate:
    report = resources.files("mrpbench_core.report.html") / "template"
    folder = resources.files(__package__) / "template"
    styles = [*(report / name for name in ("style.css", "tables.css", "narrow.css")), folder / "site.css"]
    return page_shell(styles, [report / "theme.js", report / "tables.js"])


def _home(address: str) -> str:
    return f'<a href="{address}">All boards</a>'


def _made(file: Path) -> Path:
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot be made: {error.strerror}", file=file.parent) from None
    return file


def _index(entries: Sequence[Entry], boards: Sequence[Board]) -> str:
    rows = [
        (
            Td(f'<a href="{quote(board.address)}">{escape(board.title)}</a>'),
            plain(len(board.rows)),
            plain(sum(row.runs for row in board.rows)),
            Td(_leaders(board)),
        )
        for board in boards
    ]
    heads = ("board", "configurations", "runs", "result")
    return (
        f"<h2>Boards</h2><p>A board has the configurations that ran on the same scenarios. Where paired"
        f" tests decide nothing, there is no clear difference.</p>{_table('boards', heads, rows)}"
        f"<h2>Bundles</h2>{_bundles(entries)}{_rules()}"
    )


def _leaders(board: Board) -> str:
    """Which configurations may be the first in each column in which some are behind."""
    ranked = [(column, board.leaders(place)) for place, column in enumerate(board.columns)]
    decided = [(column, names) for column, names in ranked if 0 < len(names) < len(board.rows)]
    if not decided:
        return "No clear differences." if len(board.rows) > 1 else ""
    words = (f"First in <b>{escape(column.name)}</b>: {escape(_either(names))}" for column, names in decided)
    return "<br>".join(words)


def _either(names: Sequence[str]) -> str:
    return f"{', '.join(names[:-1])} or {names[-1]}" if len(names) > 1 else names[0]


def _board(board: Board, entries: Sequence[Entry]) -> str:
    heads = ["configuration", "runs", *(heading(column) for column in board.columns), "bundle", "replays"]
    rows = [_row(row, entries) for row in board.rows]
    timing = any(column.name.startswith("timing.") for column in board.columns)
    note = (
        " Columns of timing are wall times of the machines of the bundles: they cannot be verified." if timing else ""
    )
    return (
        f"<h2>{escape(board.title)}</h2><p>{_leaders(board)}</p>"
        f"<p class='note'>Means over {escape(board.unit)} that all configurations have in common, with 95 % intervals,"
        f" and the range of the rank where it is known.{note}"
        f' <a href="{board.number}.json">The numbers as JSON</a>.</p>'
        f"{_table('rows', heads, rows)}{_rules()}"
    )


def _row(row: Row, entries: Sequence[Entry]) -> list[Td]:
    mine = [entries[number] for number in row.bundles]
    links = ", ".join(f'<a href="../{entry.address}">{escape(entry.title)}</a>' for entry in mine)
    verdicts = "; ".join(dict.fromkeys(entry.judgement for entry in mine))
    pages = [(run, entry.replays[run]) for entry in mine for run in row.run_ids if run in entry.replays]
    replays = ", ".join(f'<a href="../{quote(page)}">{escape(run[:6])}</a>' for run, page in pages) or "–"
    bundles = Td(f"{links}<small>{escape(verdicts)}</small>", style="words")
    first, _, options = row.name.partition(" ")
    name = Td(f"{escape(first)}<small>{escape(options)}</small>", style="words")
    return [name, plain(row.runs), *map(_estimate, row.cells), bundles, Td(replays)]


def _estimate(cell: Cell) -> Td:
    value, bracket, interval = cell.text.partition(" [")
    rank = "" if cell.rank is None or cell.rank.decides_nothing else f"rank {cell.rank}"
    small = "".join(f"<small>{escape(part)}</small>" for part in (f"{bracket}{interval}".strip(), rank) if part)
    return Td(escape(value) + small, None if cell.estimate is None else cell.estimate.value, "number")


def _bundles(entries: Sequence[Entry]) -> str:
    rows = []
    for entry in entries:
        about = entry.description
        facts = ("–", "–", "–")
        if about is not None:
            facts = (", ".join(author.name for author in about.authors), about.license, about.published)
        link = Td(f'<a href="{entry.address}">{escape(entry.title)}</a>')
        verdict = Td(escape(entry.judgement), style="better" if entry.passed else "worse")
        rows.append((link, *map(plain, facts), plain(entry.runs), verdict))
    return _table("bundles", ("title", "authors", "licence", "date", "runs", "verdict"), rows)


def _bundle(entry: Entry) -> str:
    about = entry.description
    facts = {
        "SHA-256": entry.sha256,
        "runs": str(entry.runs),
        "verified by": f"mrpbench {entry.verdict.get('version')}",
    }
    if about is not None:
        facts |= {"authors": ", ".join(author.name for author in about.authors), "licence": about.license}
    if entry.verdict.get("seed"):
        facts["seed of the repetition"] = str(entry.verdict["seed"])
    items = "".join(f"<dt>{escape(name)}</dt><dd>{escape(value)}</dd>" for name, value in facts.items())
    rows = []
    for check in entry.verdict.get("checks") or ():
        findings = "".join(f"<li>{escape(str(text))}</li>" for text in check.get("findings") or ())
        tone = {"passed": "better", "failed": "worse"}.get(str(check.get("outcome")), "")
        covered = Td(f"{escape(str(check.get('covered')))}<ul>{findings}</ul>", style="words")
        rows.append((plain(check.get("name")), Td(escape(str(check.get("outcome"))), style=tone), covered))
    pages = [f'<li><a href="../{quote(page)}">{escape(run)}</a></li>' for run, page in entry.replays.items()]
    replays = f"<h3>Replays</h3><ul>{''.join(pages)}</ul>" if pages else ""
    text = "" if about is None else f"<p>{escape(about.text)}</p>"
    return (
        f"<h2>{escape(entry.title)}</h2>{text}<p><a href='{quote(entry.file)}'>{escape(entry.file)}</a>;"
        f" <code>mrpbench verify {escape(entry.file)} --rerun 10%</code> checks it.</p><dl class='facts'>{items}</dl>"
        f"<h3>Verdict: {escape(entry.judgement)}</h3>"
        f"{_table('checks', ('check', 'outcome', 'covered'), rows)}{replays}"
    )


def _table(name: str, heads: Sequence[str], rows: Sequence[Sequence[Td]]) -> str:
    return data_table(name, heads, rows, identity=name)


def _rules() -> str:
    return f'<details><summary>Rules behind the numbers</summary><dl class="rules">{rules_markup()}</dl></details>'
