"""Whether the tasks of a recording are those that their source releases: the source is asked again."""

from collections import defaultdict
from typing import Any

import numpy as np

from mrpbench_core.api.task_source import TaskSource
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.referee.asked import Asked

ENDS = frozenset({"done", "given_up", "refused"})
"""Events after which a task counts as finished."""
PERIODS = 2
"""Periods within which an execution takes a task in, unless it waits for a plan."""


def release_fault(run: FinishedRun, source: TaskSource, asked: Asked) -> str | None:
    """Return which task is not as its source releases it, as a sentence, or None.

    Args:
        run: with tasks that come over time, in an execution that asks their source in each period.
        source: of this project, so that it is not part of what is judged.
        asked: of the run, with the seed of its tasks.
    """
    if asked.task_seed is None or not run.has("task_time"):
        return None
    context, time = run.context, run.channel("time")
    stream = source.start(context.world, context.problem.roadmap, context.fleet, asked.task_seed)
    late = asked.latency + PERIODS * float(np.diff(time).max(initial=asked.period))
    recorded, released, ends = _recorded(run), list[str](), list[float]()
    last = 0.0
    columns = (run.channel(f"task_{name}").tolist() for name in ("time", "index", "event"))
    for now, index, event in [*zip(*columns, strict=True), (float(time[-1]), -1, "end")]:
        if now - late > last and stream.released(last := now - late, int(np.searchsorted(ends, last))):
            return f"task {len(released)} was to be released before {last:g} s"
        if event == "released" and index >= len(released):
            released += map(_facts, stream.released(last := now, len(ends)))
        if event == "released" and recorded.get(index) != (released[index] if index < len(released) else None):
            return f"task {index}, released at {now:g} s, is not as its source releases it"
        if event in ENDS:
            ends.append(now)
    return None


def _facts(task: Task) -> str:
    rows = (task.errand, task.goals, task.levels, task.service[task.errand])
    once = (task.release, task.deadline, task.priority)
    return repr([(*(row.tolist() for row in place), *once) for place in zip(*rows, strict=True)])


def _recorded(run: FinishedRun) -> dict[int, str]:
    """What is recorded of each task, as `_facts` gives it."""
    names = ("task", "number", "goal", "level", "service", "time", "deadline", "priority")
    places = defaultdict[int, list[Any]](list)
    for index, *place in zip(*(run.channel(f"errand_{name}").tolist() for name in names), strict=True):
        places[index].append(tuple(place))
    return {index: repr(rows) for index, rows in places.items()}
