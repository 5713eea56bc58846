"""Packs tasks that come over time, and what happens to them, for the page."""

import numpy as np

from mrpbench_core.model.runs.recording import TASK_EVENTS
from mrpbench_core.store.recording import Recording
from mrpbench_replay.packing import Packing


def pack_tasks(recording: Recording, packing: Packing) -> None:
    """Pack errands and events of tasks; nothing without a task source.

    The places of task i are `errand_first[i]` to before `errand_first[i + 1]`, and each is one of errand
    `errand_number` of the task. Events are in the order of time; `task_kind` is an index into `TASK_EVENTS`.
    """
    if not {"errand_task", "task_time"} <= recording.channels.keys():
        return
    task = recording.channel("errand_task")
    order = np.argsort(task, kind="stable")
    count = int(task.max(initial=-1)) + 1
    goal = recording.channel("errand_goal")[order]
    first = np.searchsorted(task[order], np.arange(count + 1))
    packing.add("errand_first", first)
    if "errand_number" in recording.channels:
        packing.add("errand_number", recording.channel("errand_number")[order])
    else:  # of older recordings: each place is an errand
        packing.add("errand_number", np.arange(len(task)) - np.repeat(first[:-1], np.diff(first)))
    packing.add_metres("errand_x", goal[:, 0])
    packing.add_metres("errand_y", goal[:, 1])
    packing.add("errand_level", recording.channel("errand_level")[order])
    time = recording.channel("task_time")
    order = np.argsort(time, kind="stable")
    kind = {name: number for number, name in enumerate(TASK_EVENTS)}
    packing.add_metres("task_time", time[order])
    packing.add("task_kind", [kind[name] for name in recording.channel("task_event")[order].tolist()])
    for name in ("index", "robot", "errand"):
        packing.add(f"task_{name}", recording.channel(f"task_{name}")[order])
