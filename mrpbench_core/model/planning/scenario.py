"""Starts and tasks of a fleet, in metres, independent of roadmap, planner and simulator."""

import hashlib
import math
from collections.abc import Sequence
from typing import TypeVar

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float, Int16, Int32, array

Value = TypeVar("Value")
MOST_ROBOTS = 1_000_000
"""Robots that a scenario may have."""


@attrs.frozen(kw_only=True)
class Task:
    """Errands of one robot, in order: each is done at any one of its places."""

    goals: Float = array("f8", 3)
    """f8[p,3] places: x, y (metres), yaw (radians, NaN = any)."""
    errand: Int32 = array("i4", default=attrs.Factory(lambda self: np.arange(len(self.goals)), takes_self=True))
    """i4[p] errand of each place, from 0 in order; by default each place is an errand."""
    levels: Int16 = array("i2", factory=lambda: [0])
    """i2[p]."""
    name: str = ""
    release: float = 0.0
    """simulated seconds."""
    service: Float = array(
        "f8", default=attrs.Factory(lambda self: np.zeros(len(np.unique(self.errand))), takes_self=True)
    )
    """f8[k] seconds that the robot rests at a place of each errand before it is done."""
    deadline: float = math.inf
    """simulated seconds by which the last errand should be done; inf = none."""
    priority: int = 0
    """More is more urgent; assigners may regard it."""
    index: int = 0
    """Place in the stream of a task source, from 0; without one, its place in the scenario counts instead."""

    @property
    def errands(self) -> int:
        """The number k of errands."""
        return int(self.errand[-1]) + 1 if len(self.errand) else 0

    def by_errand(self, values: Sequence[Value]) -> tuple[tuple[Value, ...], ...]:
        """Return what is given for each place as one tuple for each errand."""
        grouped: list[tuple[Value, ...]] = [()] * self.errands
        for errand, value in zip(self.errand.tolist(), values, strict=True):
            grouped[errand] += (value,)
        return tuple(grouped)


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
            if task.errands < len(task.goals):
                digest.update(f"|{task.errand.tolist()}|".encode())
            if task.service.any() or task.deadline < math.inf or task.priority:
                digest.update(f"|{task.deadline!r}|{task.priority}|".encode() + task.service.tobytes())
        digest.update(self.stream.encode())
        return digest.hexdigest()[:16]
