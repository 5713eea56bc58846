"""Contract of the kind *crowd*: people and other things that move among the robots, and are not robots."""

from abc import ABC, abstractmethod
from collections.abc import Set
from typing import Any, ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.movers import CrowdView, Mover, Movers
from mrpbench_core.model.worlds.world import World


def in_body(crowd: Any, _: Any, leg_radius: float) -> None:
    """Validate that the legs of a crowd with the options `radius` and `leg_radius` are not larger than bodies."""
    if leg_radius > crowd.radius:
        raise ValueError(f"'leg_radius' must be at most radius = {crowd.radius:g} m, got {leg_radius:g} m")


class CrowdSession(ABC):
    """A crowd in motion."""

    members: tuple[Mover, ...]
    """What moves, by index."""

    @property
    @abstractmethod
    def movers(self) -> Movers:
        """Where the members are now; before the first step, where they begin."""

    @abstractmethod
    def step(self, dt: float, view: CrowdView) -> Movers:
        """Move for `dt` simulated seconds; nothing but the crowd itself keeps its members out of walls and robots.

        Crowds move in turn, in the order of the configuration: those before this one have moved already, so that none
        of two crowds comes to the same place. Robots are seen where they were at the beginning of the period. A member
        stays on its level, and moves at most 5 m/s, or more than a metre in one step: then it is put there.
        """

    def wanted_doors(self) -> Set[str]:
        """Return the names of the doors (`Facilities.names`) that members want to be open now."""
        return frozenset()


class Crowd(Component):
    """Starts sessions of movers."""

    group: ClassVar[str] = "mrpbench.crowds"

    @abstractmethod
    def start(self, world: World, fleet: Fleet, seed: int, view: CrowdView) -> CrowdSession:
        """Place the movers.

        Args:
            world: where they move.
            fleet: the robots, whose radii they need to avoid them.
            seed: of everything random; what a member does at random depends on the seed and its index alone.
            view: the robots at rest where they begin, and the movers of the crowds before this one.

        Raises:
            InputError: the world has no room for them, or a place that an option names is not free.
        """


__all__ = ["Crowd", "CrowdSession", "CrowdView", "Mover", "Movers"]
