"""Executions by the rules of the League of Robot Runners: speed of the simulation, and tasks against published figures.

`python benchmarks/league.py speed`: PIBT with 10,000 robots on 140 x 500 cells, steps per second on one core.
`python benchmarks/league.py examples --shared ../shared/data`: the examples of 2026 against the Start-Kit's planner.
`python benchmarks/league.py dense --season 2023`: random-32-32-20 with 100 to 800 robots against the best totals.
"""

import argparse
import os
import time
from pathlib import Path

import attrs
import numpy as np
from mrpbench_league.execute import Options, execute
from mrpbench_league.files.problem import LorrProblem, read_problem
from mrpbench_league.scoring.rescore import rescore
from mrpbench_native import discrete

from mrpbench_core.files.movingai import read_movingai_map
from mrpbench_core.model.common.arrays import Bool

START_KIT = {"maze.domain/maze-example_40.json": 97, "random.domain/random-example_400.json": 651}
"""Tasks of its default planner in 1,000 ticks, called every 1,000 ms."""
BEST = {
    2023: {100: (500, 1741), 200: (500, 3042), 400: (1000, 7432), 600: (1000, 5914), 800: (2000, 6059)},
    2024: {100: (600, 696), 200: (600, 1260), 400: (800, 2368), 700: (1000, 2585), 800: (2000, 3050)},
}
"""By season: steps and tasks on random-32-32-20 by robots. The problems here are drawn in the same style."""
ERRANDS = {2023: 1, 2024: 3}
"""Of a task; how many the tasks of 2024 have is not published here."""


def drawn(season: int, blocked: Bool, robots: int, goals: int, errands: int) -> LorrProblem:
    """A problem with starts anywhere and tasks of so many errands among `goals` cells of the largest component."""
    random = np.random.default_rng(0)
    free = connected(blocked)
    cells = random.choice(random.choice(free, min(goals, len(free)), replace=False), 20 * robots * errands)
    return LorrProblem(
        season=season,
        blocked=blocked,
        start=random.choice(free, robots, replace=False).astype(np.int32),
        errands=cells.astype(np.int32),
        first=np.arange(0, len(cells) + 1, errands, dtype=np.int32),
        reveal=1.0 if season == 2023 else 1.5,
    )


def connected(blocked: Bool) -> np.ndarray:
    """The cells of the largest component."""
    height, width = blocked.shape
    label = np.where(blocked, -1, np.arange(blocked.size).reshape(height, width))
    while True:
        before = label.copy()
        for axis in (0, 1):
            for shift in (1, -1):
                near = np.roll(label, shift, axis)
                near[
                    (0 if shift == 1 else -1, slice(None)) if axis == 0 else (slice(None), 0 if shift == 1 else -1)
                ] = -1
                label = np.where(blocked, -1, np.maximum(label, near))
        if np.array_equal(label, before):
            break
    values, counts = np.unique(label[label >= 0], return_counts=True)
    return np.flatnonzero(label.ravel() == values[counts.argmax()])


def speed(steps: int, guidance: bool) -> None:
    """Print steps per second after the first steps, in which distance tables are computed."""
    blocked = np.zeros((140, 500), bool)
    blocked[2:138:3, 4:496] = True
    blocked[:, ::12] = False
    problem = drawn(2023, blocked, 10_000, 1000, 1)
    options = Options(planner="pibt", iterations=0, guidance=guidance, table_mib=4096)
    execution = discrete.open(problem=problem, **attrs.asdict(options))
    began = time.perf_counter()
    execution.run_until(50)
    warm = time.perf_counter()
    cpu = time.process_time()
    execution.run_until(50 + steps)
    wall, used = time.perf_counter() - warm, time.process_time() - cpu
    print(
        f"first 50 steps {warm - began:.1f} s; then {steps / wall:.0f} steps/s wall, {steps / used:.0f} steps/s of CPU"
    )
    print(f"{execution.errands} errands")


def examples(shared: Path, options: Options) -> None:
    """Print our tasks and those of the Start-Kit."""
    for name, theirs in START_KIT.items():
        problem = read_problem(shared / "lorr" / name)
        done = execute(problem, 1000, options)
        faults = rescore(problem, done.output).faults.count
        ours = done.output.finished or 0
        print(f"{name}: {ours} tasks, Start-Kit {theirs}: {ours / theirs:.2f}; {faults} faults, {done.late_calls} late")


def dense(shared: Path, options: Options, season: int, robots: list[int] | None) -> None:
    """Print our tasks and the best known ones."""
    blocked = read_movingai_map(shared / "movingai/maps/random-32-32-20.map")
    for count in robots or BEST[season]:
        steps, best = BEST[season][count]
        problem = drawn(season, blocked, count, 10**6, ERRANDS[season])
        cpu = time.process_time()
        done = execute(problem, steps, options)
        cpu = (time.process_time() - cpu) / steps
        ours, faults = done.output.finished or 0, rescore(problem, done.output).faults.count
        print(
            f"{count} robots, {steps} steps: {ours} tasks, best known {best}: {ours / best:.2f}; {faults} faults, "
            f"{done.late_calls} late, {np.median(done.call_seconds):.3f} s and {cpu:.3f} s of CPU a step",
            flush=True,
        )


def main() -> None:
    """Run what the arguments name."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("speed", "examples", "dense"))
    parser.add_argument("--shared", type=Path, default=Path("../shared/data"))
    parser.add_argument("--iterations", type=int, help="rounds of improvement; none: as the clock allows")
    parser.add_argument("--steps", type=int, default=500)
    parser.add_argument("--season", type=int, choices=tuple(BEST), default=2024)
    parser.add_argument("--robots", type=int, nargs="*")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--no-guidance", action="store_false", dest="guidance")
    given = parser.parse_args()
    options = Options(iterations=given.iterations, threads=given.threads, guidance=given.guidance)
    print(f"load {os.getloadavg()[0]:.1f}")
    if given.what == "speed":
        speed(given.steps, given.guidance)
    elif given.what == "examples":
        examples(given.shared, options)
    else:
        dense(given.shared, options, given.season, given.robots)


if __name__ == "__main__":
    main()
