"""Tasks whose errands are drawn at random places, each from a random stream of its own."""

from abc import abstractmethod
from itertools import islice

import attrs
import numpy as np

from mrpbench_core.api.component import between, option
from mrpbench_core.api.task_source import TaskSource
from mrpbench_core.builtin.scenarios.places import (
    Places,
    connected,
    outside_resources,
    places_of_roadmap,
    places_of_world,
)
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.worlds.world import World

_FEW = between(1, 1000)
ERRANDS, ARRIVALS = 2, 3
"""Keys of the random streams of a seed, beside those of the scenario `random`."""


def stream(seed: int, key: int, index: int) -> np.random.Generator:
    """Return the random stream of task `index`: PCG64 with the key (seed modulo 2**64, key, index)."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed % 2**64, key, index])))


@attrs.frozen(kw_only=True)
class DrawnTasks(TaskSource):
    """Base of sources whose tasks are drawn."""

    service: float = option(0.0, help="rest at each place", unit="s", validator=attrs.validators.ge(0))
    due: float | None = option(
        None,
        help="the deadline of a task, counted from its release; none: no deadlines",
        unit="s",
        validator=attrs.validators.optional(attrs.validators.gt(0)),
    )

    @abstractmethod
    def places(self, world: World, roadmap: Roadmap) -> tuple[tuple[Places, int], ...]:
        """Return the places from which each errand is drawn, and how many are, in the order of the errands.

        Raises:
            InputError: there are too few.
        """


@attrs.frozen(kw_only=True)
class AnyPlace(DrawnTasks):
    """Base of sources whose errands are drawn at the named places of the world if it has any, else at any vertex of the
    roadmap, outside of doors, lifts and mutexes, where every robot can drive between any two.
    """

    errands: int = option(1, help="places that each task visits, in order", validator=_FEW)
    places_per_errand: int = option(
        1, help="places drawn for each errand, which is done at any of them", validator=_FEW
    )

    def places(self, world: World, roadmap: Roadmap) -> tuple[tuple[Places, int], ...]:
        """Return the same places for each errand."""
        usable = usable_places(world, roadmap)
        needed = min(2, self.errands) * self.places_per_errand
        if len(usable) < needed:
            lack = f" and needs {needed}" if needed > 2 else ""
            raise InputError(f"tasks: world {world.name} has {len(usable)} places that all robots can reach{lack}")
        return ((usable, self.places_per_errand),) * self.errands


@attrs.frozen
class Drawing:
    """Draws the tasks of one seed."""

    source: DrawnTasks
    choices: tuple[tuple[Places, int], ...]
    """The places from which each errand is drawn, and how many are."""
    seed: int

    @property
    def places(self) -> tuple[Float, Int16]:
        """Positions f8[k,2] and levels i2[k] of all places."""
        return np.concatenate([it.position for it, _ in self.choices]), np.concatenate(
            [it.level for it, _ in self.choices]
        )

    def task(self, index: int, release: float) -> Task:
        """Return task `index`, released at `release` seconds; no errand is at a place of the one before."""
        sizes = [size for _, size in self.choices]
        shares = iter(stream(self.seed, ERRANDS, index).random(sum(sizes)).tolist())
        positions, levels, names = [], [], []
        before: list[int] = []
        for places, size in self.choices:
            open_to, chosen = np.flatnonzero(~np.isin(places.vertex, before)), []
            for share in islice(shares, size):
                chosen.append(int(open_to[int(share * len(open_to))]))
                open_to = open_to[open_to != chosen[-1]]
            before = places.vertex[chosen].tolist()
            positions += [(*places.position[place], np.nan) for place in chosen]
            levels += places.level[chosen].tolist()
            names.append(" or ".join(places.names[place] for place in chosen) if places.names else "")
        return Task(
            goals=np.array(positions),
            errand=np.repeat(np.arange(len(sizes)), sizes),
            levels=np.array(levels, np.int16),
            name=" to ".join(names) if all(names) else "",
            release=release,
            service=self._service(),
            deadline=np.inf if self.source.due is None else release + self.source.due,
            index=index,
        )

    def _service(self) -> Float:
        return np.full(len(self.choices), self.source.service)


def usable_places(world: World, roadmap: Roadmap) -> Places:
    """Return the places outside of doors, lifts and mutexes between which every robot can drive."""
    places = places_of_world(world, roadmap) if world.vertices else places_of_roadmap(roadmap)
    places = places[connected(roadmap, places)]
    return places[outside_resources(roadmap, places)]
