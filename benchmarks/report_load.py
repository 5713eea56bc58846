"""Measure a report on many runs: `python benchmarks/report_load.py [RUNS]`, 100,000 by default.

Writes records as `mrpbench run` does, of four planners with three numbers of robots, and prints CPU seconds and peak
memory of `mrpbench report` in a process of its own, and the size of the page.
"""

import json
import resource
import sys
import tempfile
import time
from pathlib import Path

import msgspec
import numpy as np

from mrpbench_core.cli.main import main as mrpbench

PLANNERS = ("cbs", "ecbs", "prioritized", "lacam")
ROBOTS = (5, 10, 20)
METRICS = ("planning.makespan_s", "planning.sum_of_costs_s", "execution.duration_s", "execution.robot_contacts")
EXTRA = 30
"""Further metrics of each run, about as many as a run with the standard metrics has."""
COMPONENTS = (
    "world",
    "roadmap",
    "scenario",
    "assigner",
    "planner",
    "dispatcher",
    "navigator",
    "controller",
    "simulator",
)
COLUMN = {
    "unit": "s",
    "better": "lower",
    "description": "how long",
    "source": "",
    "primary": True,
    "stage": "execution",
}


def record(number: int, chance: np.random.Generator) -> dict[str, object]:
    """Return the record with this number."""
    seed, kind = divmod(number, len(PLANNERS) * len(ROBOTS))
    planner, robots = PLANNERS[kind % len(PLANNERS)], ROBOTS[kind // len(PLANNERS)]
    failed = chance.random() < 0.1
    cost = 20.0 * robots + seed % 50 + 3 * chance.random()
    values = dict.fromkeys(METRICS) if failed else {name: cost * (1 + 0.1 * chance.random()) for name in METRICS}
    values |= {f"extra.value_{index}": None if failed else cost / (index + 1) for index in range(EXTRA)}
    config = {key: {"plugin": "default", "option": 0.5, "other": [1, 2]} for key in COMPONENTS}
    config |= {"planner": {"plugin": planner}, "scenario": {"plugin": "random", "robots": robots}, "seed": seed}
    config |= {"repeat": 0, "name": "load", "limits": {"planning": 10.0, "execution": 600.0, "wall": 1800.0}}
    found = {
        "run_id": f"{number:016x}",
        "scenario_id": f"{seed * 31 + robots:016x}",
        "attempt": 1,
        "config": config,
        "seed": seed,
        "repeat": 0,
        "status": "plan_timeout" if failed else "succeeded",
        "metrics": values,
        "timing": {"planning_s": 10.0 if failed else 5 * chance.random(), "planning_cpu_s": 1.0, "clock_bound": failed},
        "provenance": {
            "components": [
                {"kind": key, "name": "default", "distribution": "mrpbench-core", "version": "0.1"}
                for key in COMPONENTS
            ],
            "versions": {f"distribution-{index}": "1.0" for index in range(12)},
            "machine": {"node": "n1", "processor": "x", "cores": 2, "memory_bytes": 2**33, "system": "Linux"},
            "live": False,
            "files": [f"{number:064x}  recordings/{number:016x}.zip"],
        },
    }
    error = {"stage": "planning", "message": f"no plan within {chance.random():.3f} s"}
    return found | {"error": error} if failed else found


def write(folder: Path, runs: int) -> None:
    """Write a results folder."""
    for part in ("runs", "invocations"):
        (folder / part).mkdir()
    columns = dict.fromkeys(METRICS, COLUMN)
    (folder / "invocations" / "1.yaml").write_text(json.dumps({"columns": columns}))
    chance = np.random.default_rng(0)
    with (folder / "runs" / "1.jsonl").open("wb") as stream:
        for number in range(runs):
            stream.write(msgspec.json.encode(record(number, chance)) + b"\n")


def main(runs: int) -> None:
    """Print a line of numbers."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write(folder, runs)
        size = (folder / "runs" / "1.jsonl").stat().st_size
        began = time.process_time()
        mrpbench(["report", name, "--csv", str(folder / "a.csv")])
        spent = time.process_time() - began
        page = (folder / "report.html").stat().st_size
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(f"{runs} runs, {size / 1e6:.0f} MB: {spent:.1f} s of CPU, {peak / 1024:.0f} MiB, page of {page / 1e6:.2f} MB")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100_000)
