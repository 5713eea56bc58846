"""`mrpbench load CONFIG [key=value…] --vda5050 URL`: raises the rate of transports of a fleet control."""

import argparse
import json
from contextlib import closing
from typing import Any

from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.files.errors import InputError
from mrpbench_live.commands.load_report import LoadReport
from mrpbench_live.commands.outside import EXIT_CODES, add_arguments, run_one
from mrpbench_live.commands.serve import vehicles


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "The tasks of the study are transports, which are published on `mrpbench/transports`; each step multiplies"
        " their rate. It ends with the first step that is not kept up, or after `limits.execution`." + EXIT_CODES
    )
    add_arguments(parser)
    parser.add_argument("--growth", type=float, default=1.5, metavar="X", help="factor of the rate (default: 1.5)")
    parser.add_argument("--window", default="3 min", metavar="TIME", help="simulated time of a step (default: 3 min)")
    parser.add_argument("--pid", type=int, default=0, help="process of the fleet control, to measure it")
    parser.add_argument("--json", action="store_true", help="print the steps as JSON, too")


def run(arguments: argparse.Namespace) -> int:
    """Load, and print what each step came to."""

    def offered(point: StudyRun) -> str:
        tasks = {
            "plugin": "live",
            "offered": _tasks_of(point),
            "growth": arguments.growth,
            "window": arguments.window,
            "pid": arguments.pid,
        }
        return f"tasks={json.dumps(tasks)}"

    code, results = run_one(arguments, vehicles(arguments), offered)
    if results is None:
        return code
    (record,) = results
    with closing(results.recording(record["run_id"])) as recording:
        report = LoadReport.of(recording)
    _print(report, arguments.json)
    return code


def _tasks_of(point: StudyRun) -> Any:
    """The tasks of a study, which come whatever is done."""
    tasks = point.canonical["tasks"]
    if not isinstance(tasks, dict) or "rate" not in tasks:
        raise InputError(
            f"{point.canonical['name']}: the tasks have no rate that could rise",
            hint="tasks: {plugin: poisson, rate: 1, errands: 2, service: 5 s}, or pickup_delivery",
        )
    return tasks


def _print(report: LoadReport, as_json: bool) -> None:
    print_table(report.COLUMNS, report.rows())
    print(report.answer())
    for line in report.silent:
        print(line)
    if as_json:
        print_json({"steps": report.steps, "answer": report.answer(), "silent": report.silent})
