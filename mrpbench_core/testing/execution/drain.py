"""Lets a dispatcher release a plan to robots until all have arrived."""

from collections.abc import Callable, Mapping

import numpy as np

from mrpbench_core.api.dispatcher import DispatchError, DispatcherSession
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.testing.execution.delayed_executor import DelayedExecutor
from mrpbench_core.testing.execution.resource_manager import ResourceManager
from mrpbench_core.testing.faults import Fault, require

Replan = Callable[[Int32], tuple[Problem, Plan]]
"""Makes a new problem and plan from the released segments."""
MOST_STEPS = 20_000
IDLE_STEPS = 10
"""Steps without any motion after which robots are said to wait forever."""


def drain(
    session: DispatcherSession,
    executor: DelayedExecutor,
    manager: ResourceManager | None = None,
    replans: Mapping[int, Replan] | None = None,
    revision: int = 0,
    released: Int32 | None = None,
) -> None:
    """Update a dispatcher and move robots, one step for each tick of the roadmap, until all robots have arrived.

    Args:
        session: releases segments.
        executor: moves the robots; its `fault` says afterwards whether they kept apart.
        manager: grants resources.
        replans: makes new plans, by the number of the step after which the dispatcher is to adopt them. A plan that the
            dispatcher refuses is dropped.
        revision: of the plan that the dispatcher has.
        released: what it has released already.

    Raises:
        Fault: the orders are malformed or revoke released segments, or robots wait forever.
    """
    pending = dict(replans or {})
    before = np.zeros(len(executor.routes), np.int32) if released is None else released
    idle = 0
    for step in range(MOST_STEPS):
        granted = () if manager is None else manager.granted(sure=idle > 0)
        orders = session.update(step * executor.problem.roadmap.tick, executor.view(revision, granted))
        require_orders(orders, before, executor.plan)
        before = orders.released
        if manager is not None:
            manager.take(orders.requests)
        alive = executor.step(step, before)
        if manager is not None:
            manager.watch(executor)
        if step in pending:
            problem, plan = pending.pop(step)(before)
            try:
                session.adopt(problem, plan)
            except DispatchError:
                continue
            executor.adopt(problem, plan)
            revision += 1
        elif executor.done and not pending:
            return
        idle = 0 if alive or pending else idle + 1
        last = max((int(path.leave[-1]) for path in executor.plan.paths if len(path)), default=0)
        if idle > IDLE_STEPS and step > 2 * last:  # a dispatcher may wait for the clock
            break
    waiting = [robot for robot, path in enumerate(executor.plan.paths) if executor.reached[robot] < len(path)]
    raise Fault(f"robots {waiting} wait forever")


def require_orders(orders: Orders, before: Int32, plan: Plan) -> None:
    """Require that orders release segments that exist, and take nothing back."""
    require(isinstance(orders, Orders), f"returns {type(orders).__name__} instead of Orders")
    released, lengths = orders.released, np.array([len(path) for path in plan.paths], int)
    require(released.shape == before.shape, f"released has shape {released.shape} for {len(before)} robots")
    exists = (released >= 0).all() and (released <= lengths).all()
    require(exists, f"releases {released.tolist()} of {lengths.tolist()} segments")
    require((released >= before).all(), f"takes back what it had released: {before.tolist()}, then {released.tolist()}")
