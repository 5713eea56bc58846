"""Facts and faults of a world and of a roadmap built on it."""

from collections import Counter, defaultdict
from collections.abc import Iterator

import attrs
import numpy as np

from mrpbench_core.checking.clearance import has_clearance, solids
from mrpbench_core.checking.components import components
from mrpbench_core.checking.navigation import called, crossings, duplicates, graphs, unique_edges, vertices_on_lanes
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.world import World
from mrpbench_world.door_sweeps import check_door_sweeps
from mrpbench_world.passages import narrow_passages


@attrs.frozen(kw_only=True)
class WorldFacts:
    """Size, contents and faults of a world. Vertices and edges count as in Table I of the original benchmark: a vertex
    per place and RMF graph, an edge per pair of positions.
    """

    name: str
    width: float
    """metres, walls included."""
    height: float
    levels: int
    walls: int
    doors: int
    lifts: int
    obstacles: int
    """Furniture."""
    vertices: int
    shared: int
    """Places that several navigation graphs have, as those of several fleets do."""
    edges: int
    components: int
    """Connected components of the navigation graph as drawn."""
    cells: int | None
    """Cells of the roadmap's raster; None without one."""
    free: int | None
    blocked: int | None
    roadmap_vertices: int
    roadmap_edges: int
    """One-way edges."""
    roadmap_components: int
    faults: tuple[str, ...]
    """Faults of the map, one sentence each."""
    narrow: tuple[str, ...]
    """Passages narrower than the robot, one sentence each."""
    sweeps: tuple[str, ...]
    """Lanes and cells that the leaves of doors sweep, and doors without a place to wait, one sentence each."""
    notes: tuple[str, ...]
    """Omissions and assumptions of the loader and the roadmap, one sentence each."""


def check_world(world: World, roadmap: Roadmap, radius: float) -> WorldFacts:
    """Return the facts of all levels of `world` and of `roadmap`, for robots of `radius` metres."""
    edges = unique_edges(world)
    label = components(len(world.vertices), edges)
    same, repeated = duplicates(world), _repeated(world)
    grid = roadmap.grid
    width, height = size(world)
    return WorldFacts(
        name=world.name,
        width=width,
        height=height,
        levels=len(world.levels),
        walls=sum(len(level.walls) for level in world.levels),
        doors=sum(len(level.doors) for level in world.levels),
        lifts=len(world.lifts),
        obstacles=sum(len(level.obstacles) for level in world.levels),
        vertices=len(world.vertices),
        shared=len(same) - len(repeated),
        edges=len(edges),
        components=len(np.unique(label)) - sum(len(group) - 1 for group in same),
        cells=None if grid is None else grid.shape[0] * grid.shape[1],
        free=None if grid is None else len(roadmap.distinct),
        blocked=None if grid is None else grid.shape[0] * grid.shape[1] - len(roadmap.distinct),
        roadmap_vertices=len(roadmap.position),
        roadmap_edges=len(roadmap.edges),
        roadmap_components=len(np.unique(components(len(roadmap.position), roadmap.edges))),
        faults=(
            *_graph_faults(world),
            *_clearance_faults(world, radius),
            *_roadmap_faults(world, roadmap),
            *(f"{called(world, group[0])} is {len(group)} vertices in one position" for group in repeated),
            *_names(world),
        ),
        narrow=tuple(_narrow(world, 2 * radius)),
        sweeps=tuple(check_door_sweeps(world, roadmap, radius)),
        notes=(*world.notes, *roadmap.notes),
    )


def size(world: World) -> tuple[float, float]:
    """Return width and height in metres of everything solid on all levels, or of the places if nothing is solid."""
    corners = [outline for level in world.levels for outline in solids(level)]
    for level in world.levels:
        if level.occupancy is not None:
            rows, columns = level.occupancy.shape
            corners.append(level.occupancy.centres(np.array([(-0.5, -0.5), (rows - 0.5, columns - 0.5)])))
    if not corners:
        corners = [np.array([(vertex.x, vertex.y) for vertex in world.vertices]).reshape(-1, 2)]
    points = np.concatenate(corners)
    if not len(points):
        return 0.0, 0.0
    width, height = points.max(axis=0) - points.min(axis=0)
    return float(width), float(height)


