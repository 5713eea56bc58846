"""The loop that executes a plan: simulator, localizer, dispatcher, navigator, and again."""

from collections.abc import Callable
from typing import Any, Self

import attrs
import numpy as np

from mrpbench_core.api.controller import Controller
from mrpbench_core.api.dispatcher import Dispatcher
from mrpbench_core.api.localizer import Localizer
from mrpbench_core.api.navigator import Navigator
from mrpbench_core.api.simulator import Simulation
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.answers import Answers
from mrpbench_core.engine.noise import Disturbances
from mrpbench_core.engine.recorder import Recorder
from mrpbench_core.engine.seeds import seed_of
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.execution import (
    FleetObservation,
    FleetView,
    Inputs,
    Mode,
    Motion,
    State,
)
from mrpbench_core.model.run import RunContext


class MissionError(Exception):
    """The execution cannot go on; says why."""


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
class Outcome:
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
    limit_s: float,
    seeds: tuple[int, int],
    stepped: Callable[[float, State], Any] | None = None,
) -> Outcome:
    """Run until every robot has completed its path, all that have not gave up, or `limit_s` simulated seconds passed.

    Args:
        context: world, fleet, problem, plan and routes.
        stack: the components in the loop.
        simulation: opened with the robots in place.
        noise: errors of sensors, motors and starts.
        recorder: gets everything that happens; flushed at the end.
        limit_s: simulated seconds.
        seeds: seed and repeat of the run.
        stepped: called after every period.

    Raises:
        BrokenContractError: a component returned what its contract rules out.
        DispatchError: the dispatcher refuses the plan.
        MissionError: a component asked for what this loop cannot do.
    """
    plan = context.result.plan
    assert plan is not None
    robots = len(context.fleet)
    period = context.period
    length = np.array([len(path) for path in plan.paths])
    answers = Answers(length)
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
    step = 0
    while True:
        now = step * period
        odometry = noise.odometry(state)
        scans = noise.scans(answers.scans(simulation.scans()))
        truth = state.pose if stack.localizer.needs_truth else None
        estimate = answers.estimate(localizer.update(now, odometry, scans, truth))
        view = FleetView(
            revision=0,
            reached=motion.reached,
            cleared=motion.cleared,
            pose=estimate.pose,
            level=state.level,
            mode=motion.mode,
        )
        orders = answers.orders(dispatcher.update(now, view))
        if orders.replan is not None:
            raise MissionError(f"the dispatcher asked for a new plan ({orders.replan}), which is not available yet")
        if orders.requests:
            raise MissionError(f"the dispatcher asked for {orders.requests[0][1]}, and nothing grants that yet")
        observation = FleetObservation(estimate=estimate, odometry=odometry, level=state.level, scans=scans)
        motion = answers.motion(navigator.step(now, observation, orders))
        held = (now < noise.start_delay)[:, None]
        motion = attrs.evolve(motion, twist=np.where(held, 0.0, motion.twist))
        arrived = bool((motion.reached >= length).all())
        gave_up = motion.mode == Mode.ABORTED
        over = arrived or bool((gave_up | (motion.reached >= length)).all()) or now >= limit_s
        recorder.scans(scans)
        recorder.events(motion.events)
        recorder.sample(step, now, state, estimate, odometry, orders, motion, over)
        if stepped is not None:
            stepped(now, state)
        if over:
            recorder.flush()
            return Outcome(arrived=arrived, aborted=bool(gave_up.any()), simulated_s=now)
        state = answers.state(simulation.step(Inputs(twist=noise.actuated(motion.twist))))
        step += 1
        recorder.contacts(step * period, state)
