"""Compares a planner on the starts and goals of POGEMA's benchmark with the results that are published there.

    python benchmarks/pogema_tables.py [--benchmark FOLDER] [--set 03-warehouse] [--algorithm LaCAM] [--planner lacam]
        [--robots 32] [--seeds 10]

FOLDER is a checkout of https://github.com/CognitiveAISystems/pogema-benchmark, or `build/pogema/benchmark`, where `make
pogema` writes the problems of `01-random`; without it, the excerpt of it that the tests have: 3 seeds of the warehouse
with 32 and 64 robots. Robots are points on the grid (`simulator: none`), and the
metrics are those of POGEMA. Of the published ones CSR, SoC and makespan are read; `ep_length` has another meaning.
Planners that improve their plans do so in 300 iterations, so that results do not depend on the machine.

Some published makespans of `03-warehouse` are less than the longest of the shortest ways of the published starts and
goals: those runs had others, and only means can be compared. Where no run shows it, runs are compared in pairs, too.
"""

import argparse
import json
import statistics
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import attrs
import yaml
from mrpbench_policies.maps import Maps
from mrpbench_policies.pogema.files import read_map, read_scenario

from mrpbench_core.api import InputError
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.store.paths import RunPaths

EXCERPT = Path(__file__).parents[1] / "plugins" / "policies" / "tests" / "pogema" / "excerpt"
MEASURES = ("CSR", "SoC", "makespan")


def published(benchmark: Path, name: str, algorithm: str) -> Iterator[tuple[dict[str, Any], dict[str, float]]]:
    """Yield the map, the seed and the number of robots of each published run, and its metrics.

    Raises:
        InputError: the folder has no such results.
    """
    file = benchmark / "raw_data_MAPF" / name / f"{algorithm}.json"
    if not file.exists():
        known = ", ".join(sorted(it.stem for it in file.parent.glob("*.json"))) or "no results of this set"
        raise InputError("there is no such file", file=file, hint=f"there are: {known}")
    for row in json.loads(file.read_text()):
        yield row["env_grid_search"], {measure: float(row["metrics"][measure]) for measure in MEASURES}


def experiment_of(benchmark: Path, name: str) -> tuple[Path, dict[str, Any]]:
    """Return the file of starts and goals of a set, and its block `environment`."""
    file = benchmark / "algorithms" / "experiments" / name / f"{name}-mapf.yaml"
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    environment: dict[str, Any] = yaml.load(file.read_text(), loader)["environment"]  # noqa: S506 - a safe loader
    return file, environment


def measured(file: Path, environment: dict[str, Any], asked: dict[str, Any], planner: str) -> dict[str, float]:
    """Return the metrics of a planner on the scenario that a published run had."""
    study = {
        "name": "pogema",
        "world": {
            "plugin": "pogema",
            "file": str(file.with_name("maps.yaml")),
            "map": asked.get("map_name", environment["map_name"]),
        },
        "roadmap": "grid",
        "scenario": {"plugin": "pogema", "file": str(file), "robots": asked["num_agents"]},
        "fleet": {"robot": "turtlebot3_burger", "lidar": "none"},
        "planner": yaml.safe_load(planner),
        "simulator": "none",
        "limits": {"planning": "60 s", "iterations": 300},
        "seed": asked.get("seed", 0),
        "metrics": [{"plugin": "pogema", "steps": environment["max_episode_steps"]}],
    }
    with tempfile.TemporaryDirectory() as folder:
        paths = RunPaths(recording=Path(folder) / "run.zip", exports=Path(folder))
        record = execute(load_study(study).runs[0].config, "run", paths)
    if record.metrics.get("pogema.CSR") is None:
        raise InputError(f"{asked}: {record.status}", hint=record.reason or None)
    values = {measure: record.metrics[f"pogema.{measure}"] for measure in MEASURES}
    return {measure: float("nan") if value is None else float(value) for measure, value in values.items()}


