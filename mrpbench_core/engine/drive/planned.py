"""What executions of a plan have in common: faults, people and other movers, and delays."""

import attrs
import numpy as np

from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.drive.execute import TimedExecution
from mrpbench_core.engine.execution.control_loop import ControlLoop, ExecutionResult
from mrpbench_core.engine.execution.crowds import Crowds
from mrpbench_core.engine.execution.draws import DelayDraws
from mrpbench_core.engine.execution.faults import FaultState, draw_faults
from mrpbench_core.engine.execution.recorder import Recorder
from mrpbench_core.engine.execution.worst_case import Adversary
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.engine.stage import RunInputs
from mrpbench_core.model.execution.motion import Event
from mrpbench_core.model.runs.routing import start_poses
from mrpbench_core.model.runs.run import RunContext


class PlannedExecution(TimedExecution):
    """Executes a plan in control periods.

    Args:
        inputs: of the run.
        context: with a plan.

    Raises:
        InputError: a fault names what does not exist.
    """

    def __init__(self, inputs: RunInputs, context: RunContext) -> None:
        super().__init__(inputs, context)
        config = inputs.config
        self._faults = _faults(config, context)
        self._poses = start_poses(context.routes, context.scenario.start[:, 2])
        self._levels = np.array([route.level[0] for route in context.routes], np.int16)
        self._crowds = Crowds(
            config.crowds,
            context.world,
            context.fleet,
            context.period,
            Seeds(config.seed, config.repeat),
            [event for event in self._faults.events if event.kind == "blocked"],
            poses=self._poses,
            levels=self._levels,
            apart=config.crowds_apart,
        )
        self.context = attrs.evolve(context, movers=self._crowds.members)

    def _finished(self, loop: ControlLoop, recorder: Recorder) -> ExecutionResult:
        """Run the loop, and record why robots did not arrive."""
        result, names = loop.run(), self.context.fleet.names
        self.unarrived = {names[robot]: reason for robot, reason in result.unarrived.items()}
        for robot, reason in result.unarrived.items():
            recorder.events([Event(stamp=result.simulated_s, kind="not_arrived", robot=robot, detail=reason)])
        return result

    def _draws(self) -> DelayDraws:
        """The delays of the run, and of its further draws."""
        config, context = self._inputs.config, self.context
        settings, plan = config.delays, context.result.plan
        assert plan is not None
        attack = settings.worst_case * settings.tick
        adversary = Adversary(context.problem, plan, attack) if attack else None
        return DelayDraws(settings, len(context.fleet), Seeds(config.seed, config.repeat), adversary)


def _faults(config: RunConfig, context: RunContext) -> FaultState:
    """The faults of the run."""
    roadmap, robots = context.problem.roadmap, len(context.fleet)
    names = [resource.name for resource in roadmap.resources if resource.kind != "mutex"]
    events = draw_faults(
        config.faults, robots, roadmap, names, config.limits.execution, Seeds(config.seed, config.repeat)
    )
    return FaultState(config.faults, events, robots)
