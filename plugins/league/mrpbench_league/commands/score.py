"""`mrpbench league-score PROBLEM OUTPUT`: score an output of the League of Robot Runners from its motion alone."""

import argparse
from pathlib import Path

from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.files.text import counted
from mrpbench_league.files.output import read_output
from mrpbench_league.files.problem import read_problem
from mrpbench_league.scoring.rescore import Score, rescore

SHOWN = 20
"""Broken rules that are printed."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "The exit code is 1 if a rule is broken, or if the output states something else than its motion shows."
    )
    parser.add_argument("problem", type=Path, metavar="PROBLEM.json", help="a problem of 2023, 2024 or 2026")
    parser.add_argument("output", type=Path, metavar="OUTPUT.json", help="an output of any program for this problem")
    parser.add_argument("--json", action="store_true", help="print the score as JSON")


def run(arguments: argparse.Namespace) -> int:
    """Score an output and print totals and broken rules."""
    score = rescore(read_problem(arguments.problem), read_output(arguments.output))
    print_json(_document(score)) if arguments.json else _print(score)
    return 1 if score.faults.count else 0


def _document(score: Score) -> dict[str, object]:
    return {
        "season": score.season,
        "robots": score.robots,
        "makespan": score.makespan,
        "tasks": score.tasks,
        "errands": score.errands,
        "faults": score.faults.count,
        "first_faults": [{"time": fault.time, "text": fault.text} for fault in score.faults.kept],
    }


def _print(score: Score) -> None:
    rows = [[name, value] for name, value in _document(score).items() if name != "first_faults"]
    print_table(["rules of", str(score.season)], rows[1:])
    for fault in score.faults.kept[:SHOWN]:
        print(fault)
    if score.faults.count > SHOWN:
        print(f"… {counted(score.faults.count - SHOWN, 'more fault')}; --json lists {len(score.faults.kept)}")
    if score.tasks is None and not score.faults.count:
        print("the motion breaks no rule; the output does not say which robot had which task, so nothing is counted")
