"""Tasks that arrive at random times, whatever is finished."""

from collections.abc import Sequence

import attrs

from mrpbench_core.api.component import option
from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.builtin.task_sources.drawn import ARRIVALS, AnyPlace, Drawing, stream
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class Poisson(AnyPlace):
    """Tasks arrive independently of one another (a Poisson process), at random places of the world."""

    rate: float = option(help="tasks per simulated minute", validator=attrs.validators.gt(0))

    def start(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> TaskStream:  # noqa: ARG002
        """Begin the stream of `seed`."""
        return PoissonStream(Drawing(self, self.places(world, roadmap), seed), self.rate / 60)


class PoissonStream(TaskStream):
    """Arrivals with exponential times between them.

    Args:
        drawing: draws the errands.
        rate: tasks per second.
    """

    def __init__(self, drawing: Drawing, rate: float) -> None:
        self._drawing, self._rate = drawing, rate
        self._index, self._next = 0, 0.0
        self._next = self._gap()

    def released(self, now: float, finished: int) -> Sequence[Task]:  # noqa: ARG002
        """Return the tasks that arrived until `now`."""
        tasks = []
        while self._next <= now:
            tasks.append(self._drawing.task(self._index, self._next))
            self._index += 1
            self._next += self._gap()
        return tasks

    @property
    def places(self) -> tuple[Float, Int16]:
        """Where errands are drawn."""
        return self._drawing.places

    def _gap(self) -> float:
        """Seconds between the task before the next one and the next one."""
        return float(stream(self._drawing.seed, ARRIVALS, self._index).standard_exponential()) / self._rate
