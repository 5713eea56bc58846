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
from mrpbench_core.report.html.shell import page_shell
from mrpbench_core.report.reading.columns import heading
from mrpbench_core.report.rules import RULES
from mrpbench_core.report.site.boards import Board, Row
from mrpbench_core.report.template import PageTemplate
from mrpbench_core.store.bundle.description import Description


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
        page.write(_made(folder / board.address), f"{board.world}, {board.robots} robots · {title}", parts)
        text = json.dumps(board.document(), ensure_ascii=False, allow_nan=False, separators=(",", ":"))
        write_page_file(folder / f"boards/{board.number}.json", text + "\n")
    for entry in entries:
        parts = {"body": _bundle(entry), "links": _home("../index.html")}
        page.write(_made(folder / entry.address), f"{entry.title} · {title}", parts)
    page.write(_made(folder / "index.html"), title, {"body": _index(entries, boards), "links": _home("index.html")})


def _template() -> PageTemplate:
    report = resources.files("mrpbench_core.report.html") / "template"
    own = resources.files(__package__) / "template"
    return page_shell(
        (report / "style.css", report / "narrow.css", own / "site.css"), (report / "theme.js", own / "site.js")
    )


def _home(address: str) -> str:
    return f'<a href="{address}">All boards</a>'


def _made(file: Path) -> Path:
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot be made: {error.strerror}", file=file.parent) from None
    return file


def _index(entries: Sequence[Entry], boards: Sequence[Board]) -> str:
    rows = []
    for board in boards:
        link = f'<a href="{quote(board.address)}">{escape(board.world)}</a>'
        leaders = " or ".join(board.leaders) if len(board.leaders) < len(board.rows) else "not told apart"
        if len(board.rows) == 1:
            leaders = board.rows[0].name
        cells = (board.robots, board.options, len(board.rows), sum(row.runs for row in board.rows), leaders)
        rows.append(
            f'<tr data-world="{escape(board.world)}" data-robots="{escape(board.robots)}"><td>{link}</td>'
            + "".join(f"<td>{escape(str(cell))}</td>" for cell in cells)
            + f"<td hidden>{escape(' '.join(row.name for row in board.rows))}</td></tr>"
        )
    heads = ("world", "robots", "options", "configurations", "runs", "may be first in success")
    worlds = dict.fromkeys(board.world for board in boards)
    counts = dict.fromkeys(board.robots for board in boards)
    filters = f'<form id="filters">{_choice("world", worlds)}{_choice("robots", counts)}{_search()}</form>'
    return (
        f"<h2>Boards</h2><p>A board has the configurations that ran on the same scenarios. A rank is a range: what the"
        f" paired tests do not decide is not told apart.</p>{filters}{_table('boards', heads, rows)}"
        f"<h2>Bundles</h2>{_bundles(entries)}{_rules()}"
    )


def _board(board: Board, entries: Sequence[Entry]) -> str:
    heads = ["configuration", "runs", *(heading(column) for column in board.columns), "bundle", "verdict", "replays"]
    rows = [_row(row, entries) for row in board.rows]
    timing = any(column.name.startswith("timing.") for column in board.columns)
    note = (
        " Columns of timing are wall times of the machines of the bundles: they cannot be verified." if timing else ""
    )
    options = f" {escape(board.options)}" if board.options else ""
    return (
        f"<h2>{escape(board.world)}, {escape(board.robots)} robots{options}</h2><p>Over {escape(board.unit)} that all"
        f" configurations have in common, with 95 % intervals; below each value, the range of its rank.{note}"
        f' <a href="{board.number}.json">The numbers as JSON</a>.</p><form id="filters">{_search()}</form>'
        f"{_table('rows', heads, rows)}{_rules()}"
    )


def _row(row: Row, entries: Sequence[Entry]) -> str:
    cells = "".join(
        f'<td class="number">{escape(cell.text)}<br><small>{escape(str(cell.rank or ""))}</small></td>'
        for cell in row.cells
    )
    mine = [entries[number] for number in row.bundles]
    links = ", ".join(f'<a href="../{entry.address}">{escape(entry.title)}</a>' for entry in mine)
    verdicts = "; ".join(dict.fromkeys(entry.judgement for entry in mine))
    pages = [(run, entry.replays[run]) for entry in mine for run in row.run_ids if run in entry.replays]
    replays = ", ".join(f'<a href="../{quote(page)}">{escape(run[:6])}</a>' for run, page in pages) or "–"
    return (
        f"<tr><td>{escape(row.name)}</td><td class='number'>{row.runs}</td>{cells}<td>{links}</td>"
        f"<td>{escape(verdicts)}</td><td>{replays}</td></tr>"
    )


def _bundles(entries: Sequence[Entry]) -> str:
    rows = []
    for entry in entries:
        about = entry.description
        authors = "–" if about is None else ", ".join(author.name for author in about.authors)
        facts = (
            authors,
            "–" if about is None else about.license,
            "–" if about is None else about.published,
            entry.runs,
        )
        rows.append(
            f'<tr><td><a href="{entry.address}">{escape(entry.title)}</a></td>'
            + "".join(f"<td>{escape(str(fact))}</td>" for fact in facts)
            + f'<td class="{"better" if entry.passed else "worse"}">{escape(entry.judgement)}</td></tr>'
        )
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
        found = "".join(f"<li>{escape(str(text))}</li>" for text in check.get("findings") or ())
        tone = {"passed": "better", "failed": "worse"}.get(str(check.get("outcome")), "")
        rows.append(
            f'<tr><td>{escape(str(check.get("name")))}</td><td class="{tone}">{escape(str(check.get("outcome")))}</td>'
            f'<td class="words">{escape(str(check.get("covered")))}<ul>{found}</ul></td></tr>'
        )
    pages = [f'<li><a href="../{quote(page)}">{escape(run)}</a></li>' for run, page in entry.replays.items()]
    replays = f"<h3>Replays</h3><ul>{''.join(pages)}</ul>" if pages else ""
    text = "" if about is None else f"<p>{escape(about.text)}</p>"
    return (
        f"<h2>{escape(entry.title)}</h2>{text}<p><a href='{quote(entry.file)}'>{escape(entry.file)}</a>;"
        f" <code>mrpbench verify {escape(entry.file)} --rerun 10%</code> checks it.</p><dl class='facts'>{items}</dl>"
        f"<h3>Verdict: {escape(entry.judgement)}</h3>{_table('checks', ('check', 'outcome', 'covered'), rows)}{replays}"
    )


def _table(name: str, heads: Sequence[str], rows: Sequence[str]) -> str:
    head = "".join(f'<th scope="col">{escape(text)}</th>' for text in heads)
    body = f"<thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody>"
    return f'<div class="wide"><table id="{name}">{body}</table></div>'


def _choice(name: str, values: Mapping[str, None]) -> str:
    options = "".join(f"<option>{escape(value)}</option>" for value in values)
    return f'<label>{name} <select data-key="{name}"><option value="">all</option>{options}</select></label> '


def _search() -> str:
    field = '<input id="search" type="search" placeholder="planner, option">'
    return f'<label>Search {field}</label> <output id="found"></output>'


def _rules() -> str:
    rules = "".join(f"<dt>{escape(name)}</dt><dd>{escape(words)}</dd>" for name, words in RULES)
    return f'<details><summary>Rules behind the numbers</summary><dl class="rules">{rules}</dl></details>'
