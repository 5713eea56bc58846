"""The suites catch faults of worlds, roadmaps and scenarios: each plugin here has one and fails its check."""

import attrs
import numpy as np
from mrpbench_tests.variant import variant
from mrpbench_worlds_standard.shipped import Office

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.builtin.scenarios.random import Random
from mrpbench_core.testing import failed_checks, suite_for


def wrapped(base, method, change):
    """A component whose `method` returns the result of `change`."""
    return variant(base, **{method: lambda self, *arguments: change(getattr(base, method)(self, *arguments))})


def test_a_world_with_a_lane_to_nowhere():
    def cut(world):
        return attrs.evolve(world, vertices=world.vertices[:-1])

    assert set(failed_checks(suite_for(wrapped(Office, "load", cut)()))) == {"lanes join vertices that exist"}


def test_a_roadmap_through_walls():
    def through(roadmap):
        far = [[0, len(roadmap.position) - 1]]
        return attrs.evolve(
            roadmap,
            edges=np.concatenate([roadmap.edges, far]),
            duration=np.concatenate([roadmap.duration, [[1]]], axis=1),
        )

    assert set(failed_checks(suite_for(wrapped(Graph, "build", through)()))) == {"robots keep clear of walls"}


def test_a_roadmap_with_instant_edges():
    found = failed_checks(
        suite_for(wrapped(Graph, "build", lambda made: attrs.evolve(made, duration=0 * made.duration))())
    )
    assert "arrays fit together" in found


def test_a_scenario_that_is_drawn_anew():
    def draw(self, world, roadmap, fleet, seed):
        return Random.draw(self, world, roadmap, fleet, int(np.random.default_rng().integers(1 << 30)))

    assert "the same seed draws the same scenario" in failed_checks(suite_for(variant(Random, draw=draw)(robots=4)))
