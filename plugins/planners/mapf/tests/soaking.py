"""The loop of the soaks: draw an instance, ask the oracle and the planners, and compare their answers."""

import math
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from typing import NamedTuple

import attrs
import numpy as np
from mapf_claims import changes, contradictions, faults

from mrpbench_core.api.planner import Planner
from mrpbench_core.model.plan import Budget, PlanResult, PlanStatus
from mrpbench_core.model.problem import Problem

Random = np.random.Generator
Draw = Callable[[Random], Problem]

BUDGET = Budget(wall_s=0.5, memory_bytes=1 << 30)
HOPELESS = attrs.evolve(BUDGET, wall_s=0.02)
"""There is no solution, and not every planner can prove that."""
REPORT_EVERY = 1000


class Soak(NamedTuple):
    """What to draw, what is true, and whom to ask."""

    kinds: Mapping[str, Draw]
    optimum: Callable[[Problem], float | None]
    """The least sum of costs, None if it is not known."""
    planners: Callable[[Random], Iterable[Planner]]
    more: Callable[[Problem, Planner, PlanResult], list[str]] = lambda asked, planner, result: []
    """Further faults of an answer."""


def run(soak: Soak, count: int, seed: int, first: int = 0) -> int:
    """Print what is wrong with `count` instances from number `first` on, and what became of all; how much is wrong."""
    wrong, ends, truths = 0, Counter[tuple[str, str]](), Counter[tuple[str, str]]()
    for number in range(first, first + count):
        kind, draw = list(soak.kinds.items())[number % len(soak.kinds)]
        random = np.random.default_rng([seed, number])
        asked = draw(random)
        optimum = soak.optimum(asked)
        truths[kind, "unknown" if optimum is None else "unsolvable" if optimum == math.inf else "solvable"] += 1
        for said in _ask(soak, asked, optimum, random, ends):
            wrong += 1
            print(f"{kind}, seed [{seed}, {number}], {said}", flush=True)
        if (number + 1 - first) % REPORT_EVERY == 0:
            print(f"# {number + 1 - first} instances, {wrong} faults", flush=True)
    _table("kind", truths)
    _table("planner", ends)
    print(f"{count} instances from number {first} of seed {seed}: {wrong} faults", flush=True)
    return wrong


def _ask(
    soak: Soak, asked: Problem, optimum: float | None, random: Random, ends: Counter[tuple[str, str]]
) -> Iterable[str]:
    """What is wrong with the planners' answers; one planner, drawn, is asked twice."""
    planners = [planner for planner in soak.planners(random) if planner.skip(asked) is None]
    twice = int(random.integers(len(planners)))
    answers = []
    for number, planner in enumerate(planners):
        budget = attrs.evolve(HOPELESS if optimum == math.inf else BUDGET, iterations=int(random.integers(30)))
        result = planner.plan(asked, budget)
        answers.append((planner, result))
        ends[type(planner).__name__, _ending(result, optimum)] += 1
        found = faults(asked, planner, result, optimum) + soak.more(asked, planner, result)
        found += changes(asked, planner, budget, result) if number == twice else []
        yield from (f"{planner}: {fault}" for fault in found)
    yield from contradictions(answers)


def _ending(result: PlanResult, optimum: float | None) -> str:
    if result.status is not PlanStatus.TIMEOUT or optimum is None:
        return str(result.status)
    return "timeout, unsolvable" if optimum == math.inf else "timeout, solvable"


def _table(title: str, counts: Counter[tuple[str, str]]) -> None:
    columns = sorted({column for _, column in counts})
    print(f"{title:20}" + "".join(f"{column:>21}" for column in columns))
    for name in sorted({name for name, _ in counts}):
        print(f"{name:20}" + "".join(f"{counts[name, column]:21}" for column in columns))


def main(soak: Soak) -> None:
    """Run as the command line says: COUNT SEED [FIRST]."""
    sys.exit(run(soak, *map(int, sys.argv[1:])) > 0)
