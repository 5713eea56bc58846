"""Measure the time that dispatchers take with large fleets of which some robots are late.

    python benchmarks/dispatching.py --robots 100 300 1000 --dispatchers adg gses btpg
    python benchmarks/dispatching.py --robots 1000 --dispatchers adg --speed-profiles

Each fleet has a grid in which one cell of ten holds a robot and one of five is blocked, drawn goals, and a plan
of `lacam`. Robots make one move in each second, unless they are stopped: in every second, one robot of a hundred stops
for 10 to 20 seconds. Prints for each dispatcher the CPU seconds of its start, its updates (mean, 99th percentile,
longest, in milliseconds), the number of updates above 100 ms, and the mean arrival of the robots in seconds.
"""

import argparse
import time
from collections.abc import Sequence

import numpy as np
from mrpbench_dispatchers_reordering import Btpg, Gses, Sadg
from mrpbench_planners_mapf.lacam import Lacam
from mrpbench_tests.instances.roadmaps import grid_of

from mrpbench_core.api import Dispatcher
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.execution.orders import FleetView
from mrpbench_core.model.planning.plan import Budget, Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.testing.drawing import build

DISPATCHERS = {"adg": Adg, "gses": Gses, "sadg": Sadg, "btpg": Btpg}
SLOW = 0.1
"""seconds."""


def main() -> None:
    """Execute the plans and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=int, nargs="+", default=[100, 300, 1000])
    parser.add_argument("--dispatchers", nargs="+", choices=sorted(DISPATCHERS), default=sorted(DISPATCHERS))
    parser.add_argument("--speed-profiles", action="store_true", help="with speed profiles, in each update")
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    names = f"{'start':>7} {'mean':>7} {'p99':>7} {'most':>7} {'slow':>9} arrival"
    print(f"{'robots':>6} {'moves':>7} {'dispatcher':10} {names}")
    for robots in given.robots:
        problem, plan = drawn_plan(robots, given.seed)
        moves = sum(int((path.edge >= 0).sum()) for path in plan.paths)
        for name in given.dispatchers:
            start, updates, arrival = execute(
                DISPATCHERS[name](speed_profiles=given.speed_profiles), problem, plan, given.seed
            )
            figures = 1000 * np.array([np.mean(updates), np.quantile(updates, 0.99), np.max(updates)])
            slow = f"{sum(update > SLOW for update in updates)}/{len(updates)}"
            columns = " ".join(f"{figure:7.1f}" for figure in figures)
            print(f"{robots:6} {moves:7} {name:10} {start:7.2f} {columns} {slow:>9} {arrival:7.2f}", flush=True)


def drawn_plan(robots: int, seed: int) -> tuple[Problem, Plan]:
    """A drawn problem and a plan of `lacam`."""
    random = np.random.default_rng(seed)
    side = int(np.ceil(np.sqrt(10 * robots)))
    road = grid_of(["".join(row) for row in np.where(random.random((side, side)) < 0.2, "#", ".")])
    cells = _largest_area(road.edges, len(road.position))
    starts, goals = random.permutation(cells)[:robots], random.permutation(cells)[:robots]
    problem = build(road, starts.tolist(), [(goal,) for goal in goals.tolist()])
    found = Lacam().plan(problem, Budget(wall_s=60.0, memory_bytes=4 << 30, iterations=0))
    assert found.plan is not None, found.status
    return problem, found.plan


def _largest_area(edges: np.ndarray, vertices: int) -> np.ndarray:
    label = np.arange(vertices)
    while True:
        before = label.copy()
        np.minimum.at(label, edges[:, 1], label[edges[:, 0]])
        if (before == label).all():
            return np.flatnonzero(label == np.bincount(label).argmax())


def execute(dispatcher: Dispatcher, problem: Problem, plan: Plan, seed: int) -> tuple[float, Sequence[float], float]:
    """CPU seconds of the start and of each update, and the mean arrival in seconds."""
    random = np.random.default_rng(seed)
    begin = time.process_time()
    session = dispatcher.start(problem, plan)
    start = time.process_time() - begin
    robots, lengths = len(problem), np.array([len(path) for path in plan.paths])
    reached, stopped, arrival = np.zeros(robots, np.int32), np.zeros(robots), np.zeros(robots)
    waits = [path.edge < 0 for path in plan.paths]
    updates: list[float] = []
    level, pose = np.zeros(robots, np.int16), np.zeros((robots, 3))
    vertices = [path.vertices(problem.roadmap, at) for path, at in zip(plan.paths, problem.start.tolist(), strict=True)]
    for now in range(20 * max(lengths)):
        here = [visited[count] for visited, count in zip(vertices, reached.tolist(), strict=True)]
        pose[:, :2] = problem.roadmap.position[here]
        view = FleetView(
            revision=0,
            reached=reached.copy(),
            cleared=reached.copy(),
            pose=pose.copy(),
            level=level,
            mode=np.full(robots, Mode.FOLLOWING, np.uint8),
        )
        begin = time.process_time()
        released = session.update(float(now), view).released
        updates.append(time.process_time() - begin)
        hit = (stopped <= 0) & (random.random(robots) < 0.01)
        stopped = np.where(hit, random.integers(10, 21, robots), stopped - 1)
        for robot in np.flatnonzero((stopped <= 0) & (reached < released)).tolist():
            reached[robot] += 1
            while reached[robot] < released[robot] and waits[robot][reached[robot]]:
                reached[robot] += 1
        arrival = np.where(reached < lengths, now + 1, arrival)
        if (reached == lengths).all():
            return start, updates, float(arrival.mean())
    raise AssertionError(f"robots {np.flatnonzero(reached < lengths).tolist()} wait forever")


if __name__ == "__main__":
    main()
