"""Measure assigners on random problems: as many robots as tasks, drawn in a square, with Euclidean costs.

    python benchmarks/assigners.py
    python benchmarks/assigners.py --assigners hungarian --robots 1000 2000 --objective bottleneck

A row gives the median CPU time of a call by each assigner, and by how much the value differs from that of the first one
at most, relative to it. An assigner that takes more than `--give-up` seconds is not asked for larger problems.
"""

import argparse
import statistics
import time

import numpy as np

from mrpbench_core.api import Assigner
from mrpbench_core.model.planning.assignment import AssignmentProblem
from mrpbench_core.plugins.registry import Registry


def problem(robots: int, seed: int) -> AssignmentProblem:
    """Robots and tasks in a square of 100 m."""
    starts, goals = np.random.default_rng([robots, seed]).uniform(0, 100, (2, robots, 2))
    return AssignmentProblem(costs=np.linalg.norm(starts[:, None] - goals[None], axis=2))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--assigners", nargs="+", default=["hungarian", "ortools_mip", "ortools_sat"])
    parser.add_argument("--robots", nargs="+", type=int, default=[5, 20, 50, 100, 200, 500, 1000])
    parser.add_argument("--objective", choices=("sum", "bottleneck"), default="sum")
    parser.add_argument("--problems", type=int, default=5, help="number of problems of each size")
    parser.add_argument("--give-up", type=float, default=30.0)
    arguments = parser.parse_args()
    assigners: dict[str, Assigner] = {
        name: Registry(Assigner).get(name)(objective=arguments.objective) for name in arguments.assigners
    }
    for assigner in assigners.values():
        assigner.assign(problem(2, 0))  # imports its library
    print(f"{'robots':>6}" + "".join(f"{name + ' (ms)':>18}" for name in assigners) + f"{'difference':>12}")
    for robots in arguments.robots:
        times, values = {}, {}
        for name, assigner in list(assigners.items()):
            spent, values[name] = [], []
            for seed in range(arguments.problems):
                given = problem(robots, seed)
                begin = time.process_time()
                values[name].append(assigner.assign(given).cost)
                spent.append(time.process_time() - begin)
            times[name] = statistics.median(spent)
            if times[name] > arguments.give_up:
                del assigners[name]
        first = np.array(next(iter(values.values())))
        difference = max(float(np.max(np.abs(np.array(found) / first - 1))) for found in values.values())
        row = [f"{times[name] * 1e3:>18.2f}" if name in times else f"{'':>18}" for name in arguments.assigners]
        print(f"{robots:>6}" + "".join(row) + f"{difference:>12.1e}", flush=True)


if __name__ == "__main__":
    main()
