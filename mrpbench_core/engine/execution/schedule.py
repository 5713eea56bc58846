"""A plan that is executed without physics, once or more often: what its executions share."""

import numpy as np

from mrpbench_core.api.dispatcher import BatchSession, Dispatcher, DispatcherSession
from mrpbench_core.engine.contract_checks import ContractChecks, check_returned
from mrpbench_core.engine.execution.scheduled_paths import ScheduledPaths
from mrpbench_core.model.runs.run import RunContext


class Schedule:
    """The plan of a run, and a dispatcher that releases it.

    Args:
        context: of the run, with a plan.
        dispatcher: releases the plan.

    Raises:
        DispatchError: the dispatcher refuses the plan.
    """

    def __init__(self, context: RunContext, dispatcher: Dispatcher) -> None:
        assert context.result.plan is not None
        self.context, self.plan = context, context.result.plan
        self.paths = ScheduledPaths(context)
        self._dispatcher = dispatcher
        self._ready: DispatcherSession | None = self._start()

    def session(self) -> DispatcherSession:
        """A session for one execution: a copy of one that has just been started, where the dispatcher can make one."""
        session = self._ready or self._start()
        self._ready = session.copied()
        return session

    def batch(self, executions: int) -> BatchSession | None:
        """A session for so many executions at once, where the dispatcher can make one."""
        self._ready = self._ready or self._start()
        return self._ready.batch(executions)

    def checks(self) -> ContractChecks:
        """Checks of what the session of one execution returns."""
        return ContractChecks(np.array([len(path) for path in self.plan.paths], np.int64))

    def _start(self) -> DispatcherSession:
        started = self._dispatcher.start(self.context.problem, self.plan)
        return check_returned(self._dispatcher, started, DispatcherSession)
