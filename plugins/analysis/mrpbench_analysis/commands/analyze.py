"""`mrpbench analyze BAG`: compute the metrics of runs for a recording of a real fleet or of another simulator."""

import argparse
import sys
from pathlib import Path
from typing import Any

from mrpbench_core.cli.input.arguments import read_options
from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.links import followed
from mrpbench_core.files.text import counted
from mrpbench_core.model.runs.status import RunStatus

SHOWN = 20
"""Notes and robots that are printed."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "A bag that mrpbench wrote needs neither --world nor --scenario. If there is no plan, a robot reaches a goal"
        " when it first comes within --tolerance of it. Patterns for topics are options of the format:"
        " `mrpbench plugins show rosbag2`."
    )
    parser.add_argument("bag", metavar="BAG", help="a rosbag2: a folder, or one .mcap or .db3 file")
    parser.add_argument("--world", metavar="FILE|NAME", help="file of a world, or name of a built-in world")
    parser.add_argument(
        "--scenario", metavar="FILE", help="scenario file, as `mrpbench scenario CONFIG --write FILE` writes it"
    )
    parser.add_argument(
        "--robots", default="", metavar="A,B,…", help="names or patterns of the robots, in the order of the scenario"
    )
    parser.add_argument(
        "--robot", default="turtlebot3_burger", metavar="MODEL", help="robot model (default: %(default)s)"
    )
    parser.add_argument("--fleet", metavar="NAME", help="name of the fleet in /fleet_states, if there are several")
    parser.add_argument(
        "--start-time", type=float, metavar="S", help="ignore everything before this time, in seconds from the start"
    )
    parser.add_argument("--end-time", type=float, metavar="S", help="ignore everything after this time")
    parser.add_argument("--rate", type=float, default=10.0, metavar="HZ", help="sampling rate (default: %(default)g)")
    parser.add_argument(
        "--max-gap",
        type=float,
        default=2.0,
        metavar="S",
        help="longest gap in the poses of a moving robot whose position still counts as known (default: %(default)g)",
    )
    parser.add_argument(
        "--tolerance",
        type=float,
        default=0.25,
        metavar="M",
        help="distance at which a goal counts as reached (default: %(default)g)",
    )
    parser.add_argument("--metrics", metavar="A,B", help="metrics to compute (default: those that a run computes)")
    parser.add_argument("--format", default="rosbag2", metavar="NAME", help="format of BAG (default: %(default)s)")
    parser.add_argument("--importer", metavar="NAME", help=argparse.SUPPRESS)  # its name in release 0.2
    parser.add_argument("--option", action="append", default=[], metavar="K=V", help="option of the format")
    parser.add_argument("--label", default="recorded", help="value of `simulator` in tables (default: %(default)s)")
    parser.add_argument("--out", metavar="DIR", help="results folder (default: results/<name of BAG>)")
    parser.add_argument("--json", action="store_true", help="print the record as JSON")


def run(arguments: argparse.Namespace) -> int:
    """Measure the bag, store the record and print it."""
    from mrpbench_core.engine.processes.call import in_worker

    if arguments.importer is not None:
        sys.stderr.write("note: --importer is now --format; the next release does not read the old name\n")
        arguments.format = arguments.importer
    out = arguments.out or str(Path("results", followed(arguments.bag).stem))
    record = in_worker(f"{arguments.bag} cannot be analyzed", analyzed, {**vars(arguments), "out": out})
    print_json(record) if arguments.json else _print(record, out)
    return 0


def analyzed(words: dict[str, Any]) -> dict[str, Any]:
    """In a worker process: measure the bag and store the record; return it."""
    from mrpbench_analysis.analysis import Analysis, analyze
    from mrpbench_analysis.observed_run import Sampling
    from mrpbench_core.api.format import ReadableFormat
    from mrpbench_core.api.metric import Metric
    from mrpbench_core.cli.input.world import world_source
    from mrpbench_core.config.settings import default_plugin

    arguments = argparse.Namespace(**words)
    for name in ("rate", "max_gap", "tolerance"):
        if not 0 < getattr(arguments, name) < float("inf"):
            raise InputError(f"--{name.replace('_', '-')}: must be above 0, got {getattr(arguments, name):g}")
    metrics = default_plugin("metrics") if arguments.metrics is None else _names(arguments.metrics)
    options = {"plugin": arguments.format, **read_options(arguments.option, "--option")}
    if arguments.fleet is not None:
        options["fleet"] = arguments.fleet
    analysis = Analysis(
        bag=Path(arguments.bag),
        format=_component(ReadableFormat, options, "--format"),
        metrics={name: _component(Metric, {"plugin": name}, "--metrics") for name in metrics},
        world=None if arguments.world is None else world_source(arguments.world),
        scenario=None if arguments.scenario is None else Path(arguments.scenario),
        robot=arguments.robot,
        robots=_names(arguments.robots),
        sampling=Sampling(
            rate=arguments.rate,
            max_gap=arguments.max_gap,
            tolerance=arguments.tolerance,
            since=arguments.start_time,
            until=arguments.end_time,
        ),
        label=arguments.label,
        out=Path(arguments.out),
    )
    return analyze(analysis)


def _names(text: str) -> tuple[str, ...]:
    return tuple(name.strip() for name in text.split(",") if name.strip())


def _component(kind: Any, options: dict[str, Any], key: str) -> Any:
    from mrpbench_core.config.items import Location, from_data
    from mrpbench_core.config.structure import structure_component

    return structure_component(kind, from_data(options, Location()), key, Path.cwd())


def _print(record: dict[str, Any], out: str) -> None:
    reasons = record["unmeasured"]
    rows = []
    for key, value in record["metrics"].items():
        reason = reasons.get(key) or reasons.get(key.partition(".")[0]) or ""
        rows.append([key, f"{value:.6g}" if isinstance(value, float) else value, "" if value is not None else reason])
    partial = " (partial: the recording ends early)" * (record["status"] == RunStatus.UNKNOWN)
    print_table(["metric", f"value{partial}", "reason for null"], rows)
    print(f"{record['status']}, scenario {record['scenario_id']}")
    sources: dict[str, list[str]] = {}
    for robot, source in record["analysis"]["sources"].items():
        sources.setdefault(source.partition(":")[0], []).append(robot)
    for source, robots in sources.items():
        print(f"positions from {source}: {counted(len(robots), 'robot')} ({', '.join(robots[:SHOWN])})")
    notes = record["analysis"]["notes"]
    for note in notes[:SHOWN]:
        print(f"note: {note}")
    if len(notes) > SHOWN:
        print(f"… {counted(len(notes) - SHOWN, 'more note')}; --json lists all")
    print(f"{out}:{record['run_id']}")
