"""`mrpbench analyze OUTPUT.json`: scores an output of the League of Robot Runners."""

from pathlib import Path

from mrpbench_core.checking.lorr.rescore import Score, rescore
from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.lorr.output import read_output
from mrpbench_core.files.lorr.problem import read_problem
from mrpbench_core.files.text import counted

SHOWN = 20
"""Broken rules that are printed."""


def analyze_output(output: Path, problem: str | None, *, as_json: bool) -> int:
    """Score an output and print totals and broken rules.

    Returns:
        1 if a rule is broken or the output states something else than its motion shows, else 0.
    """
    if problem is None:
        raise InputError("an output of the League of Robot Runners needs --scenario PROBLEM.json", file=output)
    score = rescore(read_problem(Path(problem)), read_output(output))
    if as_json:
        print_json(_document(score))
    else:
        _print(score)
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
