"""Compares a planner on the one-shot problems of POGEMA's benchmark with the results that are published there.

    python benchmarks/pogema_tables.py [--benchmark FOLDER] [--set 03-warehouse] [--planner lacam] [--robots 32]
        [--problems 16]

FOLDER is `build/pogema/benchmark`, where `make pogema` writes the problems, or a checkout of
https://github.com/CognitiveAISystems/pogema-benchmark; without it, the excerpt of it that the tests have: 3 seeds of
the warehouse with up to 64 robots. Robots are points on the grid (`simulator: none`), and the metrics are those of
POGEMA. Planners that improve their plans do so in 300 iterations, so that results do not depend on the machine.

Published means were counted in the published results of all problems of a set; results of single runs, with which a
planner is compared in pairs, are read from FOLDER/raw_data_MAPF. `ep_length` has another meaning there and is not read.
"""

import argparse
import json
import statistics
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from mrpbench_core.api import InputError
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.store.paths import RunPaths

EXCERPT = Path(__file__).parents[1] / "plugins" / "policies" / "tests" / "pogema" / "excerpt"
MEASURES = ("CSR", "SoC", "makespan")
ALGORITHM = "LaCAM"
PUBLISHED = {
    ("01-random", 32): (1.000, 503.6),
    ("01-random", 64): (1.000, 1213.6),
    ("02-mazes", 32): (1.000, 625.7),
    ("02-mazes", 64): (0.906, 2011.1),
    ("03-warehouse", 96): (1.000, 2998.6),
}
"""Mean CSR and SoC of LaCAM over the 128 problems of a set, by set and number of robots."""

Problem = tuple[str, int, int]
"""A map, a seed and a number of robots."""
Metrics = Mapping[str, float]


def published(benchmark: Path, name: str) -> dict[Problem, Metrics]:
    """Return the metrics of each published run of a set.

    Raises:
        InputError: the folder has no such results.
    """
    file = benchmark / "raw_data_MAPF" / name / f"{ALGORITHM}.json"
    if not file.exists():
        known = ", ".join(sorted(it.parent.name for it in file.parents[1].glob(f"*/{ALGORITHM}.json")))
        raise InputError("there is no such file", file=file, hint=f"there are results of {known or 'no set'}")
    runs = json.loads(file.read_text())
    return {problem_of(run["env_grid_search"]): run["metrics"] for run in runs}


def problem_of(asked: Mapping[str, Any]) -> Problem:
    """Return the problem of a published run; the set of one map does not name it, sets of one seed not that."""
    return asked.get("map_name", "wfi_warehouse"), asked.get("seed", 0), asked["num_agents"]


def read_set(file: Path) -> tuple[list[tuple[str, int]], int]:
    """Return the maps and seeds of the problems of a set, and the steps of an episode."""
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    document = yaml.load(file.read_text(), loader)  # noqa: S506 - a safe loader
    listed = [(scenario["map_name"], scenario["seed"]) for scenario in document["scenarios"].values()]
    return listed, document["environment"]["max_episode_steps"]


def measured(file: Path, problem: Problem, steps: int, planner: str) -> Metrics:
    """Return the metrics of a planner on a problem of a set."""
    name, seed, robots = problem
    study = {
        "name": "pogema",
        "world": {"plugin": "pogema", "file": str(file.with_name("maps.yaml")), "map": name},
        "roadmap": "grid",
        "scenario": {"plugin": "pogema", "file": str(file), "robots": robots},
        "fleet": {"robot": "turtlebot3_burger", "lidar": "none"},
        "planner": yaml.safe_load(planner),
        "simulator": "none",
        "limits": {"planning": "60 s", "iterations": 300},
        "seed": seed,
        "metrics": [{"plugin": "pogema", "steps": steps}],
    }
    with tempfile.TemporaryDirectory() as folder:
        paths = RunPaths(recording=Path(folder) / "run.zip", exports=Path(folder))
        record = execute(load_study(study).runs[0].config, "run", paths)
    if record.metrics.get("pogema.CSR") is None:
        raise InputError(f"{problem}: {record.status}", hint=str(record.error) if record.error else None)
    return {measure: float(record.metrics[f"pogema.{measure}"]) for measure in MEASURES}


def compare(benchmark: Path, name: str, planner: str, robots: int, count: int | None = None) -> dict[Problem, Metrics]:
    """Return the metrics of a planner on the first problems of a set."""
    file = benchmark / "algorithms" / "experiments" / name / f"{name}-mapf.yaml"
    listed, steps = read_set(file)
    asked = [(*problem, robots) for problem in listed[:count]]
    return {problem: measured(file, problem, steps, planner) for problem in asked}


def interval(values: list[float]) -> str:
    """Return a mean, and how far its 95 % interval by the normal distribution reaches."""
    mean = statistics.mean(values)
    if len(values) < 2:
        return f"{mean:.1f}"
    return f"{mean:.1f} ± {1.96 * statistics.stdev(values) / len(values) ** 0.5:.1f}"


def paired(ours: Mapping[Problem, Metrics], theirs: Mapping[Problem, Metrics]) -> str:
    """Return by how much costs differ from the published ones, on problems that both solve."""
    both = [(run, theirs[problem]) for problem, run in ours.items() if problem in theirs]
    costs = [(run["SoC"], other["SoC"]) for run, other in both if run["CSR"] == other["CSR"] == 1]
    if not costs:
        return "no results of single runs of these problems are at hand"
    equal = sum(cost == published for cost, published in costs)
    differences = [100 * (cost / published - 1) for cost, published in costs]
    solved = sum(other["CSR"] for _, other in both)
    return (
        f"SoC in pairs: {equal} of {len(costs)} equal, {interval(differences)} % more; published runs solve "
        f"{solved:.0f} of {len(both)}"
    )


def main() -> None:
    """Compare, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--benchmark", type=Path, default=EXCERPT)
    parser.add_argument("--set", default="03-warehouse")
    parser.add_argument("--planner", default="lacam", help="as in a study, e.g. '{plugin: lacam, anytime: false}'")
    parser.add_argument("--robots", type=int, nargs="*", default=[32])
    parser.add_argument("--problems", type=int, help="the first ones only")
    wanted = parser.parse_args()
    theirs = published(wanted.benchmark, wanted.set)
    for robots in wanted.robots:
        ours = compare(wanted.benchmark, wanted.set, wanted.planner, robots, wanted.problems)
        csr, soc, makespan = ([run[measure] for run in ours.values()] for measure in MEASURES)
        print(f"{wanted.set}, {robots} robots, {len(ours)} problems, {wanted.planner}: ", end="")
        print(f"CSR {statistics.mean(csr):.3f}, SoC {interval(soc)}, makespan {interval(makespan)}", flush=True)
        if (wanted.set, robots) in PUBLISHED:
            print("    {} as published: CSR {:.3f}, SoC {:.1f}".format(ALGORITHM, *PUBLISHED[wanted.set, robots]))
        print(f"    {paired(ours, theirs)}", flush=True)


if __name__ == "__main__":
    main()
