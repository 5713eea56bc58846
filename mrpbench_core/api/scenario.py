"""Contract of the kind *scenario*."""

from abc import abstractmethod
from typing import ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.worlds.world import World


class ScenarioSource(Component):
    """Draws or reads starts and goals."""

    group: ClassVar[str] = "mrpbench.scenarios"
    gives_goals: ClassVar[bool] = False
    """True if task i is the goal of robot i. The default assigner is then `identity`, and records count the robots to
    which another assigner gives another goal."""

    @abstractmethod
    def size(self) -> int:
        """Return the number of robots before anything is loaded.

        Raises:
            InputError: the file that contains the number is missing or malformed.
        """

    @abstractmethod
    def draw(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> Scenario:
        """Return starts and goals in metres for `len(fleet) == size()` robots; equal arguments give equal results.

        Raises:
            InputError: the world cannot hold the scenario (too few vertices, unknown names).
        """
