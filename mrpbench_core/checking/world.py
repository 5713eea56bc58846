"""Facts of a world and of a roadmap built on it, and what is wrong with them."""

import attrs
import numpy as np

from mrpbench_core.checking.clearance import keeps_clear, solids
from mrpbench_core.checking.components import components
from mrpbench_core.checking.navigation import called, crossings, duplicates, unique_edges, vertices_on_lanes
from mrpbench_core.model.roadmap import Roadmap
from mrpbench_core.model.world import World


@attrs.frozen(kw_only=True)
class WorldFacts:
    """What a person wants to know before planning on a map. Vertices and edges count as in Table I of the original
    benchmark: a vertex per place and RMF graph, an edge per pair of positions.
    """

    name: str
    width: float
    """metres, walls included."""
    height: float
    walls: int
    doors: int
    vertices: int
    edges: int
    components: int
    """Pieces of the navigation graph as drawn."""
    cells: int | None
    """Cells of the roadmap's raster; None without one."""
    free: int | None
    blocked: int | None
    roadmap_vertices: int
    roadmap_edges: int
    """One-way edges."""
    roadmap_components: int
    faults: tuple[str, ...]
    """What is wrong with the map, one sentence each."""
    notes: tuple[str, ...]
    """What loader and roadmap left out or assumed."""


def check_world(world: World, roadmap: Roadmap, radius: float) -> WorldFacts:
    """Examine level 0 of `world`, and `roadmap`, for robots of `radius` metres."""
    edges = unique_edges(world)
    label = components(len(world.vertices), edges)
    merged = sum(len(group) - 1 for group in duplicates(world))
    grid = roadmap.grid
    width, height = size(world)
    return WorldFacts(
        name=world.name,
        width=width,
        height=height,
        walls=len(world.levels[0].walls),
        doors=len(world.levels[0].doors),
        vertices=len(world.vertices),
        edges=len(edges),
        components=len(np.unique(label)) - merged,
        cells=None if grid is None else grid.shape[0] * grid.shape[1],
        free=None if grid is None else len(roadmap.position),
        blocked=None if grid is None else grid.shape[0] * grid.shape[1] - len(roadmap.position),
        roadmap_vertices=len(roadmap.position),
        roadmap_edges=len(roadmap.edges),
        roadmap_components=len(np.unique(components(len(roadmap.position), roadmap.edges))),
        faults=(*_graph_faults(world), *_clearance_faults(world, radius), *_roadmap_faults(world, roadmap)),
        notes=(*world.notes, *roadmap.notes),
    )


def size(world: World) -> tuple[float, float]:
    """Width and height in metres of everything solid on level 0, of its places if nothing is."""
    level = world.levels[0]
    corners = [*solids(level)]
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


def _graph_faults(world: World) -> list[str]:
    faults = []
    for group in duplicates(world):
        graphs = sorted({lane.graph for lane in world.lanes if {lane.start, lane.end} & set(group)})
        faults.append(f"{called(world, group[0])} is {len(group)} vertices in one position (graphs {graphs})")
    for vertex, (a, b) in vertices_on_lanes(world):
        faults.append(
            f"{called(world, vertex)} lies on lane {called(world, a)} – {called(world, b)} without joining it"
        )
    for (a, b), (c, d) in crossings(world):
        first = f"{called(world, a)} – {called(world, b)}"
        faults.append(f"lanes {first} and {called(world, c)} – {called(world, d)} cross without a vertex")
    return faults


def _clearance_faults(world: World, radius: float) -> list[str]:
    point = np.array([(vertex.x, vertex.y) for vertex in world.vertices]).reshape(-1, 2)
    lanes = np.array(unique_edges(world), np.int64).reshape(-1, 2)
    level = world.levels[0]
    inside = ~keeps_clear(level, point, point, 0.0)
    tight = ~keeps_clear(level, point, point, radius) & ~inside
    blocked = ~keeps_clear(level, point[lanes[:, 0]], point[lanes[:, 1]], radius)
    return [
        *(f"{called(world, vertex)} lies inside a wall" for vertex in np.flatnonzero(inside).tolist()),
        *(
            f"{called(world, vertex)} is nearer than {radius:.3f} m to a wall"
            for vertex in np.flatnonzero(tight).tolist()
        ),
        *(
            f"lane {called(world, a)} – {called(world, b)} passes a wall nearer than {radius:.3f} m"
            for a, b in lanes[blocked].tolist()
        ),
    ]


def _roadmap_faults(world: World, roadmap: Roadmap) -> list[str]:
    """Places that most others cannot reach on the roadmap."""
    label = components(len(roadmap.position), roadmap.edges)
    place = roadmap.place
    found = label[place[place >= 0]]
    main = np.bincount(found).argmax() if len(found) else -1
    return [
        f"{called(world, vertex)} cannot be reached on the roadmap"
        for vertex, cell in enumerate(place.tolist())
        if cell < 0 or label[cell] != main
    ]
