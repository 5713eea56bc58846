"""Checks that every task source must pass, on the built-in office."""

import numpy as np

from mrpbench_core.api.task_source import TaskSource, TaskStream
from mrpbench_core.checking.tasks import task_fault
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.worlds.world import World
from mrpbench_core.testing.faults import Skip, require
from mrpbench_core.testing.fixtures.office import office, office_roadmap
from mrpbench_core.testing.fixtures.room import fleet
from mrpbench_core.testing.suites.component import ComponentConformance

HOUR = 3600.0


class TaskSourceConformance(ComponentConformance):
    """Checks of task sources: `class TestMine(TaskSourceConformance)`. Override `world` and `roadmap` for one map."""

    def make(self) -> TaskSource:
        """Return the task source to check."""
        raise NotImplementedError("define make(self) and return the task source to check")

    def world(self) -> World:
        """The world in which tasks are done."""
        return office()

    def roadmap(self) -> Roadmap:
        """A roadmap on it."""
        return office_roadmap()

    def stream(self, seed: int) -> TaskStream:
        """The stream of a seed, for five robots."""
        try:
            return self.make().start(self.world(), self.roadmap(), fleet(5), seed)
        except InputError as error:
            raise Skip(f"it has no tasks for the world {self.world().name!r}: {error}") from None

    def tasks(self, seed: int, step: float, share: float = 1.0) -> list[Task]:
        """The tasks of an hour, asked for every `step` seconds; of those released, `share` are finished at once."""
        stream, tasks, now = self.stream(seed), list[Task](), 0.0
        while now <= HOUR:
            released = list(stream.released(now, int(share * len(tasks))))
            late = [task.index for task in released if task.release > now]
            require(not late, f"at {now} s, tasks {late} are given before their release")
            tasks += released
            now += step
        return tasks

    def test_indices_count_the_tasks(self) -> None:
        tasks = self.tasks(0, 10.0)
        require(bool(tasks), "gives no task within an hour")
        require([task.index for task in tasks] == [*range(len(tasks))], "the indices of tasks are not 0, 1, 2, …")
        releases = [task.release for task in tasks]
        require(releases == sorted(releases) and releases[0] >= 0, "tasks are not in the order of their release")

    def test_tasks_are_sound(self) -> None:
        for task in self.tasks(0, 60.0):
            name, fault = f"task {task.index}", task_fault(task)
            require(fault is None, f"{name} {fault}")
            vertex = self.roadmap().locate(task.goals[:, :2], task.levels)
            require(bool((vertex >= 0).all()), f"{name} has an errand off the roadmap")

    def test_the_same_seed_gives_the_same_tasks(self) -> None:
        for seed in (0, 1, 2**31):  # none that a configuration forbids
            require(
                alike(self.tasks(seed, 60.0), self.tasks(seed, 60.0), release=True),
                f"seed {seed} gives other tasks the second time: draw each from its seed and index only",
            )

    def test_tasks_do_not_depend_on_when_they_are_asked_for(self) -> None:
        often, seldom = self.tasks(0, 10.0), self.tasks(0, 300.0)
        require(alike(often, seldom, release=False), "other tasks come when the stream is asked less often")

    def test_tasks_do_not_depend_on_what_is_finished(self) -> None:
        all_done, few_done = self.tasks(0, 60.0), self.tasks(0, 60.0, share=0.25)
        require(alike(all_done, few_done, release=False), "other tasks come when fewer are finished")

    def test_a_stream_that_has_ended_gives_no_task(self) -> None:
        stream, now, count = self.stream(0), 0.0, 0
        while now <= HOUR:
            ended = stream.ended
            tasks = stream.released(now, count)
            require(not (ended and tasks), f"task {count} comes although the stream has ended")
            count += len(tasks)
            now += 60.0


def alike(some: list[Task], others: list[Task], release: bool) -> bool:
    """Tell whether two streams have the same tasks as far as both go; their times count if `release` is set."""
    return all(
        np.array_equal(one.goals, other.goals, equal_nan=True)
        and np.array_equal(one.levels, other.levels)
        and np.array_equal(one.errand, other.errand)
        and np.array_equal(one.service, other.service)
        and one.priority == other.priority
        and (not release or (one.release, one.deadline) == (other.release, other.deadline))
        for one, other in zip(some, others, strict=False)
    )
