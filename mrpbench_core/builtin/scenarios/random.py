"""Random starts and goals."""

import random
from typing import Literal

import attrs
import numpy as np

from mrpbench_core.api.component import between, option
from mrpbench_core.api.scenario import ScenarioSource
from mrpbench_core.builtin.scenarios.places import (
    Places,
    connected,
    outside_resources,
    places_of_roadmap,
    places_of_world,
)
from mrpbench_core.checking.reachability import round_trips
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float, Int, Int16
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.conflicts import TOLERANCE
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import MOST_ROBOTS, Scenario
from mrpbench_core.model.worlds.world import World

STARTS, GOALS = 0, 1
"""Keys of the two random streams of a seed."""


@attrs.frozen(kw_only=True)
class Random(ScenarioSource):
    """Draws starts and, independently, goals without replacement: from the named places of the world if there are any,
    else from all vertices of the roadmap.

    Drawn places are on the roadmap, on distinct vertices, outside of doors, lifts and mutexes, and far enough apart for
    the robots to stand there; every robot can drive between any two of them. The order of the
    places is that of `Generator(PCG64(SeedSequence([seed modulo 2**64, 0]))).random(places)` for starts (key 1 for
    goals), sorted; so the first of more robots of one kind start and end, on the same seed, where fewer do.
    """

    robots: int = option(help="number of robots", validator=between(1, MOST_ROBOTS))
    compatible: Literal["mrp_bench"] | None = option(
        None,
        help="mrp_bench: the draw of the original, random.sample after random.seed(seed) for starts and seed + 1 for "
        "goals, over all vertices in order of publication; may place two robots on one cell",
    )

    def size(self) -> int:
        """Return the option `robots`."""
        return self.robots

    def draw(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> Scenario:
        """Return the scenario of `seed`."""
        if self.compatible == "mrp_bench":
            return self._original_draw(world, seed)
        places = places_of_world(world, roadmap) if world.vertices else places_of_roadmap(roadmap)
        room = 2 * float(fleet.radii.max())
        if any(robot.graph is not None for robot in fleet.robots):
            return self._draw_on_graphs(places[outside_resources(roadmap, places)], roadmap, fleet, seed)
        places = places[connected(roadmap, places)]
        places = places[outside_resources(roadmap, places)]
        stands = roadmap.position[places.vertex]
        return places.scenario(
            _separate(stands, places.level, _shuffled(len(places), seed, STARTS), room, self.robots, "start"),
            _separate(stands, places.level, _shuffled(len(places), seed, GOALS), room, self.robots, "end"),
        )

    def _draw_on_graphs(self, places: Places, roadmap: Roadmap, fleet: Fleet, seed: int) -> Scenario:
        """Return a scenario in which start and task i are connected by the navigation graph of robot i."""
        stands, room = roadmap.position[places.vertex], 2 * float(fleet.radii.max())
        models, kinds = fleet.profiles
        drawn: list[Int] = []
        for stream, verb in ((STARTS, "start"), (GOALS, "end")):
            order = _shuffled(len(places), seed, stream)
            taken = np.empty(0, np.int64)
            for kind in kinds:
                label = round_trips(roadmap, kind)[places.vertex]
                in_main_part = label == np.bincount(label, minlength=1).argmax()
                gap = np.hypot(*(stands[:, None] - stands[taken]).transpose(2, 0, 1))
                free = ((gap >= room - TOLERANCE) | (places.level[:, None] != places.level[taken])).all(axis=1)
                left = order[(in_main_part & free)[order]]
                if not len(left):
                    graph = models[kind].graph
                    raise InputError(
                        f"the robots do not fit: no place on graph {graph} is left at which one can {verb}"
                    )
                taken = np.append(taken, left[0])
            drawn.append(taken)
        return places.scenario(*drawn)

    def _original_draw(self, world: World, seed: int) -> Scenario:
        """Schaefer et al., "A Benchmark for Multi-Robot Planning in Realistic, Complex and Cluttered Environments"
        (2023), as its code does it.
        """
        count = len(world.vertices)
        if count < self.robots:
            raise InputError(f"{self.robots} robots do not fit: world {world.name} has {count} navigation vertices")
        starts = random.Random(seed).sample(range(count), self.robots)  # noqa: S311 - the published draw
        goals = random.Random(seed + 1).sample(range(count), self.robots)  # noqa: S311
        return places_of_world(world).scenario(np.array(starts), np.array(goals))


def _shuffled(count: int, seed: int, stream: int) -> Int:
    """Return indices in random order. Unlike `permutation`, random doubles are the same in all NumPy versions."""
    generator = np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed % 2**64, stream])))
    return np.argsort(generator.random(count), kind="stable")


def _separate(position: Float, level: Int16, order: Int, room: float, wanted: int, verb: str) -> Int:
    """Return the first `wanted` places of `order` that lie at least `room` metres from those already taken."""
    taken = np.empty(wanted, np.int64)
    count = 0
    for index in order:
        here = taken[:count]
        gap = np.hypot(*(position[here] - position[index]).T)
        if ((gap >= room - TOLERANCE) | (level[here] != level[index])).all():
            taken[count] = index
            count += 1
            if count == wanted:
                return taken
    raise InputError(
        f"{wanted} robots do not fit: world and roadmap have {len(order)} places that connect with one another, "
        f"at which {count} robots can {verb} {room:.2f} m apart"
    )
