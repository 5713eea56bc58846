"""The sheet of a picture: its size, margins and axes."""

from typing import Any

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.worlds.doors import swept_areas
from mrpbench_core.model.worlds.solids import segments
from mrpbench_core.model.worlds.world import World
from mrpbench_core.report.pictures.style import DPI, NAME, PIXELS

MARGINS = (84, 20, 60, 70)
"""Left, right, bottom, top, pixels."""
LEAST = (590, 250)
"""Pixels of width and height; the width holds the legend."""
TITLE = 16
"""Points between map and title, where the legend is."""


def bounds(world: World, truth: Float | None, level: int) -> tuple[Float, Float]:
    """Return the lower left and upper right corner, metres, of everything on the level and of the paths `truth`."""
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


def layout(size: Float) -> tuple[tuple[float, float], tuple[float, float, float, float]]:
    """Return width and height of the sheet in inches, and left, bottom, width, height of the map as shares of it."""
    left, right, bottom, top = MARGINS
    room = np.array([PIXELS - left - right, PIXELS - bottom - top])
    width, height = np.maximum(size * (room / size).min(), LEAST).tolist()
    across, up = width + left + right, height + bottom + top
    return (across / DPI, up / DPI), (left / across, bottom / up, width / across, height / up)


def set_axes(axes: Any, title: str, low: Float, high: Float) -> None:
    """Set scale, labels and title of the map from corner `low` to corner `high`, metres."""
    axes.set_aspect("equal", anchor="W")
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_xlabel("x [m]", color=NAME)
    axes.set_ylabel("y [m]", color=NAME)
    axes.set_title(title, fontsize=9, loc="left", color=NAME, pad=TITLE)
    axes.tick_params(length=2, color=NAME, labelcolor=NAME)
    for spine in axes.spines.values():
        spine.set_visible(False)
