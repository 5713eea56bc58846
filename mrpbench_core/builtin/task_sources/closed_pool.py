"""A closed pool: always the same number of unfinished tasks."""

import math
from collections.abc import Sequence

import attrs

from mrpbench_core.api.component import between, option
from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.builtin.task_sources.drawn import AnyPlace, Drawing
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class ClosedPool(AnyPlace):
    """A finished task is replaced at once: floor(`per_robot` · robots) are always unfinished. Errands are drawn at
    random places of the world.
    """

    per_robot: float = option(1.5, help="unfinished tasks per robot", validator=between(1e-3, 1000))
    total: int | None = option(
        None,
        help="tasks in all; none: they never end",
        validator=attrs.validators.optional(attrs.validators.ge(1)),
    )

    def start(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> TaskStream:
        """Begin the stream of `seed`."""
        size = max(1, math.floor(self.per_robot * len(fleet) + 1e-9))
        return ClosedPoolStream(Drawing(self, self.places(world, roadmap), seed), size, self.total)


class ClosedPoolStream(TaskStream):
    """Keeps `size` tasks unfinished, as long as there are any of the `total`."""

    def __init__(self, drawing: Drawing, size: int, total: int | None) -> None:
        self._drawing, self._size = drawing, size
        self._total = math.inf if total is None else total
        self._index = 0

    def released(self, now: float, finished: int) -> Sequence[Task]:
        """Return a task for each one that is finished; at first, the whole pool."""
        tasks = []
        while self._index < min(finished + self._size, self._total):
            tasks.append(self._drawing.task(self._index, now))
            self._index += 1
        return tasks

    @property
    def places(self) -> tuple[Float, Int16]:
        """Where errands are drawn."""
        return self._drawing.places

    @property
    def ended(self) -> bool:
        """True if all tasks are released."""
        return self._index >= self._total
