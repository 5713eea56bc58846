"""Does tasks with every assigner, while robots fail and plans are missing: none is lost, done twice, or done by two.

`make soak` runs it. `python soak_tasks.py EVENTS SEED [FIRST]` prints what contradicts the books of the tasks, and
counts events. Each execution has another map, fleet, source, assigner and planner. Robots follow plans exactly, so that
a million events take minutes. The exit code is 1 if there are faults.
"""

import itertools
import sys
from collections import Counter
from importlib.metadata import entry_points

import attrs
import numpy as np
from mrpbench_tests.execution.task_steps import TaskSteps
from mrpbench_tests.instances.problems import grid_of, problem_on

from mrpbench_core.builtin.task_sources.closed_pool import ClosedPoolStream
from mrpbench_core.builtin.task_sources.listed import ListedStream
from mrpbench_core.model.planning.scenario import Task

TICKS = 400
PLANNERS = ("pibt", "prioritized", "pbs", "token_passing")
FAILURE, REPAIR, GIVES_UP, DEAF = 0.002, 0.05, 0.2, 0.02
"""Probabilities: that a robot fails in a tick, is repaired, gives its task up as it fails; that a plan is missing."""


@attrs.frozen
class Draws:
    """Tasks with one to three errands at random vertices, also at any of several, some of which no robot can reach."""

    position: np.ndarray
    seed: tuple[int, int]

    def task(self, index, release):
        """Task `index`; one place of a hundred is off the roadmap."""
        random = np.random.default_rng([*self.seed, index])
        sizes = random.integers(1, 4, random.integers(1, 4)) if random.random() < 0.5 else [1] * random.integers(1, 4)
        goals = self.position[random.integers(len(self.position), size=sum(sizes))]
        goals = goals + 1e6 * (random.random((len(goals), 1)) < 0.01)
        return Task(
            goals=np.column_stack([goals, np.full(len(goals), np.nan)]),
            errand=np.repeat(np.arange(len(sizes)), sizes),
            levels=np.zeros(len(goals), np.int16),
            release=release,
            service=random.integers(0, 3, len(sizes)).astype(float),
            index=index,
        )


def installed(kind):
    """The classes of a kind that are installed, by name."""
    return {entry.name: entry.load() for entry in sorted(entry_points(group=f"mrpbench.{kind}"))}


def assigners():
    """Every assigner that needs no options, by name; that of token passing also with swaps."""
    found = {name: kind() for name, kind in installed("assigners").items() if "optional" not in name}
    return found | {"token_passing swaps": attrs.evolve(found["token_passing"], task_swaps=True)}


def drawn(random, named, planners, situation, seed):
    """An execution at its beginning, and what it is of."""
    rows, columns = random.integers(5, 12, 2)
    blocked = random.random((rows, columns)) < 0.15
    blocked[0] = blocked[-1] = blocked[:, 0] = blocked[:, -1] = False
    road = grid_of(["".join("#" if cell else "." for cell in row) for row in blocked])
    robots = int(random.integers(1, 10))
    starts = random.choice(len(road.position), robots, replace=False).tolist()
    draws = Draws(road.position, (seed, situation))
    stream = ClosedPoolStream(draws, robots + int(random.integers(robots + 1)), None)
    if random.random() < 0.3:
        at = np.sort(random.uniform(0, TICKS, 60)).tolist()
        stream = ListedStream([draws.task(index, release) for index, release in enumerate(at)])
    assigner = str(random.choice(sorted(named)))
    planner = str(random.choice(PLANNERS))
    run = TaskSteps(
        problem_on(road, starts, starts),
        stream,
        named[assigner],
        planners[planner](),
        parking=str(random.choice(["stay", "home"])),
    )
    return run, f"{assigner}, {planner}"


def execute(run, random):
    """Let time pass, with failures."""
    robots = len(run.problem)
    stopped = np.zeros(robots, bool)
    for _ in range(TICKS):
        fails = ~stopped & (random.random(robots) < FAILURE)
        stopped = (stopped & (random.random(robots) >= REPAIR)) | fails
        run.step(stopped, fails & (random.random(robots) < GIVES_UP), deaf=random.random() < DEAF)
    books, tasks = run.ledger, run.tasks
    if books.open.keys() != tasks.unfinished:
        books.faults.append(f"tasks {sorted(books.open.keys() ^ tasks.unfinished)} are lost")
    return books


def run(events, seed, first=0):
    """Print the faults of executions from a situation on until there were so many events; return their number."""
    named, planners = assigners(), installed("planners")
    counted, faults, total = Counter(), 0, 0
    for situation in itertools.count(first):
        if total >= events:
            break
        random = np.random.default_rng([seed, situation])
        execution, what = drawn(random, named, planners, situation, seed)
        books = execute(execution, random)
        for fault in books.faults[:5]:
            print(f"{what}, seed [{seed}, {situation}]: {fault}", flush=True)
        faults += len(books.faults)
        counted[what] += books.finished
        if (total + books.events) // 100_000 > total // 100_000:
            print(f"# {total + books.events} events, {faults} faults", flush=True)
        total += books.events
    for what, count in sorted(counted.items()):
        print(f"{what:40} {count:10} tasks finished")
    print(f"{total} events of seed {seed} before situation {situation}: {faults} faults", flush=True)
    return faults


if __name__ == "__main__":
    sys.exit(run(*map(int, sys.argv[1:])) > 0)
