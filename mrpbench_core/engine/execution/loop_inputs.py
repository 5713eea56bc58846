"""The components and inputs of an execution with physics."""

from collections.abc import Callable
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.api.controller import Controller
from mrpbench_core.api.dispatcher import Dispatcher
from mrpbench_core.api.localizer import Localizer
from mrpbench_core.api.navigator import Navigator
from mrpbench_core.api.simulator import Simulation
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.execution.crowds import Crowds
from mrpbench_core.engine.execution.delays import DelayStream
from mrpbench_core.engine.execution.evaluations import Evaluations
from mrpbench_core.engine.execution.faults import FaultState
from mrpbench_core.engine.execution.noise import Disturbances
from mrpbench_core.engine.execution.recorder import Recorder
from mrpbench_core.engine.execution.replanning import Replanner
from mrpbench_core.engine.execution.task_manager import TaskManager
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.plugins.hooks import Hooks


@attrs.frozen(kw_only=True)
class LoopComponents:
    """The components that take part in the loop, besides the simulator."""

    localizer: Localizer
    dispatcher: Dispatcher
    navigator: Navigator
    controller: Controller

    @classmethod
    def of(cls, config: RunConfig) -> Self:
        """The components that a configuration names.

        Raises:
            InputError: a component that execution needs is `none`, or needs true poses that are not granted.
        """
        chosen = {}
        for field in attrs.fields(cls):
            chosen[field.name] = getattr(config, field.name)
            if chosen[field.name] is None:
                raise InputError(f"{field.name}: cannot be 'none' when there is a simulator")
        inputs = cls(**chosen)
        if config.granted_localizer is not None and not config.grant_truth:
            raise InputError(
                f"localizer: {type(inputs.localizer).__name__} needs the true poses",
                hint="`grant_truth: true` grants them",
            )
        return inputs

    @property
    def needs_truth(self) -> bool:
        """True if the localizer needs the true poses."""
        return bool(self.localizer.needs_truth)


@attrs.frozen(kw_only=True)
class LoopInputs:
    """The inputs of an execution."""

    context: RunContext
    """World, fleet, problem, plan and routes."""
    components: LoopComponents
    crowds: Crowds
    """The people and other movers."""
    simulation: Simulation
    """Opened, with the robots at `placed`."""
    placed: NDArray[np.float64]
    """f8[n,3] start poses."""
    noise: Disturbances
    """Errors of sensors, motors and start times."""
    delays: DelayStream
    """Stops and speeds of the robots."""
    faults: FaultState
    """What fails."""
    evaluations: Evaluations | None = None
    """Collects what controllers weigh; None = it is not recorded."""
    recorder: Recorder
    """Receives everything that happens; flushed at the end."""
    replanner: Replanner
    """Asks for new plans; knows the first one."""
    tasks: TaskManager | None = None
    """The tasks that come over time; None = the robots go to the goals of the first plan."""
    limit_s: float
    """Simulated seconds after which the execution ends."""
    goal_tolerance: float
    """Metres from its goal within which a robot has arrived."""
    seeds: Seeds
    """Of the run."""
    hooks: Hooks
    """Called after every control period; see `mrpbench_core.api.hooks`."""
    progress: Callable[[float, NDArray[np.bool_]], None] = lambda now, arrived: None  # noqa: ARG005
    """Called in every control period with the simulated seconds and whether each robot has arrived."""
