"""Contract of the kind *crowd* (provisional): people and other things that move among the robots."""

from abc import ABC, abstractmethod
from typing import ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.worlds.world import World


class CrowdSession(ABC):
    """A crowd in motion."""

    radii: tuple[float, ...]
    """Radius of each mover, metres."""

    @abstractmethod
    def step(self, dt: float, state: State) -> Float:
        """Return movers f8[m,4]: x, y, vx, vy after `dt` simulated seconds."""


class Crowd(Component):
    """Starts sessions of movers."""

    group: ClassVar[str] = "mrpbench.crowds"

    @abstractmethod
    def start(self, world: World, seed: int) -> CrowdSession:
        """Place the movers."""