def _repeated(world: World) -> list[tuple[int, ...]]:
    """Vertices in one position that are not one place of several graphs, which has one vertex for each of them."""
    of = graphs(world)
    return [
        group
        for group in duplicates(world)
        if not all(of[vertex] for vertex in group)
        or sum(len(of[vertex]) for vertex in group) > len(set().union(*(of[vertex] for vertex in group)))
    ]


def _names(world: World) -> Iterator[str]:
    """Names that stand for several places or doors."""
    places: dict[str, set[tuple[int, float, float]]] = defaultdict(set)
    for vertex in world.vertices:
        places[vertex.name].add((vertex.level, vertex.x, vertex.y))
    for name, where in places.items():
        if name and len(where) > 1:
            listed = ", ".join(f"({x:.2f}, {y:.2f}){_on(world, level)}" for level, x, y in sorted(where))
            yield f"{len(where)} places are named {name}: {listed}"
    doors = Counter(door.name for level in world.levels for door in level.doors)
    yield from (f"{count} doors are named {name}" for name, count in doors.items() if name and count > 1)


def _graph_faults(world: World) -> list[str]:
    faults = []
    for vertex, (a, b) in vertices_on_lanes(world):
        faults.append(
            f"{called(world, vertex)} lies on lane {called(world, a)} – {called(world, b)} without joining it"
        )
    for (a, b), (c, d) in crossings(world):
        first = f"{called(world, a)} – {called(world, b)}"
        faults.append(f"lanes {first} and {called(world, c)} – {called(world, d)} cross without a vertex")
    return faults


def _clearance_faults(world: World, radius: float) -> list[str]:
    lanes = np.array(unique_edges(world), np.int64).reshape(-1, 2)
    storey = np.array([vertex.level for vertex in world.vertices], np.int64)
    inside, tight, blocked = [], [], []
    for index, level in enumerate(world.levels):
        here = np.flatnonzero(storey == index)
        point = np.array([(world.vertices[vertex].x, world.vertices[vertex].y) for vertex in here]).reshape(-1, 2)
        within = ~has_clearance(level, point, point, 0.0)
        inside += here[within].tolist()
        tight += here[~has_clearance(level, point, point, radius) & ~within].tolist()
        ours = lanes[storey[lanes[:, 0]] == index] if len(lanes) else lanes
        number = np.cumsum(storey == index) - 1
        start, end = (point[number[ends]] for ends in ours.T)
        blocked += ours[~has_clearance(level, start, end, radius)].tolist()
    return [
        *(f"{called(world, vertex)} lies inside something solid" for vertex in inside),
        *(f"{called(world, vertex)} is nearer than {radius:.3f} m to something solid" for vertex in tight),
        *(
            f"lane {called(world, a)} – {called(world, b)} passes something solid nearer than {radius:.3f} m"
            for a, b in blocked
        ),
    ]


def _narrow(world: World, width: float) -> list[str]:
    return [
        f"the passage at ({passage.x:.2f}, {passage.y:.2f}){_on(world, index)} is {passage.width:.3f} m wide, "
        f"the robot needs {width:.3f} m"
        for index, level in enumerate(world.levels)
        for passage in narrow_passages(level, width)
    ]


def _on(world: World, level: int) -> str:
    return f" on level {world.levels[level].name}" if len(world.levels) > 1 else ""


def _roadmap_faults(world: World, roadmap: Roadmap) -> list[str]:
    """Return the places that are not in the main component of their level; the roadmap may cover some levels only."""
    label = components(len(roadmap.position), roadmap.edges)
    storey = np.array([vertex.level for vertex in world.vertices], np.int64)
    faults = []
    for level in np.unique(roadmap.level):
        here = np.flatnonzero(storey == level)
        place = roadmap.place[here]
        labels = label[place[place >= 0]]
        main = np.bincount(labels).argmax() if len(labels) else -1
        cut = here[(place < 0) | (label[np.maximum(place, 0)] != main)]
        faults += [f"{called(world, vertex)} cannot be reached on the roadmap" for vertex in cut.tolist()]
    return faults
