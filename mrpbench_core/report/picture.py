"""Pictures of worlds: walls, lanes, names; planned paths dashed, driven paths solid."""

from collections.abc import Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.arrays import Float
from mrpbench_core.model.doors import leaf_segments, swept_areas
from mrpbench_core.model.execution import Route
from mrpbench_core.model.fleet import Fleet
from mrpbench_core.model.roadmap import Roadmap
from mrpbench_core.model.solids import segments, wall_boxes
from mrpbench_core.model.world import Door, Level, World

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a5195", "#8c6d31")
"""Told apart by colour-blind readers; after Okabe and Ito, "Color Universal Design", 2008."""
PIXELS = 1280
CROWDED = 100
"""Names beyond which they are written smaller."""
_DPI = 160
_MARGINS = (84, 20, 60, 44)
"""Left, right, bottom, top, pixels."""
_DOT = 3
"""Pixels around a place that no name covers."""
_LEAST = 250
"""Pixels of the shorter side of the map."""
WALL, _LANE, _ROAD, _NAME, _DOOR, _LIFT = "#3b4252", "#9db4c8", "#e8f0f6", "#51606e", "#b07d2b", "#7a5195"


def draw_world(
    world: World,
    *,
    file: Path,
    roadmap: Roadmap | None = None,
    fleet: Fleet | None = None,
    routes: Sequence[Route] | None = None,
    truth: Float | None = None,
    level: int = 0,
) -> None:
    """Draw a level of `world` into a PNG of 1280 pixels width (or height, for a tall world).

    Args:
        world: walls, obstacles, lanes and the names of places.
        file: where to; its folder must exist.
        roadmap: shade the cells of its raster.
        fleet: draw robots in their true size at their starts.
        routes: planned paths, dashed; start as a circle, goal as a star, both with the robot's number.
        truth: driven paths f8[T,n,3], solid; NaN where unknown.
        level: which level; of routes, the parts on it are drawn.

    Raises:
        InputError: matplotlib is missing, or the file cannot be written.
    """
    moving = routes is not None or truth is not None
    with _plain():
        figure, axes = world_figure(world, roadmap=roadmap, truth=truth, level=level, faint=moving)
        if moving:
            _paths(axes, fleet, [_on_level(route, level) for route in routes or ()], truth)
        try:
            figure.savefig(file, format="png")
        except OSError as error:
            raise InputError(f"cannot be written: {error.strerror or error}", file=file) from None


def world_figure(
    world: World,
    *,
    roadmap: Roadmap | None = None,
    truth: Float | None = None,
    level: int = 0,
    faint: bool = False,
    pixels: int = PIXELS,
    shut: bool = True,
) -> tuple[Any, Any]:
    """A matplotlib figure of `pixels` width (or height) of a level, and its axes in metres; room for paths `truth`.

    Doors are drawn open and, if `shut`, shut.

    Raises:
        InputError: matplotlib is missing.
    """
    with _plain():
        from matplotlib.figure import Figure

        low, high = _bounds(world, truth, level)
        sheet, frame = _layout(high - low)
        figure = Figure(figsize=sheet, dpi=_DPI * pixels / PIXELS)
        axes = figure.add_axes(frame)
        _frame(axes, _title(world, level), low, high)
        if roadmap is not None and level in roadmap.level:
            _shade(axes, roadmap)
        _solids(axes, world.levels[level])
        _cabins(axes, world, level)
        _doors(axes, world.levels[level].doors, _DOOR, shut=shut)
        _doors(axes, _lift_doors(world, level), _LIFT, shut=shut)
        _lanes(axes, world, level)
        places = np.array([(v.x, v.y) for v in world.vertices if v.level == level]).reshape(-1, 2)
        _names(figure, axes, _labels(world, level), places, faint=faint)
    return figure, axes


def _plain() -> AbstractContextManager[None]:
    """Our own style, whatever the user's is."""
    try:
        import matplotlib
    except ImportError:
        raise InputError("pictures need matplotlib", hint="pip install 'mrpbench-core[figures]'") from None
    style: AbstractContextManager[None] = matplotlib.rc_context({"font.family": "sans-serif", "font.size": 7})
    return style


def _title(world: World, level: int) -> str:
    return world.name if len(world.levels) == 1 else f"{world.name}, {world.levels[level].name}"


def _labels(world: World, level: int) -> dict[tuple[float, float], str]:
    """Names of places and lifts by position."""
    names = {(v.x, v.y): v.name or v.lift for v in world.vertices if v.level == level}
    return {position: name for position, name in names.items() if name}


