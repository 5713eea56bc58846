"""Tasks of problems of the League of Robot Runners."""

from pathlib import Path

import attrs
import numpy as np

from mrpbench_core.api.component import option
from mrpbench_core.api.task_source import TaskSource, TaskStream
from mrpbench_core.builtin.scenarios.lorr import centres_of
from mrpbench_core.builtin.task_sources.closed_pool import ClosedPoolStream
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.lorr.problem import LorrProblem, problem_reads, read_problem
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.worlds.world import World


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
            hint = "use `mrpbench-league`"
            raise InputError("is of 2023, which gives goals to robots itself", file=self.file, hint=hint)
        lines = Lines(problem, centres_of(self.file, problem, world, problem.errands))
        return ClosedPoolStream(lines, max(1, int(problem.reveal * len(fleet))), None)


@attrs.frozen
class Lines:
    """The lines of a file of tasks."""

    problem: LorrProblem
    goals: Float
    """f8[k,3] of all errands."""

    @property
    def places(self) -> tuple[Float, Int16]:
        """Positions f8[k,2] and levels i2[k] of all errands."""
        return self.goals[:, :2], np.zeros(len(self.goals), np.int16)

    def task(self, index: int, release: float) -> Task:
        """Return task `index`, released at `release` seconds."""
        first = self.problem.first
        line = index % (len(first) - 1)
        goals = self.goals[first[line] : first[line + 1]]
        return Task(goals=goals, levels=np.zeros(len(goals), np.int16), release=release, index=index)
