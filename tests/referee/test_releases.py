"""Tasks that a source did not release, or not then, are named; those that it did release are not."""

from collections.abc import Callable

import attrs
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mrpbench_core.api import Task, TaskSource, TaskStream
from mrpbench_core.engine.execution.recorder import TASKS
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.referee.releases import release_fault

PERIOD, PERIODS, SIZE, TOTAL, EVERY = 0.5, 60, 2, 45, 1.5


def task(index: int, release: float) -> Task:
    places = [[index, 0.0, np.nan], [index, 1.0, 0.5], [0.0, index, np.nan]]
    return Task(
        goals=np.array(places), errand=[0, 0, 1], levels=[0, 0, 0], service=[1.0, 0.0], release=release, index=index
    )


@attrs.frozen(kw_only=True)
class Source(TaskSource):
    """Releases tasks at fixed times, or keeps some of them open."""

    pool: bool = False

    def start(self, world, roadmap, fleet, seed) -> TaskStream:
        return Stream(self.pool)


class Stream(TaskStream):
    def __init__(self, pool):
        self.pool, self.index = pool, 0

    def released(self, now, finished):
        tasks = []
        while self.index < TOTAL and (self.index < finished + SIZE if self.pool else self.index * EVERY <= now):
            tasks.append(task(self.index, now if self.pool else self.index * EVERY))
            self.index += 1
        return tasks


@attrs.frozen
class Asked:
    """The facts of a run that matter here."""

    task_seed: int | None = 0
    latency: float = 0.0
    period: float = PERIOD


def recorded(stream: TaskStream, done: Callable[[int], bool], holds: Callable[[int], bool] = lambda period: False):
    """Tasks and events of an execution in which the oldest task is done in some periods."""
    tasks, events, waiting, finished = [], [], [], 0
    for period in range(PERIODS):
        now = period * PERIOD
        if not holds(period):
            for new in stream.released(now, finished):
                tasks.append(new)
                events.append((now, new.index, "released"))
                waiting.append(new.index)
        if waiting and done(period):
            events.append((now, waiting.pop(0), "done"))
            finished += 1
    return tasks, events


def fault(run_context, tasks, events, source, asked=None):
    rows = {name: [] for name in TASKS}
    for each in tasks:
        count = len(each.goals)
        rows["errand_time"] += [each.release] * count
        rows["errand_task"] += [each.index] * count
        rows["errand_number"] += each.errand.tolist()
        rows["errand_goal"] += each.goals.tolist()
        rows["errand_level"] += each.levels.tolist()
        rows["errand_service"] += each.service[each.errand].tolist()
        rows["errand_deadline"] += [each.deadline] * count
        rows["errand_priority"] += [each.priority] * count
    columns = zip(*events, strict=True) if events else ((), (), ())
    rows["task_time"], rows["task_index"], rows["task_event"] = columns
    channels = {name: np.array(values) for name, values in rows.items()} | {"time": np.arange(PERIODS) * PERIOD}
    loaders = {name: (lambda values=values: values) for name, values in channels.items()}
    return release_fault(FinishedRun(context=run_context, executed=True, channels=loaders), source, asked or Asked())


@settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(pool=st.booleans(), busy=st.sets(st.integers(0, PERIODS)))
def test_the_tasks_of_a_source_have_no_fault(run_context, pool, busy):
    source = Source(pool=pool)
    tasks, events = recorded(Stream(pool), lambda period: period not in busy)
    assert fault(run_context, tasks, events, source) is None


@pytest.mark.parametrize("pool", [True, False])
def test_tasks_that_wait_for_a_plan_have_no_fault(run_context, pool):
    tasks, events = recorded(Stream(pool), lambda period: True, lambda period: period % 5 in (2, 3, 4))
    assert fault(run_context, tasks, events, Source(pool=pool), Asked(latency=1.5)) is None
    assert "was to be released before" in fault(run_context, tasks, events, Source(pool=pool))


@pytest.mark.parametrize(
    "change",
    [
        pytest.param({"goals": [[0.0, 0.0, np.nan], [3.0, 1.0, 0.5], [0.0, 3.0, np.nan]]}, id="another place"),
        pytest.param({"service": [0.5, 0.0]}, id="less service"),
        pytest.param({"release": 4.0}, id="another release"),
        pytest.param({"deadline": 99.0}, id="a deadline"),
        pytest.param({"priority": 1}, id="a priority"),
    ],
)
def test_a_task_that_is_not_that_of_the_source_is_named(run_context, change):
    tasks, events = recorded(Stream(False), lambda period: True)
    tasks[3] = attrs.evolve(tasks[3], **change)
    assert fault(run_context, tasks, events, Source()) == "task 3, released at 4.5 s, is not as its source releases it"


@pytest.mark.parametrize("pool", [True, False])
def test_tasks_that_are_left_out_or_come_late_are_named(run_context, pool):
    done = lambda period: True  # noqa: E731
    tasks, events = recorded(Stream(pool), done, lambda period: 10 <= period < 30)
    assert "was to be released before" in fault(run_context, tasks, events, Source(pool=pool))
    tasks, events = recorded(Stream(pool), done, lambda period: period >= 4)
    assert "was to be released before" in fault(run_context, tasks, events, Source(pool=pool))
    assert "task 0 was to be released" in fault(run_context, [], [], Source(pool=pool))


def test_tasks_that_come_too_early_are_named(run_context):
    tasks, events = recorded(Stream(True), lambda period: False)
    early = [*events, (10.0, 2, "released")]
    assert "task 2, released at 10 s" in fault(run_context, [*tasks, task(2, 10.0)], early, Source(pool=True))


def test_nothing_is_compared_where_the_source_is_of_others(run_context):
    assert fault(run_context, [], [], Source(), Asked(task_seed=None)) is None
