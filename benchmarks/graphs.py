"""Measure planners on navigation graphs: edge durations, footprints, doors and lifts.

    python benchmarks/graphs.py
    python benchmarks/graphs.py --planners cbs "eecbs w=1.05" --worlds office --robots 12 --seeds 20
    python benchmarks/graphs.py --worlds ../shared/data/rmf/rmf_demos/hotel.building.yaml --robots 6 --time-limit 20

A world is a built-in one or a file of RMF. Times are CPU seconds of the planner's call; unsolved counts as longer than
any. `bound` is the cost of the plan over the lower bound that was proved, the mean over what is solved. With `--each`,
a line for every instance.
"""

import argparse
import statistics
from collections.abc import Iterator
from typing import Any

from movingai import PATIENCE, algorithm_of
from problem_building import MEMORY, problem_of

from mrpbench_core.config.settings import RunConfig
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.drive.plan import call_planner
from mrpbench_core.model.planning.plan import Budget

PLANNERS = ("cbs", "ecbs w=1.2", "eecbs w=1.2", "pbs", "prioritized")


def runs(world: str, robots: int, planner: str, seeds: int) -> Iterator[RunConfig]:
    """One configuration for each seed."""
    name, options = algorithm_of(planner)
    block: dict[str, Any] = {
        "name": "graphs",
        "world": {"plugin": "rmf", "file": world} if world.endswith(".yaml") else world,
        "roadmap": "graph",
        "scenario": {"plugin": "random", "robots": robots},
        "planner": {"plugin": name, **options},
        "simulator": "none",
        "matrix": {"seed": f"0..{seeds - 1}"},
    }
    yield from (point.config for point in load_study(block).runs)


def measure(world: str, planner: str, arguments: argparse.Namespace) -> str:
    """Plan for all seeds; a line of the table."""
    seconds, bounds = [], []
    for config in runs(world, arguments.robots, planner, arguments.seeds):
        problem = problem_of(config)
        if problem is None:
            continue
        budget = Budget(wall_s=PATIENCE * arguments.time_limit, memory_bytes=MEMORY)
        result, timing = call_planner(config.planner, problem, budget)
        spent = timing["planning_cpu_s"]
        solved = result.plan is not None and spent <= arguments.time_limit
        seconds.append(spent if solved else float("inf"))
        if result.plan is not None:
            bounds.append(result.plan.sum_of_costs / result.lower_bound)
        if arguments.each:
            cost = result.plan.sum_of_costs if result.plan is not None else "-"
            told = f"{result.status} {cost} >= {result.lower_bound:.0f} {spent:.2f} s {dict(result.statistics)}"
            print(f"  {planner} seed {config.seed}: {told}", flush=True)
    solved_count = sum(value < float("inf") for value in seconds)
    return (
        f"{planner:<16}{len(seconds):>5}{solved_count:>8}{statistics.median(seconds):>10.3f}"
        f"{statistics.mean(bounds) if bounds else float('nan'):>8.3f}"
    )


def main() -> None:
    """Measure the rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--worlds", nargs="+", default=["office"], metavar="WORLD")
    parser.add_argument("--planners", nargs="+", default=list(PLANNERS), metavar='"NAME OPTION=VALUE…"')
    parser.add_argument("--robots", type=int, default=9)
    parser.add_argument("--seeds", type=int, default=12)
    parser.add_argument("--time-limit", type=float, default=8.0, help="CPU seconds")
    parser.add_argument("--each", action="store_true", help="a line for each instance too")
    arguments = parser.parse_args()
    for world in arguments.worlds:
        print(f"{world}, {arguments.robots} robots\n{'planner':<16}{'n':>5}{'solved':>8}{'median s':>10}{'bound':>8}")
        for planner in arguments.planners:
            print(measure(world, planner, arguments), flush=True)


if __name__ == "__main__":
    main()
