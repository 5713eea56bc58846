"""`mrpbench report DIR…`: print tables with intervals and tests, and write them as one HTML page."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from mrpbench_core.cli.input.arguments import split_names
from mrpbench_core.cli.output.table import print_json, print_wide
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.printing import printable
from mrpbench_core.store.results import load

if TYPE_CHECKING:
    from mrpbench_core.report.answer.answer import Answer
    from mrpbench_core.report.report import Report

PARTS = 6
"""Number of settings whose answers are printed."""
REPLAYS = 8
"""Number of replays that are written by default."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "One row for each configuration, over its seeds and repeats, with 95 % intervals and n; then the same over the"
        " scenarios that all have in common, paired tests, and last the answer. The page has every rule."
    )
    parser.add_argument(
        "folders", nargs="+", metavar="DIR", help="results folders; of one run in several, the later wins"
    )
    parser.add_argument("--metrics", metavar="A,B", help="columns to show, or `all` (default: the primary columns)")
    parser.add_argument(
        "--by",
        metavar="A,B",
        help="options or blocks that make rows, e.g. planner,scenario.robots; runs that differ in others are pooled"
        " (default: all that vary)",
    )
    parser.add_argument("--json", action="store_true", help="print as JSON")
    parser.add_argument("--csv", metavar="FILE", help="write the estimates, one line per row and column")
    parser.add_argument("--pairs-csv", metavar="FILE", help="write the paired comparisons")
    parser.add_argument("--markdown", metavar="FILE", help="write the tables")
    parser.add_argument("--latex", metavar="FILE", help="write the tables, for the package booktabs")
    parser.add_argument(
        "--html", metavar="FILE", help="file of the page (default: report.html in the first DIR; `none` = no page)"
    )
    parser.add_argument(
        "--replays",
        type=int,
        default=REPLAYS,
        metavar="N",
        help="replays to write that the page links to, failed runs first (default: %(default)s; those that are there"
        " are linked in any case)",
    )
    parser.add_argument("--parquet", metavar="FILE", help="write one row per run, with all options, metrics and timing")


def run(arguments: argparse.Namespace) -> int:
    """Print or write the tables."""
    from mrpbench_core.report.answer.answer import make_answer
    from mrpbench_core.report.data import PAIR_COLUMNS, groups_of, pairs_of, write_estimates, write_rows
    from mrpbench_core.report.report import make_report
    from mrpbench_core.report.rules import RULES
    from mrpbench_core.report.tables.write import latex, markdown

    folders = [load(folder) for folder in arguments.folders]
    report = make_report(folders, split_names(arguments.metrics), split_names(arguments.by))
    answer = make_answer(report)
    tables = report.tables()
    if arguments.csv:
        write_estimates(report, Path(arguments.csv))
    if arguments.pairs_csv:
        write_rows(Path(arguments.pairs_csv), pairs_of(report.comparisons), list(PAIR_COLUMNS))
    if arguments.markdown:
        _write(arguments.markdown, markdown(tables))
    if arguments.latex:
        _write(arguments.latex, latex(tables))
    if arguments.parquet:
        from mrpbench_core.report.parquet import write_parquet

        write_parquet(folders, Path(arguments.parquet))
    if arguments.json:
        print_json(
            {
                "answer": list(answer.lines(len(answer.parts))),
                "groups": groups_of(report),
                "pairs": pairs_of(report.comparisons),
                "rules": dict(RULES),
            }
        )
    else:
        _print(report, answer)
    if arguments.html != "none" and (arguments.html or not arguments.json):
        page = Path(arguments.html) if arguments.html else folders[0].folder.path / "report.html"
        _write_page(report, answer, page, arguments.replays)
        if not arguments.json:
            print(f"wrote {page}")
    return 0


def _write_page(report: "Report", answer: "Answer", page: Path, most: int) -> None:
    from mrpbench_core.cli.output.replays import make_pair, make_replays
    from mrpbench_core.report.answer.examples import choose_examples
    from mrpbench_core.report.html.examples import examples_section
    from mrpbench_core.report.html.page import write_report

    examples = choose_examples(report, answer)
    replays = make_replays(report, page, most, [example.run for entry in examples for example in entry.runs])
    pairs: dict[tuple[str, str], str] = {}
    for contrast in (entry.contrast for entry in examples if entry.contrast and most > 0):
        if address := make_pair(report, page, contrast.first, contrast.second):
            pairs[report.runs.run_id[contrast.first], report.runs.run_id[contrast.second]] = address
    write_report(report, page, replays, answer, examples_section(report, examples, replays, pairs))


def _print(report: "Report", answer: "Answer") -> None:
    for table in report.tables(brief=True):
        print_wide(table)
    for line in answer.lines(PARTS):
        print(printable(line))


def _write(name: str, content: str) -> None:
    try:
        Path(name).write_text(content, encoding="utf-8")
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", file=name) from error
