"""Cases: what a hunt varies of a run, as a scenario file and as options."""

import hashlib
import json
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from mrpbench_core.files.scenario import write_scenario
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_search.asking.variants import Changes


@attrs.frozen(kw_only=True)
class Case:
    """One point of the space that a hunt searches."""

    scenario: Scenario
    """Starts, and the goals of runs without a task source."""
    seed: int
    stream: tuple[Task, ...] | None = None
    """Tasks over time in the order of their release; None: the study has no task source."""
    events: tuple[dict[str, Any], ...] = ()
    """Entries of `faults.events`."""
    crowds: tuple[dict[str, Any], ...] = ()
    """Blocks of `crowds`."""
    fleet: tuple[dict[str, Any], ...] = ()
    """The entry of each robot; (): all robots are of one entry."""
    repeat: int = 0

    @property
    def robots(self) -> int:
        """The number of robots."""
        return len(self.scenario.start)

    @property
    def tasks(self) -> tuple[Task, ...]:
        """The tasks over time, or those of the scenario."""
        return self.scenario.tasks if self.stream is None else self.stream

    def with_tasks(self, tasks: tuple[Task, ...]) -> "Case":
        """Return the case with other tasks."""
        if self.stream is not None:
            ordered = sorted(tasks, key=lambda task: task.release)
            numbered = (attrs.evolve(task, index=index) for index, task in enumerate(ordered))
            return attrs.evolve(self, stream=tuple(numbered))
        return attrs.evolve(self, scenario=attrs.evolve(self.scenario, tasks=tasks))

    def without_robot(self, robot: int) -> "Case":
        """Return the case without a robot, the goal of the same index, and the faults of the robot."""
        names = self.scenario.start_names
        scenario = attrs.evolve(
            self.scenario,
            start=np.delete(self.scenario.start, robot, axis=0),
            start_level=np.delete(self.scenario.start_level, robot),
            start_names=names[:robot] + names[robot + 1 :],
            tasks=tuple(task for index, task in enumerate(self.scenario.tasks) if index != robot),
        )
        events = (_renumbered(event, robot) for event in self.events if event.get("robot") != robot)
        fleet = self.fleet[:robot] + self.fleet[robot + 1 :]
        return attrs.evolve(self, scenario=scenario, events=tuple(events), fleet=fleet)

    def changes(self, folder: Path) -> Changes:
        """Return the options of its runs, and write its scenario file into a folder.

        Raises:
            OSError: the file cannot be written.
        """
        file = self.write(folder)
        block = {"plugin": "file", "file": str(file)}
        found: dict[str, Any] = {"scenario": block, "seed": self.seed, "repeat": self.repeat}
        if self.stream is not None:
            found["tasks"] = block
        found |= {"faults.events": list(self.events), "crowds": list(self.crowds)}
        if self.fleet:
            found["fleet"] = list(self.fleet)
        return found

    def write(self, folder: Path) -> Path:
        """Write the scenario file, named by its content; return its absolute path."""
        folder.mkdir(parents=True, exist_ok=True)
        scenario = attrs.evolve(self.scenario, tasks=self.tasks)
        file = (folder / f"{scenario.id}.yaml").absolute()
        if not file.is_file():
            write_scenario(file, scenario)
        return file

    @property
    def key(self) -> str:
        """The same text for equal cases."""
        others = [self.seed, self.repeat, self.events, self.crowds, self.fleet]
        scenario = attrs.evolve(self.scenario, tasks=self.tasks, start_names=(), stream="")
        return scenario.id + hashlib.sha256(json.dumps(others, sort_keys=True).encode()).hexdigest()


def _renumbered(event: dict[str, Any], removed: int) -> dict[str, Any]:
    robot = event.get("robot")
    return event if robot is None or robot < removed else event | {"robot": robot - 1}
