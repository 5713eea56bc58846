"""Chooses how a plan is executed: with physics, by its schedule, in steps of a simulator, or not at all."""

from collections.abc import Sequence

import attrs

from mrpbench_core.engine.drive.discrete import DiscreteExecution
from mrpbench_core.engine.drive.execute import Execution, PlanOnly
from mrpbench_core.engine.drive.first_plan import FirstPlan
from mrpbench_core.engine.drive.physics import PhysicalExecution
from mrpbench_core.engine.drive.schedule import ScheduledExecution
from mrpbench_core.engine.stage import RunInputs
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import PlanResult
from mrpbench_core.model.runs.instance import Instance
from mrpbench_core.model.runs.routing import ends_of
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.runs.status import Stage


def execution_of(inputs: RunInputs, instance: Instance, plan: FirstPlan) -> Execution:
    """Return what executes a plan as the configuration says.

    Raises:
        InputError: a fault names what does not exist.
    """
    config = inputs.config
    if plan.failure is not None or not config.executes:
        return PlanOnly(inputs, _context(inputs, instance, plan.result), plan.failure)
    inputs.announce(Stage.EXECUTION, {})
    assigned = instance.tasks_of(plan.result.plan)
    router = instance.router(assigned, config.plan_filter)
    assert plan.result.plan is not None
    context = _context(inputs, instance, plan.result, assigned, router(plan.result.plan))
    if config.execution == "schedule_only":
        return ScheduledExecution(inputs, context)
    if config.simulator is not None and config.simulator.executes_runs:
        assert plan.stream is not None
        return DiscreteExecution(inputs, context, plan.stream)
    return PhysicalExecution(inputs, context, router, plan.stream)


def _context(
    inputs: RunInputs,
    instance: Instance,
    result: PlanResult,
    assigned: tuple[int, ...] | None = None,
    routes: Sequence[Route] = (),
) -> RunContext:
    """The context of the run before its execution."""
    config = inputs.config
    return RunContext(
        run_id=inputs.run_id,
        world=instance.world,
        fleet=instance.fleet,
        scenario=instance.scenario,
        problem=instance.problem,
        result=attrs.evolve(result, history=()),  # wall times are in the record, and recordings are reproducible
        routes=routes,
        goal=ends_of(routes),
        period=1 / config.control_rate,
        latency=config.replanning.latency,
        assigned=instance.tasks_of(None) if assigned is None else assigned,
        planner_assigns=instance.assigned is None,
        goal_tolerance=config.goal_tolerance,
        plan_filter=config.plan_filter,
    )
