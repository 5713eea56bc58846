"""Tasks of problems of the League of Robot Runners."""

from collections.abc import Sequence
from pathlib import Path

import attrs
import numpy as np

from mrpbench_core.api.component import option
from mrpbench_core.api.task_source import TaskSource, TaskStream
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.worlds.world import World
from mrpbench_league.files.problem import LorrProblem, problem_reads, read_problem
from mrpbench_league.scenario import centres_of


@attrs.frozen(kw_only=True)
class LorrTasks(TaskSource):
    """The tasks of a problem of the League of Robot Runners of 2024 or 2026: a closed pool of `numTasksReveal` tasks
    per robot. After the last task the first one follows. All seeds have the same tasks.
    """

    file: Path = option(help="the problem, a JSON file")

    def reads(self) -> tuple[Path, ...]:
        """Return the files that the problem names."""
        return problem_reads(self.file)

    def start(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> TaskStream:  # noqa: ARG002
        """Begin the stream, which is the same for every seed."""
        problem = read_problem(self.file)
        if problem.season == 2023:
            hint = "use `mrpbench league-run`"
            raise InputError("is of 2023, which gives goals to robots itself", file=self.file, hint=hint)
        goals = centres_of(self.file, problem, world, problem.errands)
        return Pool(problem, goals, max(1, int(problem.reveal * len(fleet))))


class Pool(TaskStream):
    """Keeps `size` tasks unfinished: the lines of a file of tasks, again and again.

    Args:
        problem: the first errand of each line.
        goals: f8[k,3] of all errands.
        size: unfinished tasks.
    """

    def __init__(self, problem: LorrProblem, goals: Float, size: int) -> None:
        self._first, self._goals, self._size = problem.first, goals, size
        self._count = 0

    def released(self, now: float, finished: int) -> Sequence[Task]:
        """Return a task for each one that is finished; at first, the whole pool."""
        tasks = [self._task(index, now) for index in range(self._count, finished + self._size)]
        self._count += len(tasks)
        return tasks

    @property
    def places(self) -> tuple[Float, Int16]:
        """Positions f8[k,2] and levels i2[k] of all errands."""
        return self._goals[:, :2], np.zeros(len(self._goals), np.int16)

    def _task(self, index: int, release: float) -> Task:
        line = index % (len(self._first) - 1)
        goals = self._goals[self._first[line] : self._first[line + 1]]
        return Task(goals=goals, levels=np.zeros(len(goals), np.int16), release=release, index=index)
