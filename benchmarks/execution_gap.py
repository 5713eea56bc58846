"""Measure the gap between planned and executed time: how well plans predict their execution.

Robots cross the built-in worlds by plans for each model of durations, in a simulator without noise, with each
controller. The gap of a run is the sum of the executed arrival times divided by that of the planned ones, minus
one. The last line of a table has the median size of the gaps.

`kinodynamic` assumes the robot's limits; `calibrated` is `kinodynamic` with `speed_share`, `turn_penalty` and
`stop_penalty` fitted to other drives, as `mrpbench calibrate` does: of one robot alone, in the office. Times are
simulated, so the load of the machine does not matter, except that a planner may time out.
"""

import argparse
import tempfile
from collections.abc import Iterator, Mapping
from statistics import median
from typing import Any

from mrpbench_analysis.calibration import calibrate, drive_of

from mrpbench_core import run
from mrpbench_core.model.runs.arrivals import arrival_times
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.store.results import Results

WORLDS, ROBOTS = ["office", "warehouse", "airport"], [5, 10, 20, 50]
CONTROLLERS, MODELS = ["pure_pursuit", "dwb"], ["constant", "kinodynamic", "calibrated"]
ALONE = range(1000, 1020)
"""Seeds of the drives for the calibration."""


def drive(
    options: argparse.Namespace, roadmap: Mapping[str, Any], controller: str, matrix: Mapping[str, Any]
) -> Iterator[tuple[Results, Any]]:
    """Yield the records of all runs of a matrix, with the results that hold them."""
    study = {
        "name": "gap",
        "world": "office",
        "roadmap": {"plugin": options.roadmap, **roadmap},
        "scenario": {"plugin": "random", "robots": 1},
        "assigner": "identity",
        "planner": options.planner,
        "controller": controller,
        "simulator": options.simulator,
        "metrics": ["planning", "throughput"],
        "limits": {"planning": "60 s", "execution": "60 min"},
        "matrix": dict(matrix),
    }
    with tempfile.TemporaryDirectory() as folder:
        results = run(study, out=folder)
        for record in results:
            yield results, record


def calibrated(options: argparse.Namespace, controller: str) -> dict[str, Any]:
    """The options of the roadmap with which it predicts the drives of one robot best."""
    kinodynamic = {"duration_model": "kinodynamic"}
    drives = []
    for results, record in drive(options, kinodynamic, controller, {"seed": list(ALONE)}):
        recording = results.recording(record["run_id"])
        context = recording.first_context()
        (arrival,) = arrival_times(FinishedRun(context=context, executed=True, channels=recording.channels))
        drives.append(drive_of(context, float(arrival)))
    found = calibrate(drives)
    print(f"{controller}: {found}", flush=True)
    return kinodynamic | found.options


def measure(options: argparse.Namespace, model: str, controller: str) -> list[float]:
    """Print the rows of a controller; return the gaps in percent."""
    roadmap = calibrated(options, controller) if model == "calibrated" else {"duration_model": model}
    matrix = {"world": options.worlds, "scenario.robots": options.robots, "seed": list(range(options.seeds))}
    gaps = []
    for _, record in drive(options, roadmap, controller, matrix):
        robots = record["config"]["scenario"]["robots"]
        print(f"| {record['config']['world']['plugin']} | {controller} | {robots} | {record['seed']} |", end="")
        if record["status"] != "succeeded":
            print(f" {record['status']} | | |", flush=True)
            continue
        planned = record["metrics"]["planning.sum_of_costs"]
        executed = robots * record["metrics"]["throughput.service_mean_s"]
        gaps.append(100 * (executed / planned - 1))
        print(f" {planned:.1f} | {executed:.1f} | {gaps[-1]:+.1f} |", flush=True)
    return gaps


def main() -> None:
    """Print one table per model."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--worlds", nargs="+", default=WORLDS)
    parser.add_argument("--robots", nargs="+", type=int, default=ROBOTS)
    parser.add_argument("--controllers", nargs="+", default=CONTROLLERS)
    parser.add_argument("--models", nargs="+", default=MODELS, choices=MODELS)
    parser.add_argument("--simulator", default="planar", choices=["planar", "pybullet"])
    parser.add_argument("--roadmap", default="lanes", choices=["lanes", "grid"])
    parser.add_argument("--planner", default="pbs")
    parser.add_argument("--seeds", type=int, default=3)
    options = parser.parse_args()
    for model in options.models:
        print(f"\n{model}\n| world | controller | robots | seed | planned s | executed s | gap % |")
        print("|---|---|---:|---:|---:|---:|---:|", flush=True)
        gaps = [gap for controller in options.controllers for gap in measure(options, model, controller)]
        print(f"median of |gap| over {len(gaps)} runs: {median(map(abs, gaps)):.1f} %", flush=True)


if __name__ == "__main__":
    main()
