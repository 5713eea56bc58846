"""Channels of a recording from the output of a discrete execution."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.runs.recording import TASK_EVENTS, Chunk
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_league.files.motion import CLOCKWISE, COUNTER_CLOCKWISE, FORWARD
from mrpbench_league.files.output import LorrOutput

ORDER = {kind: order for order, kind in enumerate(("begun", "errand", "done", "released", "withdrawn", "assigned"))}
"""Of events at the same time."""
assert ORDER.keys() <= set(TASK_EVENTS)


def channels_of(output: LorrOutput, tasks: Sequence[Task], raster: Occupancy, seconds: float, rate: float) -> Chunk:
    """Return the channels of an execution.

    Args:
        output: of season 2024 or 2026.
        tasks: those of the stream, by index.
        raster: of the world.
        seconds: simulated time of a step or tick.
        rate: samples per simulated second.
    """
    return {**_motion(output, raster, seconds, rate), **_tasks(output, tasks, seconds), **_events(output, seconds)}


def _motion(output: LorrOutput, raster: Occupancy, seconds: float, rate: float) -> Chunk:
    """Poses at the start and at the sampled ends of steps."""
    counter = output.counter if output.season == 2026 else 1
    letters = np.stack([motion.letters for motion in output.motion], axis=1)
    letters = np.concatenate([np.full((1, letters.shape[1]), ord("W"), np.uint8), letters])
    turned = np.cumsum((letters == CLOCKWISE).astype(np.int64) - (letters == COUNTER_CLOCKWISE), axis=0)
    heading = (output.start[:, 2] + turned // counter) % 4
    ahead = (letters == FORWARD).astype(np.int64)
    east = np.cumsum(ahead * np.array([1, 0, -1, 0])[heading], axis=0)
    south = np.cumsum(ahead * np.array([0, 1, 0, -1])[heading], axis=0)
    every = max(1, round(1 / (rate * seconds)))
    ticks = np.unique([*range(0, output.makespan + 1, every), output.makespan])
    cell = raster.resolution
    x = raster.origin[0] + cell * (output.start[:, 1] + 0.5 + east[ticks] / counter)
    y = raster.origin[1] + cell * (raster.shape[0] - output.start[:, 0] - 0.5 - south[ticks] / counter)
    yaw = -math.pi / 2 * (output.start[:, 2] + turned[ticks] / counter)
    turning = (letters == COUNTER_CLOCKWISE).astype(float) - (letters == CLOCKWISE)
    twist = np.stack([cell * ahead[ticks], math.pi / 2 * turning[ticks]], axis=2) / (counter * seconds)
    return {
        "time": ticks * seconds,
        "truth": np.stack([x, y, (yaw + math.pi) % (2 * math.pi) - math.pi], axis=2),
        "truth_twist": twist,
        "level": np.zeros(x.shape, np.int16),
    }


def _tasks(output: LorrOutput, tasks: Sequence[Task], seconds: float) -> Chunk:
    """One row per errand of each task that was revealed."""
    revealed = [(tasks[index], time * seconds) for index, time, _ in output.tasks or ()]
    count = [len(task.goals) for task, _ in revealed]

    def each(values: Sequence[Any], kind: str) -> NDArray[Any]:
        return np.repeat(np.array(values, kind), count)

    return {
        "errand_time": each([time for _, time in revealed], "f8"),
        "errand_task": each([task.index for task, _ in revealed], "i4"),
        "errand_number": np.concatenate([task.errand for task, _ in revealed]),
        "errand_goal": np.concatenate([task.goals for task, _ in revealed]),
        "errand_level": np.concatenate([task.levels for task, _ in revealed]).astype(np.int16),
        "errand_service": np.concatenate([task.service for task, _ in revealed]),
        "errand_deadline": each([time + task.deadline - task.release for task, time in revealed], "f8"),
        "errand_priority": each([task.priority for task, _ in revealed], "i4"),
    }


def _events(output: LorrOutput, seconds: float) -> Chunk:
    """What happens to tasks, by time."""
    rows = [(time, ORDER["released"], index, "released", -1, -1) for index, time, _ in output.tasks or ()]
    errands = {index: len(places) // 2 for index, _, places in output.tasks or ()}
    done_at: dict[int, int] = {}
    for time, robot, task, done in output.events or ():
        if done == 1:
            rows.append((time, ORDER["begun"], task, "begun", robot, -1))
        rows.append((time, ORDER["errand"], task, "errand", robot, done - 1))
        if done == errands[task]:
            rows.append((time, ORDER["done"], task, "done", robot, -1))
            done_at[task] = time
    for robot, entries in enumerate(output.schedule or ()):
        before = -1
        for time, task in entries:
            if before >= 0 and done_at.get(before, math.inf) > time:
                rows.append((time, ORDER["withdrawn"], before, "withdrawn", robot, -1))
            if task >= 0:
                rows.append((time, ORDER["assigned"], task, "assigned", robot, -1))
            before = task
    # An assignment of 2024 holds for the errands of its step, one of 2026 for those after its tick.
    first = ("withdrawn", "assigned") if output.season == 2024 else ()
    rows.sort(key=lambda row: (row[0], row[3] not in first, *row[1:3]))
    return {
        "task_time": np.array([row[0] for row in rows]) * seconds,
        "task_index": np.array([row[2] for row in rows], np.int32),
        "task_event": np.array([row[3] for row in rows]),
        "task_robot": np.array([row[4] for row in rows], np.int32),
        "task_errand": np.array([row[5] for row in rows], np.int32),
    }