def _bounds(world: World, truth: Float | None, level: int) -> tuple[Float, Float]:
    """Lower left and upper right corner of what is drawn, with a margin."""
    places = [(v.x, v.y) for v in world.vertices if v.level == level]
    points = [segments(world, level).reshape(-1, 2), np.array(places).reshape(-1, 2)]
    points += [part for door in world.levels[level].doors for part in swept_areas(door)]
    if truth is not None:
        points.append(truth[..., :2].reshape(-1, 2))
    everything = np.concatenate(points)
    everything = everything[np.isfinite(everything).all(axis=1)]
    if not len(everything):
        return np.zeros(2), np.ones(2)
    low, high = everything.min(axis=0), everything.max(axis=0)
    margin = 0.02 * float((high - low).max()) + 0.1
    return low - margin, high + margin


def _layout(size: Float) -> tuple[tuple[float, float], tuple[float, float, float, float]]:
    """Width and height of the sheet in inches, and left, bottom, width, height of the map as shares of it."""
    left, right, bottom, top = _MARGINS
    room = np.array([PIXELS - left - right, PIXELS - bottom - top])
    width, height = np.maximum(size * (room / size).min(), _LEAST).tolist()
    across, up = width + left + right, height + bottom + top
    return (across / _DPI, up / _DPI), (left / across, bottom / up, width / across, height / up)


def _frame(axes: Any, title: str, low: Float, high: Float) -> None:
    axes.set_aspect("equal")
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_xlabel("x [m]", color=_NAME)
    axes.set_ylabel("y [m]", color=_NAME)
    axes.set_title(title, fontsize=9, loc="left", color=_NAME)
    axes.tick_params(length=2, color=_NAME, labelcolor=_NAME)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _shade(axes: Any, roadmap: Roadmap) -> None:
    """The cells of the roadmap's raster."""
    if roadmap.grid is None:
        return
    from matplotlib.colors import ListedColormap

    (rows, columns), size, (x, y) = roadmap.grid.shape, roadmap.grid.cell_size, roadmap.grid.origin
    free = np.zeros((rows, columns))
    free[roadmap.grid.cell[:, 0], roadmap.grid.cell[:, 1]] = 1
    axes.imshow(
        np.ma.masked_equal(free, 0),
        cmap=ListedColormap([_ROAD]),
        origin="lower",
        extent=(x, x + columns * size, y, y + rows * size),
        interpolation="nearest",
        aspect="equal",
        zorder=0,
    )


def _solids(axes: Any, level: Level) -> None:
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import ListedColormap

    if level.occupancy is not None:
        (rows, columns), size, (x, y) = level.occupancy.shape, level.occupancy.cell_size, level.occupancy.origin
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


def _doors(axes: Any, doors: Sequence[Door], colour: str, *, shut: bool) -> None:
    """Leaves where they are when shut and, thin, when open; what they sweep on hinges is tinted."""
    from matplotlib.collections import LineCollection, PolyCollection

    swings = [part for door in doors if "hinged" in door.motion for part in swept_areas(door)]
    axes.add_collection(PolyCollection(swings, facecolor=colour, alpha=0.15, linewidth=0, zorder=1))
    for opening, width in ((0.0, 1.8), (1.0, 0.6)) if shut else ((1.0, 0.6),):
        lines = [line for door in doors for line in leaf_segments(door, opening).reshape(-1, 2, 2)]
        axes.add_collection(LineCollection(lines, colors=colour, linewidths=width, capstyle="butt", zorder=3))


def _cabins(axes: Any, world: World, level: int) -> None:
    """Cabins that stop here."""
    from matplotlib.collections import PolyCollection

    cabins = [lift.corners for lift in world.lifts if level in lift.levels]
    axes.add_collection(PolyCollection(cabins, facecolor="#e9ddf0", edgecolor=_LIFT, linewidth=0.8, zorder=2))


def _lift_doors(world: World, level: int) -> list[Door]:
    """Doors of lifts that open here."""
    return [
        door
        for lift in world.lifts
        for door, levels in zip(lift.doors, lift.door_levels, strict=True)
        if level in levels
    ]


def _lanes(axes: Any, world: World, level: int) -> None:
    from matplotlib.collections import LineCollection

    position = [(vertex.x, vertex.y) for vertex in world.vertices]
    lanes = [lane for lane in world.lanes if world.vertices[lane.start].level == level]
    lines = [(position[lane.start], position[lane.end]) for lane in lanes]
    axes.add_collection(LineCollection(lines, colors=_LANE, linewidths=0.8, zorder=4))
    point = [xy for xy, vertex in zip(position, world.vertices, strict=True) if vertex.level == level]
    for lane in lanes:
        if not lane.bidirectional:
            (x1, y1), (x2, y2) = position[lane.start], position[lane.end]
            arrow = {"arrowstyle": "->", "color": _LANE, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0}
            tip = (x1 + 0.55 * (x2 - x1), y1 + 0.55 * (y2 - y1))
            axes.annotate("", xy=tip, xytext=(x1, y1), arrowprops=arrow, zorder=4)
    if point:
        axes.scatter(*zip(*point, strict=True), s=6, color="white", edgecolors=_LANE, linewidths=0.8, zorder=5)


