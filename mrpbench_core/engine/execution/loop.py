"""The loop that executes a plan: simulator, localizer, dispatcher, navigator, and again."""

from collections.abc import Callable
from typing import Any, Self

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.api.controller import Controller
from mrpbench_core.api.dispatcher import Dispatcher, DispatchError, DispatcherSession
from mrpbench_core.api.localizer import Localizer
from mrpbench_core.api.navigator import Navigator, NavigatorSession
from mrpbench_core.api.simulator import Simulation
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.contract_checks import ContractChecks
from mrpbench_core.engine.execution.facility_manager import FacilityManager
from mrpbench_core.engine.execution.noise import Disturbances
from mrpbench_core.engine.execution.recorder import Recorder
from mrpbench_core.engine.execution.replanning import Replanner, Revision
from mrpbench_core.engine.seeds import seed_of
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.arrays import Bool
from mrpbench_core.model.execution import (
    Event,
    FleetObservation,
    FleetView,
    Inputs,
    Mode,
    Motion,
    Orders,
)
from mrpbench_core.model.plan import Plan
from mrpbench_core.model.run import RunContext

WAITING, ABORTED = int(Mode.WAITING), int(Mode.ABORTED)


@attrs.frozen(kw_only=True)
class Stack:
    """The components that execute a plan."""

    localizer: Localizer
    dispatcher: Dispatcher
    navigator: Navigator
    controller: Controller

    @classmethod
    def of(cls, config: RunConfig) -> Self:
        """The components that a configuration names.

        Raises:
            InputError: a stage that execution needs is `none`.
        """
        chosen = {}
        for field in attrs.fields(cls):
            chosen[field.name] = getattr(config, field.name)
            if chosen[field.name] is None:
                raise InputError(f"{field.name}: cannot be 'none' when there is a simulator")
        return cls(**chosen)


@attrs.frozen(kw_only=True)
class ExecutionResult:
    """How an execution ended."""

    arrived: bool
    """Every robot completed its path."""
    aborted: bool
    """Some robot gave up."""
    simulated_s: float


def execute_plan(
    context: RunContext,
    stack: Stack,
    simulation: Simulation,
    noise: Disturbances,
    recorder: Recorder,
    replans: Replanner,
    limit_s: float,
    seeds: tuple[int, int],
    stepped: Callable[..., Any] | None = None,
) -> ExecutionResult:
    """Run until every robot has completed its path, all that have not gave up, or `limit_s` simulated seconds passed.

    Args:
        context: world, fleet, problem, plan and routes.
        stack: the components in the loop.
        simulation: opened with the robots in place.
        noise: errors of sensors, motors and starts.
        recorder: gets everything that happens; flushed at the end.
        replans: asks for new plans; knows the first one.
        limit_s: simulated seconds.
        seeds: seed and repeat of the run.
        stepped: called after every period; see `mrpbench_core.api.hooks`.

    Raises:
        BrokenContractError: a component returned what its contract rules out.
        DispatchError: the dispatcher refuses the plan.
        ExecutionError: a dispatcher asks for what there is not.
    """
    plan = context.result.plan
    assert plan is not None
    robots = len(context.fleet)
    period = context.period
    answers = ContractChecks(_length(plan))
    state = answers.state(simulation.state)
    dispatcher = stack.dispatcher.start(context.problem, plan)
    localizer = stack.localizer.start(context.fleet, context.world, state.pose, seed_of(*seeds, "localizer"))
    navigator = stack.navigator.start(
        context.fleet, context.world, context.routes, stack.controller, period, seed_of(*seeds, "navigator")
    )
    motion = Motion(
        twist=np.zeros((robots, 2)),
        reached=np.zeros(robots, "i4"),
        cleared=np.zeros(robots, "i4"),
        mode=np.full(robots, Mode.WAITING, "u1"),
    )
    orders = Orders(released=np.zeros(robots, "i4"))
    routes = context.routes
    facility_manager = FacilityManager(context.world, context.problem, plan)
    revision = step = 0
    while True:
        now = step * period
        odometry = noise.odometry(state)
        scans = noise.scans(answers.scans(simulation.scans()))
        truth = state.pose if stack.localizer.needs_truth else None
        estimate = answers.estimate(localizer.update(now, odometry, scans, truth))
        view = FleetView(
            revision=revision,
            reached=motion.reached,
            cleared=motion.cleared,
            pose=estimate.pose,
            level=state.level,
            mode=motion.mode,
        )
        view = facility_manager.granted(view, state)
        if replans.pending is None:
            orders = answers.orders(dispatcher.update(now, view))
            if reason := replans.reason(now, view, orders.replan):
                replans.request(now, reason, view, orders.released)
        if new := replans.take(now):
            recorder.events((_adopt(new, now, dispatcher, navigator, replans),))
            if replans.plan is new.plan:
                revision += 1
                answers.adopt(_length(replans.plan))
                routes = new.routes
                recorder.routes(now, revision, routes)
                facility_manager.adopt(new.problem, replans.plan)
                orders = answers.orders(dispatcher.update(now, attrs.evolve(view, revision=revision)))
        facility_manager.take(orders)
        observation = FleetObservation(estimate=estimate, odometry=odometry, level=state.level, scans=scans)
        motion = answers.motion(navigator.step(now, observation, _held_back(orders, now < noise.start_delay)))
        at_goal = (motion.reached >= answers.length) & (motion.mode == WAITING)
        gave_up = motion.mode == ABORTED
        arrived = bool(at_goal.all())
        over = bool((at_goal | gave_up).all()) or now >= limit_s
        recorder.scans(scans)
        recorder.events(motion.events)
        recorder.sample(
            step,
            now,
            state,
            estimate,
            odometry,
            orders,
            motion,
            facility_manager.waiting(robots),
            facility_manager.doing(state),
            over,
        )
        if stepped is not None:
            stepped(now=now, state=state, observation=observation, routes=routes)
        if over:
            recorder.flush()
            return ExecutionResult(arrived=arrived, aborted=bool(gave_up.any()), simulated_s=now)
        commands = facility_manager.commands(motion.reached, orders.released, state)
        inputs = Inputs(twist=noise.actuated(motion.twist), facilities=commands)
        state = answers.state(simulation.step(inputs))
        step += 1
        recorder.contacts(step * period, state)


def _length(plan: Plan) -> NDArray[np.int64]:
    """Segments i8[n] of each path."""
    return np.array([len(path) for path in plan.paths], np.int64)


def _adopt(
    new: Revision, now: float, dispatcher: DispatcherSession, navigator: NavigatorSession, replans: Replanner
) -> Event:
    """Put a new plan in force if there is one and the dispatcher takes it; returns what happened."""
    fault = new.fault
    if new.plan is not None and not fault:
        try:
            dispatcher.adopt(new.problem, new.plan)
        except DispatchError as error:
            fault = str(error)
        else:
            navigator.adopt(new.routes)
            replans.use(new.problem, new.plan)
            return Event(stamp=now, kind="replan", detail=new.reason)
    replans.failed(now)
    return Event(stamp=now, kind="replan_failed", detail=f"{new.reason}; {fault}")


def _held_back(orders: Orders, late: Bool) -> Orders:
    """The orders as robots know them of which some are `late` bool[n] at the start: to those nothing is released."""
    return attrs.evolve(orders, released=np.where(late, 0, orders.released)) if late.any() else orders
