"""When robots have tasks, from the events of tasks that keep coming."""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.runs.run import FinishedRun

_CHANGE = {"assigned": 1, "withdrawn": -1, "done": -1}


def occupied_periods(run: FinishedRun) -> Float:
    """Robot, begin and end f8[k,3] of each period in which a robot has at least one task; the last sample ends all."""
    end = float(run.channel("time")[-1])
    tasks = np.zeros(len(run.context.fleet), np.int64)
    since = np.zeros(len(tasks))
    periods: list[tuple[float, float, float]] = []
    for time, event, robot in zip(
        *(run.channel(f"task_{name}").tolist() for name in ("time", "event", "robot")), strict=True
    ):
        step = _CHANGE.get(event, 0)
        if step == 1 and not tasks[robot]:
            since[robot] = time
        if step == -1 and tasks[robot] == 1:
            periods.append((robot, since[robot], time))
        tasks[robot] += step
    periods += [(robot, since[robot], end) for robot in np.flatnonzero(tasks).tolist()]
    return np.array(periods, float).reshape(-1, 3)


def occupied(run: FinishedRun) -> Bool:
    """bool[T,n]: whether a robot has a task just before a sample."""
    time = run.channel("time")
    occupied = np.zeros((len(time), len(run.context.fleet)), bool)
    for robot, since, until in occupied_periods(run):
        occupied[(time > since) & (time <= until), int(robot)] = True
    return occupied
