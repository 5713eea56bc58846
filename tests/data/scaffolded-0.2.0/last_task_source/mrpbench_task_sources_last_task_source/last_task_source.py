"""LastTaskSource: tasks at regular times."""

from collections.abc import Sequence

import attrs
import numpy as np
from mrpbench_core.api import TaskSource, TaskStream, option
from mrpbench_core.checking.reachability import round_trips
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class LastTaskSource(TaskSource):
    """Releases one task after another, each at a random vertex of the roadmap."""

    interval: float = option(30.0, help="time between two tasks", unit="s", validator=attrs.validators.gt(0))

    def start(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> TaskStream:  # noqa: ARG002
        """Begin the stream of a seed."""
        label = round_trips(roadmap, 0)
        drivable = np.flatnonzero(label == np.bincount(label).argmax())
        return Stream(roadmap, drivable, self.interval, seed)


class Stream(TaskStream):
    """Draws task i from a random stream with the key (seed, i), so that it depends on nothing else."""

    def __init__(self, roadmap: Roadmap, vertices: np.ndarray, interval: float, seed: int) -> None:
        """Draw from `vertices`, every `interval` seconds."""
        self._roadmap, self._vertices, self._interval, self._seed = roadmap, vertices, interval, seed
        self._given = 0

    def released(self, now: float, finished: int) -> Sequence[Task]:  # noqa: ARG002
        """Return the tasks that are due."""
        tasks = []
        while self._given * self._interval <= now:
            random = np.random.default_rng([self._seed, self._given])
            vertex = self._vertices[random.integers(len(self._vertices))]
            goal = np.array([[*self._roadmap.position[vertex], np.nan]])
            level, release = self._roadmap.level[[vertex]], self._given * self._interval
            tasks.append(Task(goals=goal, levels=level, release=release, index=self._given))
            self._given += 1
        return tasks
