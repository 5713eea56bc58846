"""`mrpbench calibrate DIR`: fit the durations of a roadmap to how a controller drives."""

import argparse
import math
from collections import defaultdict

from mrpbench_analysis.calibration import Drive, calibrate, drive_of
from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.runs.arrivals import arrival_times
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.report.reading.axes import NO_AXES, find_axes, name_axes
from mrpbench_core.store.results import load

PENALTIES = {"speed_share": 1.0, "turn_penalty": 0.0, "stop_penalty": 0.0}
"""The options that are fitted, and their values in the plans of the drives."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "The runs are drives of one robot alone, with `roadmap: {duration_model: kinodynamic}`, over some 20 seeds."
        " The options printed make plans take the time that the controller takes; set them in `roadmap:`."
    )
    parser.add_argument("folder", metavar="DIR", help="results folder of the drives")
    parser.add_argument("--json", action="store_true", help="print as JSON")


def run(arguments: argparse.Namespace) -> int:
    """Print the options for each configuration."""
    results = load(arguments.folder)
    records = list(results)
    configs = [{key: value for key, value in record["config"].items() if key not in NO_AXES} for record in records]
    drives: dict[str, list[Drive]] = defaultdict(list)
    for record, axes in zip(records, find_axes(configs), strict=True):
        roadmap = record["config"].get("roadmap") or {}
        if any(roadmap.get(name, value) != value for name, value in PENALTIES.items()):
            raise InputError(f"run {record['run_id']} was planned with penalties", hint="leave them out of the drives")
        recording = results.recording(record["run_id"])
        context = recording.first_context()
        run = FinishedRun(context=context, executed=True, channels=recording.channels)
        arrival = float(arrival_times(run)[0]) if context.routes else math.nan
        drives[name_axes(axes) or "all"].append(drive_of(context, arrival))
        recording.close()
    calibrations = {name: calibrate(drives_of_one) for name, drives_of_one in drives.items()}
    if arguments.json:
        print_json(
            [{"configuration": name, "drives": len(drives[name]), **it._asdict()} for name, it in calibrations.items()]
        )
        return 0
    rows = [
        [name, len(drives[name]), *it.options.values(), f"{it.before:+.1%}", f"{it.after:+.1%}"]
        for name, it in calibrations.items()
    ]
    print_table(["configuration", "drives", *PENALTIES, "gap before", "gap after"], rows)
    print("gap: executed by planned time, minus one")
    return 0
