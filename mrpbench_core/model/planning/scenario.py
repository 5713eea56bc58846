"""Starts and goals of a fleet, in metres, independent of roadmap, planner and simulator."""

import hashlib

import attrs

from mrpbench_core.model.common.arrays import Float, Int16, array


@attrs.frozen(kw_only=True)
class Task:
    """Places that one robot must visit, in order."""

    goals: Float = array("f8", 3)
    """f8[k,3]: x, y (metres), yaw (radians, NaN = any)."""
    levels: Int16 = array("i2", factory=lambda: [0])
    """i2[k]."""
    name: str = ""
    release: float = 0.0
    """simulated seconds."""


@attrs.frozen(kw_only=True)
class Scenario:
    """Starts and tasks. The assigner `identity` assigns task i to robot i."""

    start: Float = array("f8", 3)
    """f8[n,3]: x, y (metres), yaw (radians, NaN = any)."""
    start_level: Int16 = array("i2")
    tasks: tuple[Task, ...]
    start_names: tuple[str, ...] = ()

    @property
    def id(self) -> str:
        """Hash of starts and goals in metres: runs with the same id are paired."""
        digest = hashlib.sha256()
        for values in (self.start, self.start_level):
            digest.update(values.tobytes())
        for task in self.tasks:
            digest.update(f"|{task.release!r}|".encode() + task.goals.tobytes() + task.levels.tobytes())
        return digest.hexdigest()[:16]
