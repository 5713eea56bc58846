"""Places where robots may start or end: the world's vertices, or the roadmap's."""

import attrs
import numpy as np

from mrpbench_core.checking.reachability import round_trips
from mrpbench_core.model.common.arrays import Float, Int, Int16
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class Places:
    """Named positions and their roadmap vertices."""

    position: Float
    """f8[k,2] metres."""
    level: Int16
    vertex: Int
    """i8[k]; empty without a roadmap."""
    names: tuple[str, ...]
    """() if the places have no names."""

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
        """Return the scenario with robots at the places `starts` and a task at each of the places `goals`, any yaw."""
        pose = np.column_stack([self.position, np.full(len(self), np.nan)])
        names = self.names or ("",) * len(self)
        return Scenario(
            start=pose[starts],
            start_level=self.level[starts],
            start_names=tuple(names[index] for index in starts) if self.names else (),
            tasks=tuple(Task(goals=pose[[goal]], levels=self.level[[goal]], name=names[goal]) for goal in goals),
        )


def places_of_world(world: World, roadmap: Roadmap | None = None) -> Places:
    """Return the vertices of the world in order; with a roadmap, the first vertex on each roadmap vertex."""
    places = Places(
        position=np.array([(vertex.x, vertex.y) for vertex in world.vertices]).reshape(-1, 2),
        level=np.array([vertex.level for vertex in world.vertices], np.int16),
        vertex=np.empty(0, np.int64),
        names=tuple(vertex.name for vertex in world.vertices),
    )
    if roadmap is None:
        return places
    vertex = roadmap.locate(places.position, places.level).astype(np.int64)
    if len(roadmap.place) == len(vertex):  # a place that the builder left out must not move to its nearest vertex
        vertex = np.where(roadmap.place == vertex, vertex, -1)
    distinct, first = np.unique(vertex, return_index=True)
    return attrs.evolve(places, vertex=vertex)[np.sort(first[distinct >= 0])]


def places_of_roadmap(roadmap: Roadmap) -> Places:
    """Return every place of the roadmap, without names: the first vertex where several are at one place."""
    vertex = roadmap.distinct
    return Places(position=roadmap.position[vertex], level=roadmap.level[vertex], vertex=vertex, names=())


def connected(roadmap: Roadmap, places: Places) -> Int:
    """Return the indices of the largest group of places between which every motion profile can drive both ways."""
    labels = [round_trips(roadmap, profile)[places.vertex] for profile in range(len(roadmap.duration))]
    if not labels or not len(places):
        return np.arange(len(places))
    _, group, sizes = np.unique(np.stack(labels), axis=1, return_inverse=True, return_counts=True)
    return np.flatnonzero(group.ravel() == sizes.argmax())


def outside_resources(roadmap: Roadmap, places: Places) -> Int:
    """Return the indices of the places outside of doors, lifts and mutexes."""
    used = [vertex for resource in roadmap.resources for vertex in resource.vertices]
    return np.flatnonzero(~np.isin(places.vertex, used))
