"""Scenarios as YAML files.

```yaml
mrpbench_scenario: 1          # version of the format
robots:                       # start of each robot in metres; yaw in radians, absent = any
  - {name: "puffin", x: 1.5, y: 2.0, yaw: 0.0}
tasks:                        # the assigner `identity` assigns task i to robot i
  - {name: "dugong", goals: [{x: 3.0, y: 4.5}]}
  - {goals: [{x: 1.0, y: 1.5}, [{x: 0.5, y: 4.5}, {x: 2.5, y: 4.5}]]}  # the second errand is done at either place
```
`level` (index into the world's levels) is absent when 0, and so is what says nothing of `release` (simulated seconds),
`service` (seconds at each goal, one number or a list), `deadline` (simulated seconds), `priority` and names.
Numbers have enough digits to restore the same double, so that `Scenario.id` does not change.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from mrpbench_core.files.tasks import TaskReader
from mrpbench_core.files.yaml import Steps, load
from mrpbench_core.model.planning.scenario import Scenario, Task

VERSION = 1


def write_scenario(path: Path, scenario: Scenario) -> None:
    """Write a scenario; `read_scenario` returns an equal one."""
    names = scenario.start_names or ("",) * len(scenario.start)
    lines = [f"mrpbench_scenario: {VERSION}", "robots:" if len(scenario.start) else "robots: []"]
    for name, pose, level in zip(names, scenario.start, scenario.start_level, strict=True):
        lines.append(f"  - {{{_name(name)}{_place(pose, level)}}}")
    lines.append("tasks:" if scenario.tasks else "tasks: []")
    for task in scenario.tasks:
        places = [f"{{{_place(pose, level)}}}" for pose, level in zip(task.goals, task.levels, strict=True)]
        goals = [one[0] if len(one) == 1 else f"[{', '.join(one)}]" for one in task.by_errand(places)]
        lines.append(f"  - {{{_name(task.name)}{_times(task)}goals: [{', '.join(goals)}]}}")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _name(name: str) -> str:
    return f"name: {yaml.safe_dump(name, default_style=chr(34), width=math.inf).strip()}, " if name else ""


def _times(task: Task) -> str:
    text = f"release: {float(task.release)!r}, " if task.release else ""
    if task.service.any():
        text += f"service: {task.service.tolist()!r}, "
    if task.deadline < math.inf:
        text += f"deadline: {float(task.deadline)!r}, "
    return text + (f"priority: {task.priority}, " if task.priority else "")


def _place(pose: Any, level: Any) -> str:
    x, y, yaw = (repr(float(number)) for number in pose)
    text = f"x: {x}, y: {y}"
    if yaw != "nan":
        text += f", yaw: {yaw}"
    return text + (f", level: {int(level)}" if level else "")


def read_scenario(path: Path) -> Scenario:
    """Read a scenario.

    Raises:
        InputError: it cannot be read or is malformed; the error names file, line and column.
    """
    reader = TaskReader(load(path))
    top = reader.mapping((), {"mrpbench_scenario", "robots", "tasks"}, {"mrpbench_scenario", "robots", "tasks"})
    if top["mrpbench_scenario"] != VERSION:
        raise reader.document.error(
            f"format version {top['mrpbench_scenario']!r} is unknown", ("mrpbench_scenario",), hint=f"use {VERSION}"
        )
    robots = [_robot(reader, ("robots", index)) for index in range(reader.length(("robots",)))]
    names = tuple(name for name, _, _ in robots)
    return Scenario(
        start=np.array([pose for _, pose, _ in robots]).reshape(-1, 3),
        start_level=np.array([level for _, _, level in robots], np.int16),
        start_names=names if any(names) else (),
        tasks=tuple(reader.task(("tasks", index)) for index in range(reader.length(("tasks",)))),
    )


def _robot(reader: TaskReader, steps: Steps) -> tuple[str, tuple[float, float, float], int]:
    mapping = reader.mapping(steps, {"name", "x", "y", "yaw", "level"}, {"x", "y"})
    return reader.text(mapping, steps), *reader.place(steps)
