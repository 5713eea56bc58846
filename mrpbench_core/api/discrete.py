"""Contract of simulators that execute whole runs in steps on the cells of a raster."""

from abc import abstractmethod
from collections.abc import Sequence
from pathlib import Path
from typing import Any, ClassVar

import attrs

from mrpbench_core.api.planner import Planner
from mrpbench_core.api.simulator import Simulation, Simulator
from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class DiscreteRun:
    """The run that a discrete simulator executes."""

    world: World
    fleet: Fleet
    scenario: Scenario
    """The starts."""
    stream: TaskStream
    """The tasks; nothing was asked of it yet."""
    planner: Planner
    """`DiscreteSimulator.skip` has accepted it."""
    duration: float
    """simulated seconds."""
    seed: int
    limit: float
    """Wall seconds of one answer of the planner."""
    iterations: int | None
    """Steps of improvement instead; then the clock is not read."""
    rate: float
    """Samples of a recording per simulated second."""
    exports: Path
    """A folder, which may not exist yet, for files in formats of the simulator's own."""


@attrs.frozen(kw_only=True)
class DiscreteResult:
    """What happened in a discrete execution."""

    channels: Chunk
    """Channels of a recording, from start to end: `time`, `truth`, `truth_twist`, `level`, and those of tasks."""
    calls: Sequence[float]
    """Wall seconds of each call of the planner."""
    overruns: int
    """Answers that came too late."""
    preprocessing: float = 0.0
    """Wall seconds before the first step, which count as no call."""


class DiscreteSimulator(Simulator):
    """Executes whole runs in steps, with tasks that keep coming, and with planners that plan steps.

    No dispatcher, navigator, controller or localizer takes part, and the planner gives no plan of the whole run
    (decision 21).
    """

    executes_runs: ClassVar[bool] = True
    suite: ClassVar[str | None] = "mrpbench_core.testing.suites.discrete:DiscreteSimulatorConformance"

    @abstractmethod
    def skip(self, planner: Planner) -> str | None:
        """Return why this simulator cannot execute what a planner plans, or None."""

    @abstractmethod
    def execute(self, run: DiscreteRun) -> DiscreteResult:
        """Execute a run; equal arguments give equal channels, unless the clock is read (`DiscreteRun.iterations`).

        Raises:
            InputError: the world is not a raster, or the tasks are not of a kind that it executes.
        """

    def open(self, *_: Any, **__: Any) -> Simulation:
        """Raise a TypeError: there are no control periods."""
        raise TypeError(f"{type(self).__name__} executes whole runs")
