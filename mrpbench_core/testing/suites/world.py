"""Checks that every source of worlds must pass."""

import numpy as np

from mrpbench_core.api.world import WorldSource
from mrpbench_core.model.worlds.world import World
from mrpbench_core.testing.faults import require
from mrpbench_core.testing.suites.component import ComponentConformance


class WorldConformance(ComponentConformance):
    """Checks of worlds: `class TestMine(WorldConformance)`."""

    def make(self) -> WorldSource:
        """Return the source of worlds to check."""
        raise NotImplementedError("define make(self) and return the source of worlds to check")

    def test_loads_a_world(self) -> None:
        world = self.make().load()
        require(isinstance(world, World), f"returns {type(world).__name__} instead of World")
        require(world.name, "the world has no name")
        require(world.levels, "the world has no levels")

    def test_loads_the_same_world_again(self) -> None:
        source = self.make()
        require(source.load() == source.load(), "loads another world the second time: draw from an option `seed` only")

    def test_everything_is_in_metres_on_a_level_that_exists(self) -> None:
        world = self.make().load()
        for level in world.levels:
            shapes = [level.walls, *(obstacle.polygon for obstacle in level.obstacles)]
            require(
                all(np.isfinite(shape).all() for shape in shapes),
                f"level {level.name} has walls or obstacles with coordinates that are not finite",
            )
            require(level.wall_thickness > 0, f"level {level.name} has walls without thickness")
        for vertex in world.vertices:
            require(
                np.isfinite([vertex.x, vertex.y]).all(), f"vertex {vertex.name!r} has a position that is not finite"
            )
            require(0 <= vertex.level < len(world.levels), f"vertex {vertex.name!r} is on level {vertex.level}")

    def test_lanes_join_vertices_that_exist(self) -> None:
        world = self.make().load()
        for lane in world.lanes:
            ends = {lane.start, lane.end}
            require(
                ends <= set(range(len(world.vertices))),
                f"a lane from {lane.start} to {lane.end}: there are no such vertices",
            )
            require(len(ends) == 2, f"a lane from vertex {lane.start} to itself")
