"""Executions by the rules of the League of Robot Runners: speed of the simulation, and tasks against published figures.

`python benchmarks/league.py speed`: PIBT with 10,000 robots on 140 x 500 cells, steps per second on one core.
`python benchmarks/league.py examples --shared ../shared/data`: the examples of 2026 against the Start-Kit's planner.
`python benchmarks/league.py dense --season 2023`: random-32-32-20 with 100 to 800 robots, beside the best totals.
`python benchmarks/league.py large`: 10,000 robots on a map of 2.3 million free cells.
"""

import argparse
import os
import resource
import time
from pathlib import Path

import numpy as np
from mrpbench_league.execute import Options, execute
from mrpbench_league.files.problem import LorrProblem, read_problem
from mrpbench_league.scoring.rescore import rescore
from mrpbench_native import discrete

from mrpbench_core.files.movingai import read_movingai_map
from mrpbench_core.model.common.arrays import Bool

START_KIT = {"maze.domain/maze-example_40.json": 97, "random.domain/random-example_400.json": 651}
"""Tasks of its default planner in 1,000 ticks, called every 1,000 ms; of the other examples none was measured."""
BEST = {
    2023: {100: (500, 1741), 200: (500, 3042), 400: (1000, 7432), 600: (1000, 5914), 800: (2000, 6059)},
    2024: {100: (600, 696), 200: (600, 1260), 400: (800, 2368), 700: (1000, 2585), 800: (2000, 3050)},
}
"""By season: steps and tasks on random-32-32-20 by robots. The problems here are drawn in the same style."""
ERRANDS = {2023: (1,), 2024: (2, 3, 4, 4, 5)}
"""Of a task, drawn evenly from these: 3.6 on average in 2024, as in the archive of the competition."""


def drawn(season: int, blocked: Bool, robots: int, goals: int, errands: tuple[int, ...], seed: int = 0) -> LorrProblem:
    """A problem with starts anywhere and tasks of so many errands among `goals` cells of the largest component."""
    random = np.random.default_rng(seed)
    free = connected(blocked)
    first = np.cumsum([0, *random.choice(errands, 20 * robots)])
    cells = random.choice(random.choice(free, min(goals, len(free)), replace=False), first[-1])
    return LorrProblem(
        season=season,
        blocked=blocked,
        start=random.choice(free, robots, replace=False).astype(np.int32),
        errands=cells.astype(np.int32),
        first=first.astype(np.int32),
        reveal=1.0 if season == 2023 else 1.5,
        counter=3 if season == 2026 else 1,
    )


def connected(blocked: Bool) -> np.ndarray:
    """The cells of the largest component."""
    width = blocked.shape[1] + 2
    free = ~np.pad(blocked, 1, constant_values=True).ravel()
    largest = np.empty(0, int)
    while len(largest) < np.count_nonzero(free):
        frontier = np.flatnonzero(free)[:1]
        cells = []
        while len(frontier):
            free[frontier] = False
            cells.append(frontier)
            near = np.unique((frontier[:, None] + (1, -1, width, -width)).ravel())
            frontier = near[free[near]]
        largest = max(largest, np.concatenate(cells), key=len)
    row, column = np.divmod(np.sort(largest), width)
    return (row - 1) * blocked.shape[1] + column - 1


def speed(steps: int, guidance: bool) -> None:
    """Print steps per second after the first steps, in which distance tables are computed."""
    blocked = np.zeros((140, 500), bool)
    blocked[2:138:3, 4:496] = True
    blocked[:, ::12] = False
    problem = drawn(2023, blocked, 10_000, 1000, (1,))
    options = Options(planner="pibt", iterations=0, guidance=guidance, table_mib=4096)
    execution = discrete.open(problem=problem, **options.arguments(10_000))
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
    """Print our tasks and, where they are known, those of the Start-Kit."""
    for file in sorted((shared / "lorr").glob("*.domain/*.json")):
        problem = read_problem(file)
        cpu = time.process_time()
        done = execute(problem, 1000, options)
        cpu = time.process_time() - cpu
        faults = rescore(problem, done.output).faults.count
        ours = done.output.finished or 0
        theirs = START_KIT.get(f"{file.parent.name}/{file.name}")
        beside = f", Start-Kit {theirs}: {ours / theirs:.2f}" if theirs else ""
        late = f"{done.late_calls} of {len(done.call_seconds)} calls late"
        print(f"{file.stem}: {ours} tasks{beside}; {faults} faults, {late}, {cpu:.0f} s of CPU", flush=True)


def large(shared: Path, options: Options, ticks: int) -> None:
    """Print tasks, time and memory on a map of Paris of which each cell is 7 x 7 cells, with goals anywhere."""
    blocked = np.kron(read_movingai_map(shared / "movingai/maps/Paris_1_256.map"), np.ones((7, 7), bool))
    problem = drawn(2026, blocked, 10_000, 10**7, (2,))
    cpu = time.process_time()
    done = execute(problem, ticks, options)
    cpu = time.process_time() - cpu
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    late = f"{done.late_calls} of {len(done.call_seconds)} calls late"
    print(f"{ticks} ticks: {done.errands} errands, {done.output.finished} tasks")
    print(f"{late}, {cpu:.0f} s of CPU, {peak:.0f} MiB")
    print(f"preprocessing {done.preprocessing_seconds:.1f} s; a call {np.median(done.call_seconds):.2f} s (median)")


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
    parser.add_argument("what", choices=("speed", "examples", "dense", "large"))
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
    elif given.what == "large":
        large(given.shared, options, given.steps)
    else:
        dense(given.shared, options, given.season, given.robots)


if __name__ == "__main__":
    main()
