"""Scenarios as YAML files.

```yaml
mrpbench_scenario: 1          # version of the format
robots:                       # start of each robot in metres; yaw in radians, absent = any
  - {name: "puffin", x: 1.5, y: 2.0, yaw: 0.0}
tasks:                        # the assigner `identity` assigns task i to robot i
  - {name: "dugong", goals: [{x: 3.0, y: 4.5}]}
```
`level` (index into the world's levels) is absent when 0, `release` (simulated seconds) when 0, names when empty.
Numbers have enough digits to restore the same double, so that `Scenario.id` does not change.
"""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.files.yaml import Document, Steps, load
from mrpbench_core.model.planning.scenario import Scenario, Task

VERSION = 1
_LEVELS = np.iinfo(np.int16)


def write_scenario(path: Path, scenario: Scenario) -> None:
    """Write a scenario; `read_scenario` returns an equal one."""
    names = scenario.start_names or ("",) * len(scenario.start)
    lines = [f"mrpbench_scenario: {VERSION}", "robots:" if len(scenario.start) else "robots: []"]
    for name, pose, level in zip(names, scenario.start, scenario.start_level, strict=True):
        lines.append(f"  - {{{_name(name)}{_place(pose, level)}}}")
    lines.append("tasks:" if scenario.tasks else "tasks: []")
    for task in scenario.tasks:
        goals = ", ".join(f"{{{_place(pose, level)}}}" for pose, level in zip(task.goals, task.levels, strict=True))
        release = f"release: {float(task.release)!r}, " if task.release else ""
        lines.append(f"  - {{{_name(task.name)}{release}goals: [{goals}]}}")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _name(name: str) -> str:
    return f"name: {yaml.safe_dump(name, default_style=chr(34), width=math.inf).strip()}, " if name else ""


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
    reader = _ScenarioReader(load(path))
    top = reader.mapping((), {"mrpbench_scenario", "robots", "tasks"}, {"mrpbench_scenario", "robots", "tasks"})
    if top["mrpbench_scenario"] != VERSION:
        raise reader.document.error(
            f"format version {top['mrpbench_scenario']!r} is unknown", ("mrpbench_scenario",), hint=f"use {VERSION}"
        )
    robots = [reader.robot(("robots", index)) for index in range(reader.length(("robots",)))]
    names = tuple(name for name, _, _ in robots)
    return Scenario(
        start=np.array([pose for _, pose, _ in robots]).reshape(-1, 3),
        start_level=np.array([level for _, _, level in robots], np.int16),
        start_names=names if any(names) else (),
        tasks=tuple(reader.task(("tasks", index)) for index in range(reader.length(("tasks",)))),
    )


class _ScenarioReader:
    """Reads the parts of a document; its errors have a location."""

    def __init__(self, document: Document) -> None:
        self.document = document

    def at(self, steps: Steps) -> Any:
        value = self.document.data
        for step in steps:
            value = value[step]
        return value

    def robot(self, steps: Steps) -> tuple[str, tuple[float, float, float], int]:
        mapping = self.mapping(steps, {"name", "x", "y", "yaw", "level"}, {"x", "y"})
        return self.text(mapping, steps), *self.place(steps)

    def task(self, steps: Steps) -> Task:
        mapping = self.mapping(steps, {"name", "release", "goals"}, {"goals"})
        goals = (*steps, "goals")
        places = []
        for index in range(self.length(goals)):
            self.mapping((*goals, index), {"x", "y", "yaw", "level"}, {"x", "y"})
            places.append(self.place((*goals, index)))
        if not places:
            raise self.document.error("a task needs a goal", goals)
        release = self.number((*steps, "release")) if "release" in mapping else 0.0
        if release < 0:
            raise self.document.error("must not be negative", (*steps, "release"))
        return Task(
            goals=np.array([pose for pose, _ in places]),
            levels=np.array([level for _, level in places], np.int16),
            name=self.text(mapping, steps),
            release=release,
        )

    def place(self, steps: Steps) -> tuple[tuple[float, float, float], int]:
        mapping = self.at(steps)
        yaw = self.number((*steps, "yaw")) if "yaw" in mapping else math.nan
        level = mapping.get("level", 0)
        if type(level) is not int or not 0 <= level <= _LEVELS.max:
            raise self.document.error("must be the index of a level, from 0", (*steps, "level"))
        return (self.number((*steps, "x")), self.number((*steps, "y")), yaw), level

    def number(self, steps: Steps) -> float:
        value = self.at(steps)
        try:
            if type(value) in (int, float) and math.isfinite(value):
                return float(value)
        except OverflowError:
            pass
        raise self.document.error("must be a finite number", steps)

    def text(self, mapping: Mapping[str, Any], steps: Steps) -> str:
        name = mapping.get("name", "")
        if not isinstance(name, str):
            raise self.document.error("must be text", (*steps, "name"), hint="put it in quotes")
        return name

    def length(self, steps: Steps) -> int:
        value = self.at(steps)
        if not isinstance(value, list):
            raise self.document.error("must be a list", steps)
        return len(value)

    def mapping(self, steps: Steps, known: set[str], required: set[str]) -> Mapping[str, Any]:
        value = self.at(steps)
        if not isinstance(value, dict):
            raise self.document.error(f"must be a mapping with {', '.join(sorted(required))}", steps)
        for key in value:
            if key not in known:
                hint = did_you_mean(key, known, f"keys are {', '.join(sorted(known))}")
                raise self.document.error(f"unknown key {key!r}", (*steps, key), key=True, hint=hint)
        for key in sorted(required - set(value)):
            raise self.document.error(f"lacks {key!r}", steps)
        return value
