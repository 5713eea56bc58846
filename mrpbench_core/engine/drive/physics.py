"""Executes a plan, and tasks that come over time, in a simulator of robots that drive."""

from contextlib import closing

import numpy as np

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.api.simulator import Simulation
from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.engine.contract_checks import check_returned
from mrpbench_core.engine.drive.outputs import Outputs
from mrpbench_core.engine.drive.planned import PlannedExecution
from mrpbench_core.engine.drive.replanning import calls_timing, replanner_of
from mrpbench_core.engine.drive.tasks import tasks_of
from mrpbench_core.engine.execution.control_loop import ExecutionResult
from mrpbench_core.engine.execution.evaluations import Evaluations
from mrpbench_core.engine.execution.loop import ExecutionLoop
from mrpbench_core.engine.execution.loop_inputs import LoopComponents, LoopInputs
from mrpbench_core.engine.execution.noise import Disturbances
from mrpbench_core.engine.execution.progress import ExecutionProgress
from mrpbench_core.engine.execution.resources import ExecutionError
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.engine.stage import RunInputs
from mrpbench_core.model.runs.routing import Router
from mrpbench_core.model.runs.run import RunContext


class PhysicalExecution(PlannedExecution):
    """Opens the simulator, and drives the robots in it.

    Args:
        inputs: of the run.
        context: with a plan.
        router: turns plans into routes.
        stream: of tasks that come over time, if they do.
    """

    def __init__(self, inputs: RunInputs, context: RunContext, router: Router, stream: TaskStream | None) -> None:
        super().__init__(inputs, context)
        self._router, self._stream = router, stream

    def _run(self, outputs: Outputs) -> ExecutionResult:
        inputs, context, recorder = self._inputs, self.context, outputs.recorder()
        config, seeds = inputs.config, Seeds(inputs.config.seed, inputs.config.repeat)
        assert config.simulator is not None
        components = LoopComponents.of(config)
        replanner = replanner_of(inputs, context, self._router)
        tasks = None if self._stream is None else tasks_of(config, context, self._stream, recorder)
        weighed = config.recording.trajectories
        radii = [mover.radius for mover in self._crowds.members]
        placed = self._poses.copy(), seeds.seed_of("simulator"), context.period, radii
        opened = config.simulator.open(context.world, context.fleet, *placed, levels=self._levels.copy())
        result: ExecutionResult | None = None
        with check_returned(config.simulator, opened, Simulation) as simulation:
            if not np.array_equal(simulation.state.level, self._levels):
                raise ExecutionError("the simulator supports the lowest level only, and robots start on other levels")
            loop = ExecutionLoop(
                LoopInputs(
                    context=context,
                    components=components,
                    crowds=self._crowds,
                    simulation=simulation,
                    placed=self._poses,
                    noise=Disturbances(config.noise, context.fleet, self._poses, context.period, seeds),
                    delays=self._draws().stream(),
                    faults=self._faults,
                    evaluations=None if weighed is None else Evaluations(weighed, len(context.fleet)),
                    recorder=recorder,
                    replanner=replanner,
                    tasks=tasks,
                    limit_s=config.limits.execution,
                    goal_tolerance=config.goal_tolerance,
                    seeds=seeds,
                    hooks=inputs.hooks,
                    progress=ExecutionProgress(inputs.progress, config.limits.execution),
                )
            )
            with closing(loop):
                result = self._finished(loop, recorder)
        if result is None:
            raise BrokenContractError("the simulator hid an exception", "simulator")
        if tasks is not None and tasks.assignment_s:
            inputs.timing.update(calls_timing("assignment", tasks.assignment_s))
        return result
