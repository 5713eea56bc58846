"""Score local planners in worlds of the BARN challenge, with its task and limits; the robot drives 2 m/s at most.

    python benchmarks/barn.py --data ../shared/data/barn --every 12 --controllers graceful rpp

As in the challenge, the robot does not know the field: `global_planner` plans on what its lidar has seen. With
`--known`, `astar` plans on the whole field instead.
`--data` holds the tables cylinders.csv.gz and paths.csv.gz, see docs/reference/worlds.md. Prints for each controller
the mean of `barn.score` (at most 0.5) with a 95 % interval over worlds, the numbers of successes and of runs with
contacts, and the median time of successes. `--out` keeps the runs; the same command continues after an interruption.
"""

import argparse
import csv
import gzip
from pathlib import Path
from typing import Any

import numpy as np

from mrpbench_core import run
from mrpbench_core.report.statistics.means import mean

HERE = Path(__file__).parent
CONTROLLERS: dict[str, dict[str, Any]] = {
    "graceful": {"v_linear_max": 2.0},
    "rpp": {"max_linear_vel": 1.2},
    "mppi": {"vx_max": 2.0, "vx_std": 0.4},
    "dwb": {"max_vel_x": 2.0, "max_speed_xy": 2.0},
}
"""Each with Nav2's defaults but for the speed, and for the deviation of the samples of MPPI, which grows with it."""


def study(data: Path, controller: str, worlds: list[int], seeds: int, known: bool = False) -> dict[str, Any]:
    """Return the configuration of the runs of one controller, in fields that are `known` or not."""
    local = {"plugin": controller, **CONTROLLERS[controller]}
    planned_at_once = {
        "roadmap": {"plugin": "grid", "cell_size": 0.15},
        "plan_filter": "mrp_bench_stairs",
        "navigator": {"plugin": "waypoints", "path_end": "release"},
        "controller": local,
    }
    planned_on_the_way = {
        "roadmap": "straight",
        "controller": {"plugin": "global_planner", "primary_controller": local, "replan_frequency": 5.0},
    }
    return {
        "name": f"barn-{controller}",
        "world": {"plugin": "barn", "file": str(data / "cylinders.csv.gz"), "path": str(data / "paths.csv.gz")},
        "scenario": "barn",
        "fleet": str(HERE / "jackal.yaml"),
        "planner": "astar",
        "dispatcher": "all_at_once",
        **(planned_at_once if known else planned_on_the_way),
        "simulator": "planar",
        "limits": {"execution": "100 s"},
        "metrics": ["execution", "barn"],
        "matrix": {"world.index": worlds, "seed": list(range(seeds))},
    }


def main() -> None:
    """Run the studies and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--controllers", nargs="+", choices=list(CONTROLLERS), default=list(CONTROLLERS))
    parser.add_argument("--every", type=int, default=1, help="take worlds whose number is a multiple of this")
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--known", action="store_true", help="let astar plan on the whole field")
    parser.add_argument("--out", type=Path, default=Path("results"))
    given = parser.parse_args()
    with gzip.open(given.data / "cylinders.csv.gz", "rt") as stream:
        worlds = sorted({int(row["world"]) for row in csv.DictReader(stream)})
    worlds = [world for world in worlds if world % given.every == 0]
    print("| controller | worlds | runs | score | successes | with contacts | median time |")
    print("|---|---|---|---|---|---|---|", flush=True)
    for controller in given.controllers:
        config = study(given.data.resolve(), controller, worlds, given.seeds, given.known)
        folder = f"barn-{controller}-known" if given.known else f"barn-{controller}"
        print(row(controller, list(run(config, out=given.out / folder))), flush=True)


def row(controller: str, records: list[dict[str, Any]]) -> str:
    """Return the row of one controller; the units of its interval are worlds."""
    scores: dict[int, list[float]] = {}
    for record in records:
        scores.setdefault(record["config"]["world"]["index"], []).append(score_of(record))
    found = mean(np.array([np.mean(own) for own in scores.values()]))
    assert found is not None
    succeeded = [record for record in records if measured(record, "barn.success")]
    touched = sum(bool(measured(record, "execution.wall_contacts")) for record in records)
    times = [record["metrics"]["barn.time_s"] for record in succeeded]
    score = f"{found.value:.3f} ({found.low:.3f} to {found.high:.3f})"
    spent = f"{np.median(times):.1f} s" if times else "–"
    return f"| `{controller}` | {len(scores)} | {len(records)} | {score} | {len(succeeded)} | {touched} | {spent} |"


def measured(record: dict[str, Any], column: str) -> float | None:
    """Return the value of a column, None if the run was not measured."""
    value: float | None = record["metrics"].get(column)
    return value


def score_of(record: dict[str, Any]) -> float:
    """Return the score of a run, 0 if it ended before its execution."""
    return measured(record, "barn.score") or 0.0


if __name__ == "__main__":
    main()
