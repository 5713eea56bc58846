"""The dispatcher `rmf`: posts plans, and releases them by any dispatcher."""

from collections.abc import Sequence
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import (
    Dispatcher,
    DispatcherSession,
    FleetView,
    Int,
    Int32,
    Orders,
    Plan,
    Problem,
    option,
)
from mrpbench_live.rmf.traffic.shared import traffic_of
from mrpbench_live.rmf.traffic.traffic import Traffic


@attrs.frozen(kw_only=True)
class RmfPlanServer(Dispatcher):
    """Posts the plans of `planner: rmf`, and with `release` executes them: any dispatcher decides who may go on.

    With an executor of others, or robots that watch the blockers of their plans themselves, `release` is off; the
    dispatcher must then release no less than they do, such as `adg` with a large `lookahead`.
    """

    live: ClassVar[bool] = True

    dispatcher: Dispatcher = option(help="decides how far along its plan each robot may go")
    release: bool = option(True, help="publish what the dispatcher releases")

    def start(self, problem: Problem, plan: Plan) -> DispatcherSession:
        """Begin with robots that stand.

        Raises:
            InputError: the simulator is another one.
            DispatchError: see `dispatcher`.
        """
        return _PlanServer(traffic_of("dispatcher"), self.dispatcher.start(problem, plan), self.release, problem)


class _PlanServer(DispatcherSession):
    """Posts plans, and what a dispatcher releases of them."""

    def __init__(self, traffic: Traffic, session: DispatcherSession, releases: bool, problem: Problem) -> None:
        self._traffic, self._session, self._releases, self._problem = traffic, session, releases, problem
        self._reached: Int = np.zeros(len(problem), np.int64)
        self._released: Int = np.zeros(len(problem), np.int64)

    def update(self, now: float, view: FleetView) -> Orders:
        events = self._traffic.hear(now, self._problem)
        orders = self._session.update(now, view)
        self._reached, self._released = view.reached.astype(np.int64), orders.released.astype(np.int64)
        if self._releases:
            self._traffic.release(orders.released)
        reason = self._traffic.replan(now)
        if not events and orders.replan == reason:
            return orders
        return attrs.evolve(orders, replan=reason or orders.replan, events=(*orders.events, *events))

    def adopt(self, problem: Problem, plan: Plan, cut: Int32 | None = None) -> None:
        gone = np.zeros(len(problem), np.int64) if cut is None else cut.astype(np.int64)
        reached = np.maximum(self._reached - gone, 0)
        released = np.maximum(self._released - gone, problem.committed)
        composed = self._traffic.compose(problem, plan, reached, released, reached + gone)
        self._session.adopt(problem, plan, cut)
        self._traffic.post(problem, composed)
        self._problem = problem

    def waits_for(self, robot: int) -> Sequence[int] | None:
        return self._session.waits_for(robot)

    def close(self) -> None:
        self._session.close()
