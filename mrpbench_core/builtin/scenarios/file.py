"""Scenarios from files."""

from pathlib import Path

import attrs

from mrpbench_core.api.component import option
from mrpbench_core.api.scenario import ScenarioSource
from mrpbench_core.files.scenario import read_scenario
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class FromFile(ScenarioSource):
    """A scenario file in the format that `mrpbench scenario CONFIG --write FILE` writes."""

    file: Path = option(help="the scenario file")

    def size(self) -> int:
        """Return the number of robots in the file."""
        return len(read_scenario(self.file).start)

    def draw(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> Scenario:  # noqa: ARG002
        """Return the scenario, which is the same for every seed."""
        return read_scenario(self.file)
