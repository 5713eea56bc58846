"""Checks that every builder of roadmaps must pass, on the built-in office."""

import numpy as np

from mrpbench_core.api.roadmap import RoadmapBuilder
from mrpbench_core.checking.clearance import has_clearance
from mrpbench_core.checking.reachability import round_trips
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.world import World
from mrpbench_core.testing.faults import Skip, require
from mrpbench_core.testing.fixtures.office import office
from mrpbench_core.testing.fixtures.room import ROBOT, fleet
from mrpbench_core.testing.suites.component import ComponentConformance


class RoadmapConformance(ComponentConformance):
    """Checks of roadmaps: `class TestMine(RoadmapConformance)`. Override `world` for one that needs a special world."""

    def make(self) -> RoadmapBuilder:
        """Return the builder to check."""
        raise NotImplementedError("define make(self) and return the builder to check")

    def world(self) -> World:
        """The world to build on."""
        return office()

    def build(self) -> Roadmap:
        """The roadmap for two robots of one kind."""
        return self.make().build(self.world(), fleet(2))

    def test_arrays_fit_together(self) -> None:
        roadmap = self.build()
        vertices, edges = len(roadmap.position), len(roadmap.edges)
        require(vertices and edges, f"has {vertices} vertices and {edges} edges: raise InputError if nothing is left")
        require(np.isfinite(roadmap.position).all(), "a vertex has a position that is not finite")
        require(len(roadmap.level) == vertices == len(roadmap.heading), "position, level and heading differ in length")
        require(
            ((roadmap.edges >= 0) & (roadmap.edges < vertices)).all(), "an edge leads to a vertex that does not exist"
        )
        require((roadmap.edges[:, 0] != roadmap.edges[:, 1]).all(), "an edge leads from a vertex to itself")
        shape, wanted = roadmap.duration.shape, (1, edges)
        require(shape == wanted, f"duration has shape {shape} instead of {wanted}: one row for each kind of robot")
        require(((roadmap.duration >= 1) | (roadmap.duration == -1)).all(), "durations are neither positive nor -1")
        require(roadmap.tick > 0, f"a tick lasts {roadmap.tick} s")
        places, named = len(roadmap.place), len(self.world().vertices)
        require(places == named, f"`place` has {places} entries for {named} vertices of the world")
        require(
            ((roadmap.place >= -1) & (roadmap.place < vertices)).all(), "`place` names a vertex that does not exist"
        )

    def test_builds_the_same_roadmap_again(self) -> None:
        require(self.build() == self.build(), "builds another roadmap the second time: use no random numbers, no sets")

    def test_robots_keep_clear_of_walls(self) -> None:
        if not self.make().clears_walls:
            raise Skip("its edges may lead through walls")
        roadmap, level = self.build(), self.world().levels[0]
        usable = roadmap.edges[roadmap.duration[0] >= 0]
        start, end = roadmap.position[usable[:, 0]], roadmap.position[usable[:, 1]]
        hits = np.flatnonzero(~has_clearance(level, start, end, ROBOT.radius))
        where = [tuple(point.round(2).tolist()) for index in hits[:1] for point in (start[index], end[index])]
        require(
            not len(hits), f"{len(hits)} edges pass a wall closer than the radius {ROBOT.radius:.3f} m, e.g. {where}"
        )

    def test_robots_can_go_somewhere_and_back(self) -> None:
        _, sizes = np.unique(round_trips(self.build(), 0), return_counts=True)
        require(
            sizes.max() > 1,
            "no two vertices can be reached from one another: a two-way lane is two edges, and a duration of -1 forbids"
            " an edge to a robot",
        )
