"""A soak: draw thousands of problems, ask an oracle and planners, and print every answer that is wrong."""

import math
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, cast

import attrs
import numpy as np

from mrpbench_core.api.planner import Planner
from mrpbench_core.model.planning.plan import Budget, PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem
from mrpbench_tests.instances.kinds import Draw
from mrpbench_tests.instances.random_problems import Random
from mrpbench_tests.oracles.judge import answer_faults, changes, contradictions

BUDGET = Budget(wall_s=0.5, memory_bytes=1 << 30)
SHORT = attrs.evolve(BUDGET, wall_s=0.02)
"""For problems without a plan, which not every planner can prove."""
REPORT_EVERY = 1000


def no_further_faults(_problem: Problem, _planner: Planner, _result: PlanResult) -> list[str]:
    """Find nothing."""
    return []


class Soak(NamedTuple):
    """The problems that a soak draws, the planners it calls, and the oracle."""

    kinds: Mapping[str, Draw]
    """Kinds of problems, drawn in turn."""
    optimum: Callable[[Problem], float | None]
    """The least sum of costs, inf if there is no plan, None if it is not known."""
    planners: Callable[[Random], Iterable[Planner]]
    """Draws planners and their options."""
    more: Callable[[Problem, Planner, PlanResult], list[str]] = no_further_faults
    """Finds further faults of an answer."""


def run(soak: Soak, count: int, seed: int, first: int = 0) -> int:
    """Print the faults of all answers to `count` problems from number `first` on, and how all ended.

    Returns:
        The number of faults.
    """
    wrong, ends, truths = 0, Counter[tuple[str, str]](), Counter[tuple[str, str]]()
    for number in range(first, first + count):
        kind, draw = list(soak.kinds.items())[number % len(soak.kinds)]
        random = np.random.default_rng([seed, number])
        problem = draw(random)
        optimum = soak.optimum(problem)
        truths[kind, "unknown" if optimum is None else "unsolvable" if optimum == math.inf else "solvable"] += 1
        for fault in _faults(soak, problem, optimum, random, ends):
            wrong += 1
            print(f"{kind}, seed [{seed}, {number}], {fault}", flush=True)
        if (number + 1 - first) % REPORT_EVERY == 0:
            print(f"# {number + 1 - first} instances, {wrong} faults", flush=True)
    _print_table("kind", truths)
    _print_table("planner", ends)
    print(f"{count} instances from number {first} of seed {seed}: {wrong} faults", flush=True)
    return wrong


def main(soak: Soak) -> None:
    """Run as the command line says: COUNT SEED [FIRST]. The exit code is 1 if there are faults."""
    sys.exit(run(soak, *map(int, sys.argv[1:])) > 0)


def drawn_switches(random: Random, planner: type[Planner]) -> dict[str, Any]:
    """The on-off options of a planner, each drawn; `assign`, which asks another problem, is left out."""
    return {
        field.name: bool(random.integers(2))
        for field in attrs.fields(cast(Any, planner))
        if field.type in (bool, "bool") and field.name != "assign"
    }


def _faults(
    soak: Soak, problem: Problem, optimum: float | None, random: Random, ends: Counter[tuple[str, str]]
) -> Iterable[str]:
    """Return the faults of the planners' results; one planner, drawn at random, is called twice."""
    planners = [planner for planner in soak.planners(random) if planner.skip(problem) is None]
    twice = int(random.integers(len(planners)))
    answers = []
    for number, planner in enumerate(planners):
        budget = attrs.evolve(SHORT if optimum == math.inf else BUDGET, iterations=int(random.integers(30)))
        result = planner.plan(problem, budget)
        answers.append((planner, result))
        ends[type(planner).__name__, _ending(result, optimum)] += 1
        found = answer_faults(problem, planner, result, optimum) + soak.more(problem, planner, result)
        found += changes(problem, planner, budget, result) if number == twice else []
        yield from (f"{planner}: {fault}" for fault in found)
    yield from contradictions(answers)


def _ending(result: PlanResult, optimum: float | None) -> str:
    if result.status is not PlanStatus.TIMEOUT or optimum is None:
        return str(result.status)
    return "timeout, unsolvable" if optimum == math.inf else "timeout, solvable"


def _print_table(title: str, counts: Counter[tuple[str, str]]) -> None:
    columns = sorted({column for _, column in counts})
    print(f"{title:20}" + "".join(f"{column:>21}" for column in columns))
    for name in sorted({name for name, _ in counts}):
        print(f"{name:20}" + "".join(f"{counts[name, column]:21}" for column in columns))
