"""Contract of the kind *roadmap*."""

from abc import abstractmethod
from typing import ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.world import World


class RoadmapBuilder(Component):
    """Builds the discrete graph that planners search."""

    group: ClassVar[str] = "mrpbench.roadmaps"
    clears_walls: ClassVar[bool] = True
    """False if edges may lead through walls, because controllers find the way."""

    @abstractmethod
    def build(self, world: World, fleet: Fleet) -> Roadmap:
        """Return a roadmap on which each robot of `fleet` keeps clear of walls, unless `clears_walls` is false.

        It follows from the options, `world` and `fleet` alone: runs that agree in these share it.
        `Roadmap.duration` has one row per profile of `fleet.profiles`. `Roadmap.notes` lists what was left out.

        Raises:
            InputError: no drivable vertex is left.
        """
