"""Plots a level of a world, with the paths that robots planned and drove there."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.movers import Mover
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.world import World
from mrpbench_core.report.pictures.level import (
    lift_doors,
    plot_cabins,
    plot_cells,
    plot_doors,
    plot_lanes,
    plot_solids,
)
from mrpbench_core.report.pictures.movers import plot_movers
from mrpbench_core.report.pictures.names import plot_names
from mrpbench_core.report.pictures.paths import on_level, plot_paths
from mrpbench_core.report.pictures.sheet import bounds, layout, set_axes
from mrpbench_core.report.pictures.style import DOOR, DPI, LIFT, PIXELS, own_style


def plot_world(
    world: World,
    *,
    file: Path,
    roadmap: Roadmap | None = None,
    fleet: Fleet | None = None,
    routes: Sequence[Route] | None = None,
    truth: Float | None = None,
    bodies: Sequence[Mover] = (),
    movers: Float | None = None,
    level: int = 0,
    planned: bool = True,
    goals: bool = True,
) -> None:
    """Draw a level of `world` into a PNG of 1280 pixels width (or height, for a tall world).

    Args:
        world: walls, obstacles, lanes and the names of places.
        file: the PNG; its folder must exist.
        roadmap: if given, the cells of its raster are tinted.
        fleet: if given, robots are drawn at their starts in their true size.
        routes: planned paths, dashed, with the start as a circle and the goal as a star, which show the robot's number.
        truth: driven paths f8[T,n,3] in metres and radians, solid; NaN where unknown.
        bodies: people and other movers.
        movers: their poses f8[T,m,3] in metres and radians, NaN where they are not on the level.
        level: index of the level; only the parts of routes on it are drawn.
        planned: whether the routes are plans; otherwise only their starts and goals are drawn.
        goals: whether routes end at goals; they do not where tasks keep coming.

    Raises:
        InputError: matplotlib is missing, or the file cannot be written.
    """
    moving = routes is not None or truth is not None
    with own_style():
        figure, axes = world_figure(world, roadmap=roadmap, truth=truth, level=level, faint=moving)
        if moving:
            shown = [on_level(route, level) for route in routes or ()]
            plot_paths(axes, fleet, shown, truth, planned, goals, people=bool(bodies))
        if movers is not None:
            plot_movers(axes, bodies, movers)
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
    """Return a matplotlib figure of a level, and its axes in metres.

    Args:
        world: what is drawn.
        roadmap: if given, the cells of its raster are tinted.
        truth: paths f8[T,n,3] for which there is room; they are not drawn.
        level: index of the level.
        faint: whether names are lighter.
        pixels: width of the figure, or height of a tall one.
        shut: whether doors are drawn shut as well as open.

    Raises:
        InputError: matplotlib is missing.
    """
    with own_style():
        from matplotlib.figure import Figure

        low, high = bounds(world, truth, level)
        sheet, frame = layout(high - low)
        figure = Figure(figsize=sheet, dpi=DPI * pixels / PIXELS)
        axes = figure.add_axes(frame)
        set_axes(axes, _title(world, level), low, high)
        if roadmap is not None and level in roadmap.level:
            plot_cells(axes, roadmap)
        plot_solids(axes, world.levels[level])
        plot_cabins(axes, world, level)
        plot_doors(axes, world.levels[level].doors, DOOR, shut=shut)
        plot_doors(axes, lift_doors(world, level), LIFT, shut=shut)
        plot_lanes(axes, world, level)
        places = np.array([(v.x, v.y) for v in world.vertices if v.level == level]).reshape(-1, 2)
        plot_names(figure, axes, _labels(world, level), places, faint=faint)
    return figure, axes


def _title(world: World, level: int) -> str:
    return world.name if len(world.levels) == 1 else f"{world.name}, {world.levels[level].name}"


def _labels(world: World, level: int) -> dict[tuple[float, float], str]:
    """Names of places and lifts by position."""
    names = {(v.x, v.y): v.name or v.lift for v in world.vertices if v.level == level}
    return {position: name for position, name in names.items() if name}
