"""`mrpbench export RUN --to NAME`: write a stored run in another format."""

import argparse
from pathlib import Path

from mrpbench_core.api.exporter import Exporter
from mrpbench_core.cli.input.arguments import read_options
from mrpbench_core.cli.input.run_reference import HELP, find_run
from mrpbench_core.config.items import Location, from_data
from mrpbench_core.config.structure import structure_component


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("run", metavar="RUN", help=HELP)
    parser.add_argument("--to", required=True, metavar="NAME", help="exporter, e.g. rosbag2")
    parser.add_argument("--option", action="append", default=[], metavar="K=V", help="option of the exporter")
    parser.add_argument(
        "--out", metavar="FILE", help="destination without suffix (default: exports/ in the results folder)"
    )


def run(arguments: argparse.Namespace) -> int:
    """Write the run's recording in another format."""
    results, record = find_run(arguments.run)
    block = from_data({"plugin": arguments.to, **read_options(arguments.option, "--option")}, Location())
    exporter = structure_component(Exporter, block, "--to", Path.cwd())  # type: ignore[type-abstract]
    recording = results.recording(record["run_id"])
    destination = (
        results.paths(record["run_id"]).exports / arguments.to if arguments.out is None else Path(arguments.out)
    )
    destination.parent.mkdir(parents=True, exist_ok=True)
    session = exporter.open(recording.first_context(), destination)
    for chunk in recording.chunks():
        session.write(chunk)
    session.close()
    recording.close()
    written = sorted(destination.parent.glob(f"{destination.name}*"))
    print("wrote " + " ".join(map(str, written)))
    return 0
