"""Contract of the kind *task source*."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.worlds.world import World


class TaskStream(ABC):
    """The tasks of one run, in the order of their release.

    Task i is a function of seed and i alone, so that all planners meet the same tasks. Where tasks arrive whatever is
    finished, this includes its release.
    """

    @abstractmethod
    def released(self, now: float, finished: int) -> Sequence[Task]:
        """Return the tasks that were released after the last call and until `now`, which never decreases.

        Args:
            now: simulated seconds.
            finished: number of tasks done so far, which only a closed pool regards.

        Their indices count on, from 0, and no `release` is later than `now`.
        """

    def elsewhere(self, now: float, state: State) -> Mapping[int, tuple[float, float, int] | None]:  # noqa: ARG002
        """Return the robots that take no task for now, such as those that charge, each with where it goes instead.

        Called every control period in which no plan is pending, with simulated seconds and the true state. A robot
        first finishes the task that it has begun. A place is x, y (metres) and level; None: the robot makes room.
        """
        return {}

    @property
    def places(self) -> tuple[Float, Int16] | None:
        """Positions f8[k,2] (metres) and levels i2[k] at which errands of the stream may be; None: not known."""
        return None

    @property
    def ended(self) -> bool:
        """True if no task will be released any more."""
        return False


class TaskSource(Component):
    """Gives tasks over time; the scenario then gives the starts alone."""

    group: ClassVar[str] = "mrpbench.task_sources"

    @abstractmethod
    def start(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> TaskStream:
        """Begin the stream of a seed; equal arguments give equal streams.

        Raises:
            InputError: the world cannot hold the tasks (no places, unknown names).
        """
