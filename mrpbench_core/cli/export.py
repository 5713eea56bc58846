"""`mrpbench export RUN --to NAME`: write a stored run in another format."""

import argparse
from pathlib import Path
from typing import Any

from mrpbench_core.api.format import WritableFormat
from mrpbench_core.cli.input.arguments import read_options
from mrpbench_core.cli.input.run_reference import HELP, find_run
from mrpbench_core.config.items import Location, from_data
from mrpbench_core.config.structure import structure_component
from mrpbench_core.engine.processes.call import in_worker


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("run", metavar="RUN", help=HELP)
    parser.add_argument("--to", required=True, metavar="NAME", help="format, e.g. rosbag2")
    parser.add_argument("--option", action="append", default=[], metavar="K=V", help="option of the format")
    parser.add_argument(
        "--out", metavar="FILE", help="destination without suffix (default: exports/ in the results folder)"
    )


def run(arguments: argparse.Namespace) -> int:
    """Write the run's recording in another format."""
    options = {"plugin": arguments.to, **read_options(arguments.option, "--option")}
    written = in_worker(f"{arguments.run} cannot be exported", export, arguments.run, options, arguments.out)
    print("wrote " + " ".join(written))
    return 0


def export(run: str, options: dict[str, Any], out: str | None) -> list[str]:
    """In a worker process: export a run; return the files and folders written."""
    results, record = find_run(run)
    chosen = structure_component(WritableFormat, from_data(options, Location()), "--to", Path.cwd())  # type: ignore[type-abstract]
    recording = results.recording(record["run_id"])
    destination = results.paths(record["run_id"]).exports / options["plugin"] if out is None else Path(out)
    destination.parent.mkdir(parents=True, exist_ok=True)
    writer = chosen.open(recording.first_context(), destination)
    for chunk in recording.chunks():
        writer.write(chunk)
    writer.close()
    recording.close()
    return [str(file) for file in sorted(destination.parent.glob(f"{destination.name}*"))]
