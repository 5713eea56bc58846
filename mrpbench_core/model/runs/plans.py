"""The plans of an execution, one after another."""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.runs.routes import RouteHistory
from mrpbench_core.model.runs.run import Loaders, RunContext

MOST_WAYPOINTS = 1_000_000
"""Number of waypoints of all plans above which only the last plan is read."""


@attrs.frozen(kw_only=True)
class RecordedPlan:
    """A plan that was executed for a part of the execution."""

    time: float
    """Simulated second from which on it is executed."""
    routes: Sequence[Route]
    plan: Plan | None
    """None where nothing is known but the routes."""


def spans(plans: Sequence[RecordedPlan], time: Float) -> list[tuple[RecordedPlan, slice]]:
    """Return each plan with the samples, of `time` f8[T], at which it is executed."""
    limits = [*np.searchsorted(time, [plan.time for plan in plans]).tolist(), len(time)]
    return [(plan, slice(begin, end)) for plan, begin, end in zip(plans, limits, limits[1:], strict=False)]


def read_plans(context: RunContext, channels: Loaders) -> list[RecordedPlan]:
    """Return the plans of an execution in their order, the first of them executed from second 0 on.

    They are all, or the last one, which begins with all that was driven before.

    Args:
        context: as it was before the execution.
        channels: those of its recording.
    """
    history = RouteHistory(context, channels)
    if history.count() > MOST_WAYPOINTS:
        routes, plan = history.latest()
        return [RecordedPlan(time=0.0, routes=routes, plan=plan)]
    return [RecordedPlan(time=time, routes=routes, plan=plan) for time, routes, plan in history.plans()]