def _on_level(route: Route, level: int) -> Float:
    """Waypoints f8[k,2], NaN on other levels."""
    there: Float = np.where((route.level == level)[:, None], route.waypoint[:, :2], np.nan)
    return there


def _paths(axes: Any, fleet: Fleet | None, routes: Sequence[Float], truth: Float | None) -> None:
    """Per robot: planned dashed, driven solid, start circle, goal star; NaN is elsewhere."""
    from matplotlib.patches import Circle

    robots = len(routes) if routes else (0 if truth is None else truth.shape[1])
    width = 1.6 if robots <= 20 else 0.9
    for robot in range(robots):
        colour = COLOURS[robot % len(COLOURS)]
        planned = routes[robot] if routes else np.empty((0, 2))
        driven = np.empty((0, 2)) if truth is None else truth[:, robot, :2]
        if len(planned):
            axes.plot(*planned.T, "--", color=colour, linewidth=0.7 * width, alpha=0.7, zorder=6, dash_capstyle="round")
        if len(driven):
            axes.plot(*driven.T, "-", color=colour, linewidth=width, zorder=7, solid_joinstyle="round")
        start, goal = (planned if len(planned) else driven)[[0, -1]]
        if fleet is not None and np.isfinite(start).all():
            axes.add_patch(Circle(start, fleet.robots[robot].radius, facecolor=colour, alpha=0.25, zorder=7))
        for point, marker, size in ((start, "o", 9), (goal, "*", 15)):
            if np.isfinite(point).all():
                _mark(axes, point, marker, size, colour, str(robot))
    _legend(axes, bool(routes), truth is not None)


def _mark(axes: Any, point: Float, marker: str, size: int, colour: str, text: str) -> None:
    style: dict[str, Any] = {"ha": "center", "va": "center_baseline", "fontsize": 5.5, "fontweight": "bold"}
    axes.plot(*point, marker, color=colour, markersize=size, markeredgecolor="white", markeredgewidth=0.8, zorder=8)
    axes.text(*point, text, color="white", zorder=9, **style)


def _legend(axes: Any, planned: bool, driven: bool) -> None:
    from matplotlib.lines import Line2D

    grey: dict[str, Any] = {"color": "#555555"}
    entries = [
        *([Line2D([], [], linestyle="--", linewidth=1.1, label="planned", **grey)] if planned else []),
        *([Line2D([], [], linewidth=1.6, label="driven", **grey)] if driven else []),
        Line2D([], [], linestyle="", marker="o", markersize=6, label="start", **grey),
        Line2D([], [], linestyle="", marker="*", markersize=9, label="goal", **grey),
    ]
    axes.legend(handles=entries, loc="lower right", bbox_to_anchor=(1, 1), ncols=4, frameon=False, borderpad=0)


def _names(figure: Any, axes: Any, named: dict[tuple[float, float], str], places: Float, *, faint: bool) -> None:
    """Names of places, each above, below or beside its vertex; one that fits nowhere is left out."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.patheffects import withStroke

    canvas: Any = FigureCanvasAgg(figure)
    renderer = canvas.get_renderer()
    axes.apply_aspect()  # settles where the axes are, on which positions in pixels depend
    dots = axes.transData.transform(places)
    taken = np.hstack([dots - _DOT, dots + _DOT])  # left, bottom, right, top in pixels
    size = 5.5 if len(named) <= CROWDED else 4.0
    inside = axes.get_window_extent(renderer)
    offsets = (
        (0, 5, "center", "bottom"),
        (0, -5, "center", "top"),
        (5, 0, "left", "center"),
        (-5, 0, "right", "center"),
    )
    for (x, y), name in named.items():
        for dx, dy, across, up in offsets:
            text = axes.annotate(
                name.replace("_", " "),
                (x, y),
                (dx, dy),
                textcoords="offset points",
                ha=across,
                va=up,
                fontsize=size,
                color=_NAME,
                alpha=0.75 if faint else 1.0,
                path_effects=[withStroke(linewidth=1.5, foreground="white")],
                zorder=10,
            )
            box = text.get_window_extent(renderer)
            left, bottom, right, top = box.x0, box.y0, box.x1, box.y1
            meets = (taken[:, 0] < right) & (taken[:, 2] > left) & (taken[:, 1] < top) & (taken[:, 3] > bottom)
            if not meets.any() and left >= inside.x0 - 20 and right <= inside.x1 + 20:
                taken = np.vstack([taken, (left, bottom, right, top)])
                break
            text.remove()
