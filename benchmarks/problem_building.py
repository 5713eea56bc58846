"""Build the problems of runs and solve them with any planner of mrpbench, with the checks of the engine."""

from functools import lru_cache
from pathlib import Path
from typing import Any

from mrpbench_native import Solution

from mrpbench_core.config.settings import RunConfig
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.drive.plan import call_planner
from mrpbench_core.engine.prepare.assign import assign
from mrpbench_core.engine.prepare.make_instance import build_run_instance
from mrpbench_core.engine.prepare.problem_building import build_problem
from mrpbench_core.engine.prepare.question import Question
from mrpbench_core.engine.stage import RunEnded, ignore
from mrpbench_core.model.planning.plan import Budget
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.referee.plans import Promises, judge_plan

MEMORY = 4 << 30


def problem_of(config: RunConfig) -> Problem | None:
    """The problem of a run; None where there cannot be a plan."""
    try:
        instance = build_run_instance(Question.of(config), ignore)
        return build_problem(instance, assign(config.assigner, instance, ignore, {}), config.assigner)
    except RunEnded:
        return None


@lru_cache(maxsize=1)  # the next run of the median needs the same
def grid_problem(world: Path, scen: Path, robots: int) -> Problem | None:
    """The problem of the first `robots` rows of a MovingAI scenario."""
    block = {
        "name": "cells",
        "world": {"plugin": "movingai", "file": str(world)},
        "roadmap": "grid",
        "scenario": {"plugin": "movingai", "file": str(scen), "robots": robots},
        "assigner": "identity",
        "planner": "astar",
        "simulator": "none",
    }
    return problem_of(load_study(block).runs[0].config)


def solve_by_planner(name: str, options: dict[str, Any], problem: Problem, wall_s: float) -> Solution:
    """The outcome of a planner on `problem`; `failed` if it does not support such problems or its plan has conflicts.

    Of a planner that runs a program (`external`) the time of that program counts.

    Raises:
        InputErrors: there is no such planner, or it has no such options.
    """
    block = {"name": "asked", "world": "office", "scenario": {"plugin": "random", "robots": 1}, "simulator": "none"}
    planner = load_study({**block, "planner": {"plugin": name, **options}}).runs[0].config.planner
    if why := planner.skip(problem):
        print(f"{name}: {why}")
        return Solution(status="failed")
    promises = Promises.of(planner)
    result, timing = call_planner(planner, problem, Budget(wall_s=wall_s, memory_bytes=MEMORY))
    result, fault = judge_plan(promises, problem, result)
    if fault is not None:
        print(f"{name}: {fault}")
        return Solution(status="failed")
    return Solution(
        status=str(result.status),
        cost=result.plan.sum_of_costs if result.plan is not None else None,
        lower_bound=result.lower_bound,
        seconds=timing["planning_s"],
        cpu_seconds=result.statistics.get("process_cpu_s", timing["planning_cpu_s"]),
    )
