"""`mrpbench compare A B`: say what is better or worse in one results folder than in another."""

import argparse
from pathlib import Path

from mrpbench_core.cli.input.arguments import split_names
from mrpbench_core.cli.output.table import print_json, print_wide
from mrpbench_core.files.text import counted
from mrpbench_core.store.results import load


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "Runs are paired by scenario, after repeats are averaged; configurations are paired by the options that vary"
        " within a folder. Exit code: 0 nothing is significantly worse in B, 1 something is, 2 nothing can be compared."
    )
    parser.add_argument("first", metavar="A", help="results folder that is the reference")
    parser.add_argument("second", metavar="B", help="results folder that is judged")
    parser.add_argument("--metrics", metavar="X,Y", help="columns to compare, or `all` (default: the primary columns)")
    parser.add_argument("--by", metavar="X,Y", help="options in which configurations must agree; others are pooled")
    parser.add_argument("--json", action="store_true", help="print as JSON")
    parser.add_argument("--markdown", action="store_true", help="print one Markdown table, for a pull request")
    parser.add_argument("--csv", metavar="FILE", help="write all comparisons to a file")


def run(arguments: argparse.Namespace) -> int:
    """Compare the folders and print the result."""
    from mrpbench_core.report.data import PAIR_COLUMNS, pairs_of, write_rows
    from mrpbench_core.report.folder_comparison import compare_folders
    from mrpbench_core.report.rules import RULES
    from mrpbench_core.report.tables.build import pairs_table

    first, second = load(arguments.first), load(arguments.second)
    comparison = compare_folders(first, second, split_names(arguments.metrics), split_names(arguments.by))
    verdicts = [entry.verdict for entry in comparison.comparisons]
    counts = {name: verdicts.count(name) for name in ("better", "worse", "different", "not shown")}
    if arguments.csv:
        write_rows(Path(arguments.csv), pairs_of(comparison.comparisons), list(PAIR_COLUMNS))
    if arguments.json:
        print_json(
            {
                "comparisons": pairs_of(comparison.comparisons),
                "verdicts": counts,
                "differing": {name: list(values) for name, values in comparison.differing.items()},
                "only_in_first": list(comparison.unmatched[0]),
                "only_in_second": list(comparison.unmatched[1]),
                "no_common_scenario": list(comparison.no_common_scenario),
                "rules": dict(RULES),
            }
        )
        return int(counts["worse"] > 0)
    if arguments.markdown:
        from mrpbench_core.report.tables.changes import changes_table
        from mrpbench_core.report.tables.write import markdown

        print(markdown([changes_table(comparison.comparisons)]), end="")
        return int(counts["worse"] > 0)
    print(f"A: {arguments.first}, {counted(len(first), 'run')}\nB: {arguments.second}, {counted(len(second), 'run')}")
    for name, (one, other) in comparison.differing.items():
        print(f"   {name}: {one} → {other}")
    for letter, names in zip("AB", comparison.unmatched, strict=True):
        if names:
            print(f"only in {letter}, not compared: {'; '.join(names)}")
    if comparison.no_common_scenario:
        print(f"without a common scenario, not compared: {'; '.join(comparison.no_common_scenario)}")
    table = pairs_table(comparison.comparisons)
    assert table is not None
    print()
    print_wide(table)
    print(
        f"Of {counted(len(verdicts), 'comparison')} B is better in {counts['better']}, worse in {counts['worse']},",
        end=" ",
    )
    print(f"different in {counts['different']}; that no difference is shown does not show that there is none")
    return int(counts["worse"] > 0)
