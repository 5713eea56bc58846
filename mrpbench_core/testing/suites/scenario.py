"""Checks that every source of scenarios must pass, on the built-in office."""

import numpy as np

from mrpbench_core.api.scenario import ScenarioSource
from mrpbench_core.checking.tasks import task_fault
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.worlds.world import World
from mrpbench_core.testing.faults import Skip, require
from mrpbench_core.testing.fixtures.office import office, office_roadmap
from mrpbench_core.testing.fixtures.room import fleet
from mrpbench_core.testing.suites.component import ComponentConformance


class ScenarioConformance(ComponentConformance):
    """Checks of scenarios: `class TestMine(ScenarioConformance)`. Override `world` and `roadmap` for one map."""

    def make(self) -> ScenarioSource:
        """Return the source of scenarios to check."""
        raise NotImplementedError("define make(self) and return the source of scenarios to check")

    def world(self) -> World:
        """The world to draw in."""
        return office()

    def roadmap(self) -> Roadmap:
        """A roadmap on it."""
        return office_roadmap()

    def draw(self, seed: int) -> Scenario:
        """The scenario of a seed."""
        source = self.make()
        try:
            return source.draw(self.world(), self.roadmap(), fleet(source.size()), seed)
        except InputError as error:
            raise Skip(f"it has no scenario for the world {self.world().name!r}: {error}") from None

    def test_knows_its_number_of_robots(self) -> None:
        size = self.make().size()
        require(type(size) is int and size >= 1, f"size() returns {size!r}")

    def test_draws_starts_and_tasks(self) -> None:
        robots, drawn = self.make().size(), self.draw(0)
        require(isinstance(drawn, Scenario), f"returns {type(drawn).__name__} instead of Scenario")
        require(drawn.start.shape == (robots, 3), f"starts of {robots} robots have shape {drawn.start.shape}")
        require(drawn.start_level.shape == (robots,), f"start_level has shape {drawn.start_level.shape}")
        require(drawn.tasks, "draws no tasks")
        require(np.isfinite(drawn.start[:, :2]).all(), "a start has a position that is not finite")
        for index, task in enumerate(drawn.tasks):
            fault = task_fault(task)
            require(fault is None, f"task {index} {fault}")

    def test_starts_lie_on_the_roadmap(self) -> None:
        drawn = self.draw(0)
        vertex = self.roadmap().locate(drawn.start[:, :2], drawn.start_level)
        lost = np.flatnonzero(vertex < 0).tolist()
        require(not lost, f"robots {lost} start off the roadmap")
        require(len(set(vertex.tolist())) == len(vertex), "two robots start at one vertex")

    def test_the_same_seed_draws_the_same_scenario(self) -> None:
        for seed in (0, 1, 12345, 2**31):  # none that a configuration forbids
            require(
                self.draw(seed).id == self.draw(seed).id,
                f"seed {seed} draws another scenario the second time: draw from `numpy.random.default_rng(seed)` only",
            )
