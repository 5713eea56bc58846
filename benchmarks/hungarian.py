"""Compare `hungarian` with SciPy and, where installed, `lap`: ratios of processor time in turns, median of five.

python benchmarks/hungarian.py --sizes 100 500 2000
"""

import argparse
import statistics
import time
from collections.abc import Callable, Iterator

import numpy as np
from mrpbench_native.mapf import cheapest_assignment, path_lengths
from mrpbench_worlds_standard.shipped import Warehouse
from scipy.optimize import linear_sum_assignment

from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet

try:
    from lap import lapjv
except ImportError:
    lapjv = None
TURNS = 5
FORBIDDEN = 1e6
"""What SciPy and lap get for a forbidden pair, because some forbid all assignments."""


def matrices(size: int) -> Iterator[tuple[str, Float]]:
    """Costs with and without ties."""
    random = np.random.default_rng(3)
    here, there = random.integers(0, 64, (size, 2)), random.integers(0, 64, (size, 2))
    grid = np.abs(here[:, None] - there[None]).sum(axis=-1) * 1.0
    yield "floats", random.random((size, size))
    yield "whole below 100", random.integers(0, 100, (size, size)) * 1.0
    yield "grid of 64 x 64", grid
    yield "0 or forbidden", np.where(grid <= np.sort(grid, axis=1)[:, min(30, size - 1)].max(), 0.0, np.inf)
    yield "equal", np.ones((size, size))
    yield "products", np.outer(np.arange(size), np.arange(size)) * 1.0
    yield "rectangular", random.random((size // 2, size))
    yield "warehouse", _on_roadmap(random, size)


def _on_roadmap(random: np.random.Generator, size: int) -> Float:
    """Lengths of paths in the built-in warehouse."""
    roadmap = GridRoadmap(cell_size=0.25).build(Warehouse().load(), Fleet(robots=(load_robot("turtlebot3_burger"),)))
    start, goal = (random.integers(0, len(roadmap.position), size).astype(np.int32) for _ in range(2))
    length = np.hypot(*(roadmap.position[roadmap.edges[:, 1]] - roadmap.position[roadmap.edges[:, 0]]).T)
    return path_lengths(len(roadmap.position), roadmap.edges, length, start, goal)


def main() -> None:
    """Print one line for each kind and size."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=[100, 500, 1000, 2000])
    for size in parser.parse_args().sizes:
        for kind, costs in matrices(size):
            _compare(size, kind, costs)


def _compare(size: int, kind: str, costs: Float) -> None:
    finite = np.where(np.isinf(costs), FORBIDDEN, costs)
    solvers: dict[str, Callable[[], object]] = {
        "hungarian": lambda: cheapest_assignment(costs),
        "scipy": lambda: linear_sum_assignment(finite)[1],
    }
    if lapjv is not None:
        solvers["lap"] = lambda: lapjv(finite, extend_cost=True)[1]
    spent: dict[str, list[float]] = {name: [] for name in solvers}
    worth = {}
    for _ in range(TURNS):
        for name, solve in solvers.items():
            begin = time.process_time()
            columns = solve()
            spent[name].append(time.process_time() - begin)
            worth[name] = FORBIDDEN if columns is None else finite[np.arange(len(finite)), columns].sum()
    own, *others = (statistics.median(times) for times in spent.values())
    ratios = ", ".join(f"{own / other:.2f} of {name}" for name, other in zip(list(spent)[1:], others, strict=True))
    same = np.isclose(worth["hungarian"], worth["scipy"]) or min(worth.values()) >= FORBIDDEN
    print(f"{size:5d} {kind:16s} {own * 1000:9.2f} ms = {ratios}{'' if same else '; DIFFERENT COSTS'}", flush=True)


if __name__ == "__main__":
    main()
