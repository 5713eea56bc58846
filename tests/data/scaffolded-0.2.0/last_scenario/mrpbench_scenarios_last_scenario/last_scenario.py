"""LastScenario: robots that exchange their places."""

import attrs
import numpy as np
from mrpbench_core.api import ScenarioSource, option
from mrpbench_core.checking.reachability import round_trips
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class LastScenario(ScenarioSource):
    """Draws one vertex of the roadmap for each robot; the goal of a robot is the start of the next one."""

    robots: int = option(help="number of robots", validator=attrs.validators.ge(1))

    def size(self) -> int:
        """Return the option `robots`."""
        return self.robots

    def draw(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> Scenario:
        """Return the scenario of a seed.

        Raises:
            InputError: the roadmap has too few vertices that are connected.
        """
        label = round_trips(roadmap, 0)
        drivable = np.flatnonzero(label == np.bincount(label).argmax())
        room = 2 * float(fleet.radii.max())
        taken: list[int] = []
        for vertex in np.random.default_rng(seed % 2**64).permutation(drivable).tolist():
            gaps = np.hypot(*(roadmap.position[taken] - roadmap.position[vertex]).T)
            if len(taken) < self.robots and (gaps >= room).all():
                taken.append(vertex)
        if len(taken) < self.robots:
            raise InputError(f"{self.robots} robots do not fit on the roadmap of {world.name}: {len(taken)} do")
        pose = np.column_stack([roadmap.position[taken], np.full(len(taken), np.nan)])
        level = roadmap.level[taken]
        ends = np.roll(np.arange(len(taken)), -1)
        tasks = tuple(Task(goals=pose[[end]], levels=level[[end]]) for end in ends)
        return Scenario(start=pose, start_level=level, tasks=tasks)
