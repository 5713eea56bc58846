"""Problems drawn as text.

`problem(\"\"\"
    a  .  B
    .  #  .
    b  .  A
\"\"\")` is two robots on a four-connected grid of cells of 1 m around a block. A small letter is a robot's start, the
capital its goal; `aB` is both; several cells with one capital are a goal set. Robots are in the order of their letters.
"""

from collections.abc import Iterable, Sequence
from itertools import accumulate, pairwise
from typing import Any

import attrs
import numpy as np
from numpy.typing import ArrayLike

from mrpbench_core.model.planning.plan import RobotPath
from mrpbench_core.model.planning.problem import Feature, Problem, features_of
from mrpbench_core.model.planning.roadmap import Raster, Roadmap

BLOCKED = "#"
STEPS = ((0, 1), (0, -1), (1, 0), (-1, 0))


def grid(rows: int, columns: int, blocked: Iterable[tuple[int, int]] = (), cell_size: float = 1.0) -> Roadmap:
    """A four-connected grid whose steps take one tick; vertices are its free cells, row by row from the lowest."""
    closed = set(blocked)
    cells = [(row, column) for row in range(rows) for column in range(columns) if (row, column) not in closed]
    vertex = {cell: index for index, cell in enumerate(cells)}
    edges = [
        (index, vertex[row + up, column + right])
        for (row, column), index in vertex.items()
        for up, right in STEPS
        if (row + up, column + right) in vertex
    ]
    cell = np.array(cells, np.int32).reshape(-1, 2)
    return Roadmap(
        position=np.asarray((cell[:, ::-1] + 0.5) * cell_size, np.float64),
        level=np.zeros(len(cell), np.int16),
        heading=np.full(len(cell), np.nan),
        edges=np.array(edges, np.int32),
        duration=np.ones((1, len(edges)), np.int32),
        tick=1.0,
        grid=Raster(shape=(rows, columns), cell_size=cell_size, origin=(0.0, 0.0), cell=cell),
    )


def problem(drawing: str, radius: float = 0.1, features: Iterable[Feature] = (), **fields: Any) -> Problem:
    """The problem of a drawing; `fields` replace those of `Problem`, `features` are added."""
    lines = [line.split() for line in drawing.strip().splitlines()][::-1]
    if len({len(line) for line in lines}) != 1:
        raise ValueError("the lines of a drawing have different lengths")
    tokens = {(row, column): token for row, line in enumerate(lines) for column, token in enumerate(line)}
    roadmap = grid(len(lines), len(lines[0]), [cell for cell, token in tokens.items() if token == BLOCKED])
    free = [token for token in tokens.values() if token != BLOCKED]
    robots = sorted({letter for token in free for letter in token if letter.islower()})
    starts = [next(vertex for vertex, token in enumerate(free) if robot in token) for robot in robots]
    goals = [tuple(vertex for vertex, token in enumerate(free) if robot.upper() in token) for robot in robots]
    roadmap = fields.pop("roadmap", roadmap)
    return build(roadmap, starts, goals, radius, features, **fields)


def build(
    road: Roadmap,
    starts: Iterable[int],
    goal_sets: Iterable[tuple[int, ...]],
    radius: ArrayLike = 0.1,
    features: Iterable[Feature] = (),
    **fields: Any,
) -> Problem:
    """A problem of like robots, each with one goal set; `features` are added, `fields` replace those of `Problem`."""
    start = np.array(list(starts), np.int32)
    count = len(start)
    defaults: dict[str, Any] = {
        "roadmap": road,
        "profile": np.zeros(count, np.int32),
        "radius": np.broadcast_to(radius, count).astype(float),
        "start": start,
        "ready": np.zeros(count, np.int64),
        "goals": tuple((tuple(goal_set),) for goal_set in goal_sets),
    }
    made = Problem(**defaults | fields)
    return attrs.evolve(made, features=features_of(made) | set(features))


def unit_path(edges: Iterable[int]) -> RobotPath:
    """A path that begins at tick 0 and takes one tick for each of its edges, -1 = wait."""
    edge = np.array(list(edges), np.int32)
    return RobotPath(edge=edge, enter=np.arange(len(edge)), leave=np.arange(len(edge)) + 1)


def path_through(road: Roadmap, vertices: Sequence[int]) -> RobotPath:
    """A path through `vertices`, each edge in its duration; a repeated vertex is a wait of one tick."""
    index = {(tail, head): edge for edge, (tail, head) in enumerate(road.edges.tolist())}
    steps = [index[a, b] if a != b else -1 for a, b in pairwise(map(int, vertices))]
    ticks = [1 if edge < 0 else int(road.duration[0, edge]) for edge in steps]
    times = [0, *accumulate(ticks)]
    return timed_path(steps, times[:-1], times[1:])


def timed_path(edge: Sequence[int], enter: Sequence[int], leave: Sequence[int]) -> RobotPath:
    """A path from lists."""
    return RobotPath(edge=np.array(edge, np.int32), enter=np.array(enter, np.int64), leave=np.array(leave, np.int64))
