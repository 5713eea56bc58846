"""Contract of the kind *world*."""

from abc import abstractmethod
from typing import ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.model.worlds.world import World


class WorldSource(Component):
    """Loads or generates a world."""

    group: ClassVar[str] = "mrpbench.worlds"

    @abstractmethod
    def load(self) -> World:
        """Return the world.

        Raises:
            InputError: the file is missing, malformed or not supported; the error names file and line.
        """
