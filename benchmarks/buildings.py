"""Plan and drive trips between floors of buildings that are drawn at random, with doors and lifts.

    python benchmarks/buildings.py
    python benchmarks/buildings.py --robots 9 --planners cbs --buildings 5 --each
    python benchmarks/buildings.py --drive --planners pbs --robots 6 --simulator planar --controller dwb

Prints how many instances each planner solves within the time limit, in CPU seconds of its call. With `--drive`, drives
all plans, and exits with 1 if there was a contact or a robot that did not arrive.
"""

import argparse
import statistics
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from movingai import PATIENCE, algorithm_of
from mrpbench_tests.instances.buildings import random_building
from mrpbench_worlds_standard.rmf import Rmf
from problem_building import MEMORY, problem_of

import mrpbench_core
from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.checking.reachability import round_trips
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.drive.plan import call_planner
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.plan import Budget
from mrpbench_core.model.runs.status import RunStatus

FLEET = Fleet(robots=(load_robot("turtlebot3_burger"),))


def study(seed: int, robots: int, folder: Path, **drawn: int) -> dict[str, Any]:
    """Robots on one building, each from one floor to another, between places that robots can reach."""
    random = np.random.default_rng(seed)
    building = random_building(random, **drawn)
    file = folder / f"{seed}.building.yaml"
    file.write_text(building.text)
    world = Rmf(file=file).load()
    roadmap = Graph().build(world, FLEET)
    label = round_trips(roadmap, 0)
    vertex = {place.name: int(roadmap.place[index]) for index, place in enumerate(world.vertices) if place.name}
    main = np.bincount(label).argmax()
    floor = {
        name: level
        for level, names in building.places.items()
        for name in names
        if vertex[name] >= 0 and label[vertex[name]] == main
    }
    while True:
        starts, goals = (random.permutation(list(floor))[:robots].tolist() for _ in range(2))
        if all(floor[start] != floor[goal] for start, goal in zip(starts, goals, strict=True)):
            break
    return {
        "name": f"building-{seed}",
        "world": {"plugin": "rmf", "file": str(file)},
        "roadmap": "graph",
        "scenario": {"plugin": "named", "starts": starts, "goals": goals},
        "assigner": "identity",
    }


def plan(block: dict[str, Any], planner: str, seconds: float) -> tuple[float, str]:
    """CPU seconds of a planner, infinite if it finds no plan in time, and what it told."""
    name, options = algorithm_of(planner)
    block = {**block, "planner": {"plugin": name, **options}, "simulator": "none"}
    config = load_study(block).runs[0].config
    problem = problem_of(config)
    assert problem is not None
    result, timing = call_planner(config.planner, problem, Budget(wall_s=PATIENCE * 4 * seconds, memory_bytes=MEMORY))
    spent = timing["planning_cpu_s"]
    cost = "-" if result.plan is None else result.plan.sum_of_costs
    told = f"{result.status} {cost} >= {result.lower_bound:.0f} {spent:.2f} s {dict(result.statistics)}"
    return (spent if result.plan is not None and spent <= seconds else float("inf")), told


def drive(block: dict[str, Any], planner: str, options: argparse.Namespace) -> tuple[bool, str]:
    """Drive one plan; whether every robot arrived without contact, and what happened."""
    name, given = algorithm_of(planner)
    block = {
        **block,
        "planner": {"plugin": name, **given},
        "dispatcher": "adg",
        "controller": options.controller,
        "simulator": options.simulator,
        "limits": {"execution": "60 min", "planning": "60 s"},
        "recording": {"keep": "none"},
    }
    with tempfile.TemporaryDirectory() as out:
        (record,) = mrpbench_core.run(block, out=Path(out))
    metrics = record["metrics"]
    contacts = [metrics.get(f"execution.{kind}_contacts") for kind in ("robot", "wall")]
    good = record["status"] == RunStatus.SUCCEEDED and contacts == [0, 0]
    return (
        good,
        f"{record['status']}, contacts {contacts}, {metrics.get('execution.duration_s')} s {record.get('error')}",
    )


def main() -> int:
    """Measure or drive all instances."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--planners", nargs="+", default=["pbs", "eecbs w=1.2", "cbs"], metavar='"NAME OPTION=VALUE…"')
    parser.add_argument("--robots", nargs="+", type=int, default=[2, 4, 6, 9])
    parser.add_argument("--buildings", type=int, default=30)
    parser.add_argument("--floors", type=int, default=3)
    parser.add_argument("--lifts", type=int, default=4)
    parser.add_argument("--lanes", type=int, help="of the corridors, 1 or 2 (default: drawn)")
    parser.add_argument("--first", type=int, default=0, help="seed of the first building")
    parser.add_argument("--time-limit", type=float, default=10.0, help="CPU seconds")
    parser.add_argument("--each", action="store_true", help="a line for each instance too")
    parser.add_argument("--drive", action="store_true", help="drive instead of measuring planners")
    parser.add_argument("--simulator", default="planar")
    parser.add_argument("--controller", default="pure_pursuit")
    options = parser.parse_args()
    good = True
    with tempfile.TemporaryDirectory() as folder:
        print(f"{'planner':<16}{'robots':>7}{'n':>5}{'solved':>8}{'median s':>10}{'most s':>8}")
        for robots in options.robots:
            blocks = [
                study(seed, robots, Path(folder), floors=options.floors, lifts=options.lifts, lanes=options.lanes)
                for seed in range(options.first, options.first + options.buildings)
            ]
            for planner in options.planners:
                if options.drive:
                    for block in blocks:
                        fine, told = drive(block, planner, options)
                        good &= fine
                        print(f"{planner:<16}{robots:>7} {block['name']}: {told}", flush=True)
                    continue
                seconds = []
                for block in blocks:
                    spent, told = plan(block, planner, options.time_limit)
                    seconds.append(spent)
                    if options.each:
                        print(f"  {planner} {robots} {block['name']}: {told}", flush=True)
                solved = [value for value in seconds if value < float("inf")]
                print(
                    f"{planner:<16}{robots:>7}{len(seconds):>5}{len(solved):>8}{statistics.median(seconds):>10.3f}"
                    f"{max(solved, default=float('nan')):>8.2f}",
                    flush=True,
                )
    return int(not good)


if __name__ == "__main__":
    raise SystemExit(main())
