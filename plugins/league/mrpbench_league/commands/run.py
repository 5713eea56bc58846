"""`mrpbench league-run PROBLEM`: execute a problem of the League of Robot Runners and write the output."""

import argparse
import sys
from pathlib import Path

import attrs
import numpy as np

from mrpbench_core.cli.main import main as mrpbench
from mrpbench_core.files.errors import InputError
from mrpbench_league.execute import Options, execute
from mrpbench_league.files.problem import read_problem


def main() -> int:
    """Run `mrpbench-league`, another name of `mrpbench league-run`; return its exit code."""
    return mrpbench(["league-run", *sys.argv[1:]])


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("problem", type=Path, metavar="PROBLEM.json", help="a problem of 2023, 2024 or 2026")
    parser.add_argument("--duration", type=_positive, required=True, metavar="N", help="steps, or ticks of 2026")
    parser.add_argument("--out", type=Path, default=Path("output.json"), metavar="FILE", help="(default: %(default)s)")
    parser.add_argument("--planner", choices=("pibt", "epibt"), default="epibt", help="(default: %(default)s)")
    parser.add_argument("--depth", type=int, choices=(3, 4, 5), help="actions of an operation of epibt (4 or 5)")
    parser.add_argument("--threads", type=_positive, default=1, metavar="N", help="threads of improvement of epibt")
    parser.add_argument("--no-guidance", action="store_false", dest="guidance", help="moves cost the same everywhere")
    parser.add_argument("--active", type=_positive, metavar="N", help="robots with goals (half the cells, 2023: 3/8)")
    parser.add_argument("--limit", type=_seconds, default=1.0, metavar="S", help="seconds of one answer")
    parser.add_argument("--preprocessing", type=_duration, default=30.0, metavar="S", help="seconds before step 1 (30)")
    parser.add_argument("--table-mib", type=_positive, default=2048, metavar="MIB", help="of distance tables (2048)")
    parser.add_argument("--iterations", type=int, metavar="N", help="rounds of improvement instead of seconds")
    parser.add_argument("--period", type=_positive, default=10, metavar="N", help="ticks between two calls (2026)")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="of the planner")


def run(arguments: argparse.Namespace) -> int:
    """Execute the problem and print totals."""
    problem = read_problem(arguments.problem)
    options = {field.name: getattr(arguments, field.name) for field in attrs.fields(Options) if field.name in arguments}
    try:
        done = execute(problem, arguments.duration, Options(**options))
    except ValueError as error:
        raise InputError(str(error)) from error
    done.write(arguments.out)
    slowest, usual = done.call_seconds.max(), np.median(done.call_seconds)
    unit = "ticks" if problem.season == 2026 else "steps"
    print(f"{done.output.finished} tasks, {done.errands} errands in {arguments.duration} {unit}")
    print(f"{done.preprocessing_seconds:.1f} s of preprocessing")
    print(f"{done.late_calls} late answers; a call took {usual:.3f} s (median), {slowest:.3f} s (longest)")
    print(arguments.out)
    return 0


def _positive(text: str) -> int:
    number = int(text)
    if not 1 <= number <= 10**6:
        raise argparse.ArgumentTypeError(f"should be from 1 to 1000000, is {text}")
    return number


def _seconds(text: str) -> float:
    number = float(text)
    if not 0 < number < 1e6:
        raise argparse.ArgumentTypeError(f"should be above 0, is {text}")
    return number


def _duration(text: str) -> float:
    return 0.0 if float(text) == 0 else _seconds(text)
