"""Executions of drawn plans under drawn delays, also with resources and with new plans on the way."""

from collections.abc import Mapping
from typing import NamedTuple

import attrs
import numpy as np

from mrpbench_core.api.dispatcher import Dispatcher, DispatchError
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.engine.execution.commitments import commitments
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.testing.execution.delayed_executor import DelayedExecutor
from mrpbench_core.testing.execution.drain import Replan, drain
from mrpbench_core.testing.execution.resource_manager import ResourceManager
from mrpbench_core.testing.faults import require
from mrpbench_tests.instances.random_plans import random_plan, random_plan_with_resources, wander


class Ended(NamedTuple):
    """How an execution ended."""

    reordered: bool
    """Robots have reached a vertex in another order than in the plan."""
    sum_of_arrivals: int
    """steps."""
    trace: tuple[bytes, ...]
    """What was reached after each step."""


class Watched(DelayedExecutor):
    """Keeps what robots have reached after each step."""

    def __init__(self, problem: Problem, plan: Plan, random: np.random.Generator) -> None:
        super().__init__(problem, plan, random)
        self.trace: list[bytes] = []
        self.sum_of_arrivals = 0

    def step(self, now: int, released: Int32) -> bool:
        """Move all robots a little."""
        alive = super().step(now, released)
        self.trace.append(self.reached.tobytes())
        self.sum_of_arrivals += sum(self.reached < [len(path) for path in self.plan.paths])
        return alive


def drained(dispatcher: Dispatcher, seed: int | list[int], resources: bool = False, replans: int = 0) -> Ended | None:
    """Drain a drawn plan, with `replans` new plans on the way.

    Returns:
        How the execution ended, None if the dispatcher refuses the plan.

    Raises:
        Fault: robots wait forever, meet, or are in resources that they do not hold.
    """
    random = np.random.default_rng(seed)
    problem, plan = (random_plan_with_resources if resources else random_plan)(random)
    if replans:
        problem = attrs.evolve(problem, rules=attrs.evolve(problem.rules, at_goal="stay"))
        if not check_plan(problem, plan).valid:
            return None
    try:
        session = dispatcher.start(problem, plan)
    except DispatchError:
        return None
    executor = Watched(problem, plan, random)
    manager = ResourceManager(problem, random) if resources else None
    drain(session, executor, manager, _new_plans(executor, random, replans))
    require(executor.fault is None, str(executor.fault))
    require(manager is None or manager.fault is None, str(manager and manager.fault))
    return Ended(executor.reordered, executor.sum_of_arrivals, tuple(executor.trace))


def _new_plans(executor: Watched, random: np.random.Generator, count: int) -> Mapping[int, Replan]:
    late = [int(random.integers(0, 40))]

    def replan(released: Int32) -> tuple[Problem, Plan]:
        problem, plan = executor.problem, executor.plan
        now, due = late[-1], late[-1] + int(random.integers(0, 40))
        late.append(due)
        ready = now + random.integers(0, 5, len(problem))
        prefixes = commitments(problem, plan, released, executor.reached, ready, due)
        committed = attrs.evolve(problem, commitments=prefixes)
        if not check_plan(committed, Plan(paths=prefixes)).valid:
            return problem, plan  # no planner finds a plan, so robots go on with the one that they have
        return committed, wander(committed, random, list(prefixes), ticks=5)

    return {int(step): replan for step in random.integers(0, 60, count)}
