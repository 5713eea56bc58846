"""Starts and tasks of a fleet, in metres, independent of roadmap, planner and simulator."""

import hashlib
import math

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float, Int16, array


@attrs.frozen(kw_only=True)
class Task:
    """Places that one robot must visit, in order: its errands."""

    goals: Float = array("f8", 3)
    """f8[k,3]: x, y (metres), yaw (radians, NaN = any)."""
    levels: Int16 = array("i2", factory=lambda: [0])
    """i2[k]."""
    name: str = ""
    release: float = 0.0
    """simulated seconds."""
    service: Float = array("f8", default=attrs.Factory(lambda self: np.zeros(len(self.goals)), takes_self=True))
    """f8[k] seconds that the robot rests at each goal before the errand is done."""
    deadline: float = math.inf
    """simulated seconds by which the last errand should be done; inf = none."""
    priority: int = 0
    """More is more urgent; assigners may regard it."""
    index: int = 0
    """Place in the stream of a task source, from 0; without one, its place in the scenario counts instead."""


@attrs.frozen(kw_only=True)
class Scenario:
    """Starts and tasks. The assigner `identity` assigns task i to robot i."""

    start: Float = array("f8", 3)
    """f8[n,3]: x, y (metres), yaw (radians, NaN = any)."""
    start_level: Int16 = array("i2")
    tasks: tuple[Task, ...]
    start_names: tuple[str, ...] = ()
    stream: str = ""
    """Says from which stream further tasks come; empty = there are none."""

    @property
    def id(self) -> str:
        """Hash of starts, tasks and stream: runs with the same id are paired."""
        digest = hashlib.sha256()
        for values in (self.start, self.start_level):
            digest.update(values.tobytes())
        for task in self.tasks:
            digest.update(f"|{task.release!r}|".encode() + task.goals.tobytes() + task.levels.tobytes())
            if task.service.any() or task.deadline < math.inf or task.priority:
                digest.update(f"|{task.deadline!r}|{task.priority}|".encode() + task.service.tobytes())
        digest.update(self.stream.encode())
        return digest.hexdigest()[:16]
