"""The parts of a level in a picture: cells, walls, doors, lifts, lanes."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.doors import leaf_segments, swept_areas
from mrpbench_core.model.worlds.solids import wall_boxes
from mrpbench_core.model.worlds.world import Door, Level, World
from mrpbench_core.report.pictures.style import LANE, LIFT, ROAD, WALL


def plot_cells(axes: Any, roadmap: Roadmap) -> None:
    """Tint the cells of the roadmap's raster."""
    if roadmap.grid is None:
        return
    from matplotlib.colors import ListedColormap

    (rows, columns), size, (x, y) = roadmap.grid.shape, roadmap.grid.cell_size, roadmap.grid.origin
    free = np.zeros((rows, columns))
    free[roadmap.grid.cell[:, 0], roadmap.grid.cell[:, 1]] = 1
    axes.imshow(
        np.ma.masked_equal(free, 0),
        cmap=ListedColormap([ROAD]),
        origin="lower",
        extent=(x, x + columns * size, y, y + rows * size),
        interpolation="nearest",
        aspect="equal",
        zorder=0,
    )


def plot_solids(axes: Any, level: Level) -> None:
    """Draw blocked cells, walls, obstacles and holes."""
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import ListedColormap

    if level.occupancy is not None:
        (rows, columns), size, (x, y) = level.occupancy.shape, level.occupancy.resolution, level.occupancy.origin
        axes.imshow(
            np.ma.masked_equal(level.occupancy.blocked, 0),
            cmap=ListedColormap([WALL]),
            origin="lower",
            extent=(x, x + columns * size, y, y + rows * size),
            interpolation="nearest",
            aspect="equal",
            zorder=1,
        )
    boxes = wall_boxes(level.walls, level.wall_thickness).reshape(-1, 4, 4)[:, :, :2]
    # a thin edge keeps walls visible on maps of hundreds of metres
    axes.add_collection(PolyCollection(list(boxes), facecolor=WALL, edgecolor=WALL, linewidth=0.6, zorder=3))
    obstacles = [obstacle.polygon for obstacle in level.obstacles]
    axes.add_collection(PolyCollection(obstacles, facecolor="#b9a68c", edgecolor="#8d7b62", linewidth=0.6, zorder=2))
    holes = [hole.polygon for hole in level.holes]
    axes.add_collection(PolyCollection(holes, facecolor="none", edgecolor=WALL, hatch="xxx", linewidth=0.6, zorder=2))


def plot_doors(axes: Any, doors: Sequence[Door], colour: str, *, shut: bool) -> None:
    """Draw the leaves of doors: shut if `shut`, and thin where they are when open; tint what hinged leaves sweep."""
    from matplotlib.collections import LineCollection, PolyCollection

    swings = [part for door in doors if "hinged" in door.motion for part in swept_areas(door)]
    axes.add_collection(PolyCollection(swings, facecolor=colour, alpha=0.15, linewidth=0, zorder=1))
    for opening, width in ((0.0, 1.8), (1.0, 0.6)) if shut else ((1.0, 0.6),):
        lines = [line for door in doors for line in leaf_segments(door, opening).reshape(-1, 2, 2)]
        axes.add_collection(LineCollection(lines, colors=colour, linewidths=width, capstyle="butt", zorder=3))


def plot_cabins(axes: Any, world: World, level: int) -> None:
    """Draw the cabins of lifts that stop at the level."""
    from matplotlib.collections import PolyCollection

    cabins = [lift.corners for lift in world.lifts if level in lift.levels]
    axes.add_collection(PolyCollection(cabins, facecolor="#e9ddf0", edgecolor=LIFT, linewidth=0.8, zorder=2))


def lift_doors(world: World, level: int) -> list[Door]:
    """Return the doors of lifts that open at the level."""
    return [
        door
        for lift in world.lifts
        for door, levels in zip(lift.doors, lift.door_levels, strict=True)
        if level in levels
    ]


def plot_lanes(axes: Any, world: World, level: int) -> None:
    """Draw lanes, with an arrow on those of one direction, and vertices."""
    from matplotlib.collections import LineCollection

    position = [(vertex.x, vertex.y) for vertex in world.vertices]
    lanes = [lane for lane in world.lanes if world.vertices[lane.start].level == level]
    lines = [(position[lane.start], position[lane.end]) for lane in lanes]
    axes.add_collection(LineCollection(lines, colors=LANE, linewidths=0.8, zorder=4))
    point = [xy for xy, vertex in zip(position, world.vertices, strict=True) if vertex.level == level]
    for lane in lanes:
        if not lane.bidirectional:
            (x1, y1), (x2, y2) = position[lane.start], position[lane.end]
            arrow = {"arrowstyle": "->", "color": LANE, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0}
            tip = (x1 + 0.55 * (x2 - x1), y1 + 0.55 * (y2 - y1))
            axes.annotate("", xy=tip, xytext=(x1, y1), arrowprops=arrow, zorder=4)
    if point:
        axes.scatter(*zip(*point, strict=True), s=6, color="white", edgecolors=LANE, linewidths=0.8, zorder=5)
