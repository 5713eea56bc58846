"""The navigation graphs of a building file.

A vertex becomes one world vertex for each graph whose lanes use it, in the order in which RMF publishes them: by graph
index, inside a graph by level, inside a level by first use, start before end. Random scenarios depend on that order.
"""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.geometry import segment_distance
from mrpbench_core.model.worlds.world import Door, Lane, Lift, Vertex
from mrpbench_worlds_standard.building.node import Node
from mrpbench_worlds_standard.building.notes import Notes
from mrpbench_worlds_standard.building.parameters import Kind, read_parameters

GRAPHS = range(9)
"""The graph indices that RMF exports. The editor has a tenth, which RMF does not export."""
VERTEX: dict[str, Kind] = {
    **dict.fromkeys(
        ("is_parking_spot", "is_charger", "is_cleaning_zone", "is_holding_point", "is_passthrough_point"), bool
    ),
    **dict.fromkeys(("dock_name", "dropoff_ingestor", "pickup_dispenser", "spawn_robot_type", "spawn_robot_name"), str),
    **dict.fromkeys(("human_goal_set_name", "mutex", "lift_cabin"), str),
    "merge_radius": float,
}
LANE: dict[str, Kind] = {
    "bidirectional": bool,
    "graph_idx": int,
    "orientation": str,
    "speed_limit": float,
    "mutex": str,
    "demo_mock_floor_name": str,
    "demo_mock_lift_name": str,
}


@attrs.frozen
class LevelDrawing:
    """The vertices and doors of a level, as drawn."""

    node: Node
    positions: Float
    """f8[k,2] metres, of all vertices of the level."""
    doors: Sequence[Door]


def read_graph(
    drawings: Sequence[LevelDrawing], lifts: Sequence[Lift], notes: Notes
) -> tuple[tuple[Vertex, ...], tuple[Lane, ...]]:
    """Return the places that lanes use and the lanes, both sorted by graph index."""
    places = [_places(drawing, level, lifts, notes) for level, drawing in enumerate(drawings)]
    drawn = [_lanes(drawing, notes) for drawing in drawings]
    vertices: list[Vertex] = []
    lanes: list[Lane] = []
    for graph in GRAPHS:
        for here, candidates in zip(places, drawn, strict=True):
            number: dict[int, int] = {}
            for lane in candidates:
                if lane.graph == graph:
                    for index in (lane.start, lane.end):
                        if index not in number:
                            number[index] = len(vertices)
                            vertices.append(here[index])
                    lanes.append(attrs.evolve(lane, start=number[lane.start], end=number[lane.end]))
    notes.add("lane of a graph above 8 is left out, as RMF does", sum(map(len, drawn)) - len(lanes))
    return tuple(vertices), tuple(lanes)


def _places(drawing: LevelDrawing, level: int, lifts: Sequence[Lift], notes: Notes) -> list[Vertex]:
    nodes = drawing.node.section("vertices")
    return [_place(node, xy, level, lifts, notes) for node, xy in zip(nodes, drawing.positions, strict=True)]


def _place(node: Node, position: Float, level: int, lifts: Sequence[Lift], notes: Notes) -> Vertex:
    items = node.items()
    name = items[3].text() if len(items) > 3 else ""
    parameters = read_parameters(items[4], VERTEX, "vertex", notes) if len(items) > 4 else {}
    x, y = position.tolist()
    cabin = parameters.get("lift_cabin", "")
    inside = [lift.name for lift in lifts if level in lift.levels and lift.holds(x, y)]
    if cabin and cabin not in inside:
        notes.add(f"vertex names the lift_cabin {cabin!r}, which is not at that position of its level")
    return Vertex(name=name, x=x, y=y, level=level, parameters=parameters, lift=inside[0] if inside else "")


def _lanes(drawing: LevelDrawing, notes: Notes) -> list[Lane]:
    return [lane for node in drawing.node.section("lanes") if (lane := _lane(node, drawing, notes)) is not None]


def _lane(node: Node, drawing: LevelDrawing, notes: Notes) -> Lane | None:
    """Return the lane with the vertex indices of its level; None if it has no length."""
    first, second, *rest = node.items(least=2)
    positions = drawing.positions
    start, end = (item.index(len(positions), "lane") for item in (first, second))
    parameters = read_parameters(rest[0], LANE, "lane", notes) if rest else {}
    graph = parameters.get("graph_idx", 0)
    if graph < 0:
        raise node.error(f"lane of graph {graph}: graphs are counted from 0")
    if start == end:
        notes.add("lane from a vertex to itself is left out")
        return None
    orientation = parameters.get("orientation", "")
    if orientation not in ("", "forward", "backward"):
        notes.add(f"lane orientation {orientation!r} is not known and has no effect")
        orientation = ""
    if orientation == "backward" or (
        orientation and parameters.get("bidirectional")
    ):  # a two-way lane is driven backward in one direction
        notes.add("lane with orientation backward is driven forward, like all lanes")
    if parameters.get("demo_mock_floor_name") or parameters.get("demo_mock_lift_name"):
        notes.add("lane through a mock lift is treated as an ordinary lane")
    return Lane(
        start=start,
        end=end,
        bidirectional=parameters.get("bidirectional", False),
        graph=graph,
        speed_limit=max(0.0, parameters.get("speed_limit", 0.0)),
        orientation=orientation,
        mutex=parameters.get("mutex", ""),
        door=_door_on(positions[start], positions[end], drawing.doors),
    )


def _door_on(start: Float, end: Float, doors: Sequence[Door]) -> str:
    """Return the name of the first door that the lane passes."""
    if not doors:
        return ""
    a, b = (np.array(list(sides)) for sides in ([d.start for d in doors], [d.end for d in doors]))
    hit = np.flatnonzero(segment_distance(start, end, a, b) < 1e-9)
    return doors[int(hit[0])].name if len(hit) else ""
