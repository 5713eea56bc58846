"""Contract of the kind *simulator*."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from types import TracebackType
from typing import ClassVar, Self

from mrpbench_core.api.component import Component
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.execution.state import Inputs, State
from mrpbench_core.model.worlds.world import World


class Simulation(ABC):
    """A running simulation, used as a context manager. It is exact, since the engine adds all sensor noise."""

    @property
    @abstractmethod
    def state(self) -> State:
        """The true state now; before the first step, that of the placements."""

    @abstractmethod
    def step(self, inputs: Inputs) -> State:
        """Advance by one control period with constant `inputs`."""

    @abstractmethod
    def scans(self) -> tuple[ScanBatch, ...]:
        """Scans taken since the last call, in order of time; each has the beams of its robots' lidars."""

    @abstractmethod
    def close(self) -> None:
        """Release all resources; may be called twice."""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


class Simulator(Component):
    """Moves robots through a world and takes their scans."""

    group: ClassVar[str] = "mrpbench.simulators"
    executes_runs: ClassVar[bool] = False
    """True if it executes whole runs by itself; see `mrpbench_core.api.discrete`."""

    @abstractmethod
    def open(
        self,
        world: World,
        fleet: Fleet,
        placements: Float,
        seed: int,
        period: float,
        movers: Sequence[float] = (),
        levels: Int16 | None = None,
    ) -> Simulation:
        """Place robots at `placements` f8[n,3] on `levels` i2[n] (None: all on level 0).

        `period` is the control period in simulated seconds; the simulator subdivides it as it likes. `movers` are the
        radii in metres of discs that are not robots and that `Inputs.movers` moves. Doors are closed at first. A
        simulator that has doors and lifts reports them in `State.facilities`, and moves them by the rules of
        `mrpbench_core.model.worlds.facilities`.
        """
