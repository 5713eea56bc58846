"""Reads the plans of a recording, which the page shows one after another."""

import attrs

from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.runs.run import all_plans, all_routes
from mrpbench_core.store.recording import Recording

MOST_WAYPOINTS = 1_000_000
"""Number of waypoints above which only the last plan is shown."""


@attrs.frozen(kw_only=True)
class RecordedPlan:
    """A plan that was in force during the execution."""

    time: float
    """Simulated second since which it is in force."""
    routes: tuple[Route, ...]
    plan: Plan | None
    """None where nothing is known but the routes."""


def read_plans(recording: Recording) -> list[RecordedPlan]:
    """Return the plans of an execution in their order, the first of them in force from second 0."""
    context = recording.first_context()
    routes, plans = all_routes(context.routes, recording.channels), all_plans(context, recording.channels)
    return [RecordedPlan(time=time, routes=own, plan=plan) for (time, own), plan in zip(routes, plans, strict=True)]


def shown_plans(plans: list[RecordedPlan]) -> list[RecordedPlan]:
    """Return the plans that a page can hold: all, or the last one, which begins with all that was driven before."""
    if sum(len(route.waypoint) for plan in plans for route in plan.routes) <= MOST_WAYPOINTS:
        return plans
    return [attrs.evolve(plans[-1], time=0.0)]
