"""Check that anytime solvers keep their time and memory limits and repeat their plans, on the largest instances.

    python benchmarks/deadlines.py --data ../shared/data/movingai --maps den520d warehouse-10-20-10-2-1 --agents 1000

Prints by how much each call overran its time limit, what the solver counted against its memory limit and by how much
the process grew, and whether two runs of so many `--iterations` gave the same paths. Exits with 1 if a limit was
overrun by more than 50 ms of processor time, or a plan was not the same.
"""

import argparse
import resource
import sys
import time
from pathlib import Path

import numpy as np
from movingai import read_map, read_scen
from mrpbench_native import Grid, Solution, options_of, solve

ALLOWED_S = 0.05
MEMORY = 64 << 20


def same(one: Solution, other: Solution) -> bool:
    """Tell whether two solutions have the same paths."""
    return len(one.paths) == len(other.paths) and all(
        np.array_equal(a, b) for a, b in zip(one.paths, other.paths, strict=True)
    )


def main() -> None:
    """Measure the rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, required=True, help="folder with maps/ and scens/")
    parser.add_argument("--maps", nargs="+", default=["den520d", "warehouse-10-20-10-2-1"])
    parser.add_argument("--agents", type=int, default=1000)
    parser.add_argument("--solvers", nargs="+", default=["lacam", "lns"])
    parser.add_argument("--limits", nargs="+", type=float, default=[0.1, 1.0, 3.0])
    parser.add_argument("--iterations", type=int, default=20)
    arguments = parser.parse_args()
    bad = 0
    for name in arguments.maps:
        grid = Grid(read_map(arguments.data / "maps" / f"{name}.map"))
        starts, goals = read_scen(arguments.data / "scens" / f"{name}-random-1.scen", arguments.agents)
        for solver in arguments.solvers:
            for limit in arguments.limits:
                cpu = time.thread_time()
                found = solve(grid, starts, goals, algorithm=solver, time_limit=limit)
                over, used = found.seconds - limit, time.thread_time() - cpu - limit
                bad += min(over, used) > ALLOWED_S
                print(f"{name} {solver} {limit:g} s: {found.status}, over by {1000 * over:.0f} ms", flush=True)
            before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
            found = solve(grid, starts, goals, algorithm=solver, time_limit=30, memory_limit=MEMORY)
            grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
            print(f"{name} {solver} {MEMORY >> 20} MiB: {found.status}, peak grew by {grown:.0f} MiB", flush=True)
            if "iterations" not in options_of(solver):  # it ends by itself
                continue
            one, other = (
                solve(grid, starts, goals, algorithm=solver, time_limit=60, iterations=arguments.iterations)
                for _ in range(2)
            )
            bad += not same(one, other)
            print(f"{name} {solver} {arguments.iterations} iterations: cost {one.cost}, again {other.cost}", flush=True)
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
