"""Measure the variation between runs of one robot on one path: 45 cells of 0.35 m, with noise.

Schaefer et al., "A Benchmark for Multi-Robot Planning in Realistic, Complex and Cluttered Environments", ICRA 2023,
report a standard deviation of 0.4 s over 100 runs. Prints the same for `dwb` in the planar simulator.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np

from mrpbench_core import load, run
from mrpbench_core.model.runs.status import RunStatus

CELLS = 45


def write_corridor(folder: Path) -> None:
    """A map with a path of 45 cells round two corners, and the scenario that takes it."""
    rows, columns, corner, turn = 13, 23, 20, 10
    goal = corner - (CELLS - (corner - 1) - (turn - 1))
    grid = np.full((rows, columns), "@")
    grid[1, 1 : corner + 1] = "."
    grid[1 : turn + 1, corner] = "."
    grid[turn, goal : corner + 1] = "."
    text = "\n".join("".join(row) for row in grid)
    (folder / "corridor.map").write_text(f"type octile\nheight {rows}\nwidth {columns}\nmap\n{text}\n")
    place = f"1\t1\t{goal}\t{turn}\t{CELLS}"
    (folder / "corridor.scen").write_text(f"version 1\n0\tcorridor.map\t{columns}\t{rows}\t{place}\n")


def durations(repeats: int, simulator: str, folder: Path) -> list[float]:
    """Seconds of every run; all must arrive."""
    write_corridor(folder)
    study = {
        "name": "replicability",
        "world": {"plugin": "movingai", "file": str(folder / "corridor.map"), "resolution": 0.35},
        "roadmap": {"plugin": "grid"},
        "scenario": {"plugin": "movingai", "file": str(folder / "corridor.scen"), "robots": 1},
        "fleet": "turtlebot3_burger",
        "assigner": "identity",
        "planner": "astar",
        "controller": "dwb",
        "simulator": simulator,
        "noise": {"lidar": 0.01, "odometry": 0.01, "actuation": 0.02},
        "metrics": ["execution"],
        "recording": {"keep": "none", "rate": "20 Hz"},
        "matrix": {"repeat": f"0..{repeats - 1}"},
    }
    run(study, out=folder / "results")
    records = list(load(folder / "results"))
    if any(record["status"] != RunStatus.SUCCEEDED for record in records):
        raise SystemExit(f"not all arrived: {[record['status'] for record in records]}")
    return [float(record["metrics"]["execution.duration_s"]) for record in records]


def main() -> None:
    """Measure the rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("repeats", nargs="?", type=int, default=100)
    parser.add_argument("--simulator", default="planar")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        found = np.array(durations(options.repeats, options.simulator, Path(name)))
    print(f"{len(found)} runs: mean {found.mean():.2f} s, standard deviation {found.std(ddof=1):.3f} s (paper: 0.4 s)")


if __name__ == "__main__":
    main()