def longest_way(file: Path, environment: dict[str, Any], asked: dict[str, Any]) -> int:
    """Return the steps of the longest of the shortest ways of the robots, less than which no makespan is."""
    name = asked.get("map_name", environment["map_name"])
    listed = read_scenario(file, name, asked.get("seed", 0))
    maps = Maps(read_map(file.with_name("maps.yaml"), name)[None], 1)
    start = maps.places(listed.start[None])[0][: asked["num_agents"]].tolist()
    goals = (int(maps.places_in(0, cells)[-1]) for cells in listed.goals)
    return max(int(maps.distances(goal)[place]) for place, goal in zip(start, goals, strict=False))


@attrs.frozen(kw_only=True)
class Pair:
    """A scenario."""

    ours: dict[str, float]
    """The metrics of the planner."""
    published: dict[str, float]
    contradicted: bool
    """The published makespan is less than the longest of the shortest ways."""


def compare(
    benchmark: Path, name: str, algorithm: str, planner: str, robots: int | None = None, seeds: int | None = None
) -> dict[int, list[Pair]]:
    """Return the metrics of the planner and the published ones, by number of robots."""
    file, environment = experiment_of(benchmark, name)
    pairs: dict[int, list[Pair]] = {}
    for asked, theirs in published(benchmark, name, algorithm):
        count = asked["num_agents"]
        if robots in (None, count) and (seeds is None or asked.get("seed", 0) < seeds):
            ours = measured(file, environment, asked, planner)
            contradicted = theirs["makespan"] < longest_way(file, environment, asked)
            pairs.setdefault(count, []).append(Pair(ours=ours, published=theirs, contradicted=contradicted))
    return pairs


def interval(values: list[float]) -> str:
    """Return a mean, and how far its 95 % interval by the normal distribution reaches."""
    mean = statistics.mean(values)
    if len(values) < 2:
        return f"{mean:.1f}"
    return f"{mean:.1f} ± {1.96 * statistics.stdev(values) / len(values) ** 0.5:.1f}"


def main() -> None:
    """Compare, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--benchmark", type=Path, default=EXCERPT)
    parser.add_argument("--set", default="03-warehouse")
    parser.add_argument("--algorithm", default="LaCAM")
    parser.add_argument("--planner", default="lacam", help="as in a study, e.g. '{plugin: lacam, anytime: false}'")
    parser.add_argument("--robots", type=int)
    parser.add_argument("--seeds", type=int, help="seeds below this one")
    wanted = parser.parse_args()
    pairs = compare(wanted.benchmark, wanted.set, wanted.algorithm, wanted.planner, wanted.robots, wanted.seeds)
    print(f"{wanted.set}: {wanted.planner}, and in brackets {wanted.algorithm} as published")
    for robots, some in sorted(pairs.items()):
        rates = (statistics.mean(run["CSR"] for run in runs) for runs in sides(some))
        print("{} robots, {} runs: CSR {:.3f} ({:.3f})".format(robots, len(some), *rates))
        for measure in ("SoC", "makespan"):
            solved = [[run[measure] for run in runs if run["CSR"] == 1.0] for runs in sides(some)]
            if all(solved):
                print("    {} of solved runs {} ({})".format(measure, *map(interval, solved)))
        if wrong := sum(pair.contradicted for pair in some):
            print(f"    at least {wrong} of the published runs had other starts and goals than are published")
        else:
            print(f"    {paired(some)}")


def paired(pairs: list[Pair]) -> str:
    """Return by how much costs differ, for runs of the same problem that both solve."""
    costs = [
        (pair.ours["SoC"], pair.published["SoC"]) for pair in pairs if pair.ours["CSR"] == pair.published["CSR"] == 1
    ]
    equal = sum(ours == published for ours, published in costs)
    differences = [100 * (ours / published - 1) for ours, published in costs]
    return (
        f"SoC in pairs: {equal} of {len(costs)} equal, {interval(differences)} % more" if costs else "no solved pairs"
    )


def sides(pairs: list[Pair]) -> tuple[list[dict[str, float]], list[dict[str, float]]]:
    """Return the metrics of the planner, and the published ones."""
    return [pair.ours for pair in pairs], [pair.published for pair in pairs]


if __name__ == "__main__":
    main()
