"""Tasks from files."""

from pathlib import Path

import attrs

from mrpbench_core.api.component import option
from mrpbench_core.api.task_source import TaskSource, TaskStream
from mrpbench_core.builtin.scenarios.names import Names
from mrpbench_core.builtin.task_sources.listed import ListedStream
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.tasks import Place, read_tasks
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class FromFile(TaskSource):
    """The tasks of a scenario file (YAML), or of a file with `tasks` alone (YAML, JSON) or a table (CSV). Their goals
    may also be names of places. All seeds have the same tasks.
    """

    file: Path = option(help="the file; a table if its name ends with .csv")

    def start(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> TaskStream:  # noqa: ARG002
        """Begin the stream, which is the same for every seed."""
        names = Names(world)

        def find(name: str) -> Place:
            vertex = world.vertices[names.find(name)]
            return (vertex.x, vertex.y, float("nan")), vertex.level

        filed = sorted(read_tasks(self.file, find), key=lambda entry: entry.task.release)
        if not filed:
            raise InputError("has no tasks", file=self.file)
        for entry in filed:
            off = roadmap.locate(entry.task.goals[:, :2], entry.task.levels) < 0
            if off.any():
                x, y = entry.task.goals[off.argmax(), :2]
                errand = entry.task.errand[off.argmax()] + 1
                raise entry.error(f"errand {errand} at ({x:g}, {y:g}) is off the roadmap")
        return ListedStream([attrs.evolve(entry.task, index=index) for index, entry in enumerate(filed)])
