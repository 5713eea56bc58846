"""Places where robots may start or end: the world's vertices, or the roadmap's."""

import attrs
import numpy as np

from mrpbench_core.model.arrays import Float, Int, Int16
from mrpbench_core.model.roadmap import Roadmap
from mrpbench_core.model.scenario import Scenario, Task
from mrpbench_core.model.world import World


@attrs.frozen(kw_only=True)
class Places:
    """Named positions, and the roadmap vertex of each."""

    position: Float
    """f8[k,2] metres."""
    level: Int16
    vertex: Int
    """i8[k]; empty where no roadmap was asked for."""
    names: tuple[str, ...]
    """() = none has a name."""

    def __len__(self) -> int:
        return len(self.position)

    def __getitem__(self, chosen: Int) -> "Places":
        return Places(
            position=self.position[chosen],
            level=self.level[chosen],
            vertex=self.vertex[chosen],
            names=tuple(self.names[index] for index in chosen) if self.names else (),
        )

    def scenario(self, starts: Int, goals: Int) -> Scenario:
        """The scenario of robots at places `starts` with one task at each of places `goals`, any yaw."""
        pose = np.column_stack([self.position, np.full(len(self), np.nan)])
        names = self.names or ("",) * len(self)
        return Scenario(
            start=pose[starts],
            start_level=self.level[starts],
            start_names=tuple(names[index] for index in starts) if self.names else (),
            tasks=tuple(Task(goals=pose[[goal]], levels=self.level[[goal]], name=names[goal]) for goal in goals),
        )


def places_of_world(world: World, roadmap: Roadmap | None = None) -> Places:
    """The world's vertices in order; with a roadmap only those on it, the first on each roadmap vertex."""
    places = Places(
        position=np.array([(vertex.x, vertex.y) for vertex in world.vertices]).reshape(-1, 2),
        level=np.array([vertex.level for vertex in world.vertices], np.int16),
        vertex=np.empty(0, np.int64),
        names=tuple(vertex.name for vertex in world.vertices),
    )
    if roadmap is None:
        return places
    vertex = roadmap.locate(places.position, places.level).astype(np.int64)
    if len(roadmap.place) == len(vertex):  # a place that a builder left out must not be moved to its nearest vertex
        vertex = np.where(roadmap.place == vertex, vertex, -1)
    found, first = np.unique(vertex, return_index=True)
    return attrs.evolve(places, vertex=vertex)[np.sort(first[found >= 0])]


def places_of_roadmap(roadmap: Roadmap) -> Places:
    """Every vertex of the roadmap, nameless."""
    return Places(position=roadmap.position, level=roadmap.level, vertex=np.arange(len(roadmap.position)), names=())
