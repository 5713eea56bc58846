"""Planned and driven paths in a picture."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.route import Route
from mrpbench_core.report.pictures.style import COLOURS, PERSON


def on_level(route: Route, level: int) -> Float:
    """Waypoints f8[k,2] of a route in metres, NaN on other levels."""
    there: Float = np.where((route.level == level)[:, None], route.waypoint[:, :2], np.nan)
    return there


def plot_paths(
    axes: Any,
    fleet: Fleet | None,
    routes: Sequence[Float],
    truth: Float | None,
    planned: bool = True,
    goals: bool = True,
    people: bool = False,
) -> None:
    """Draw for each robot the planned path dashed, the driven path solid, its start as a circle and its goal as a star.

    Positions on other levels are NaN. Where no plan is known (`planned` is false), routes give start and goal only.
    Without `goals`, as where tasks keep coming, no stars are drawn. `people` adds them to the legend.
    """
    from matplotlib.patches import Circle

    robots = len(routes) if routes else (0 if truth is None else truth.shape[1])
    width = 1.6 if robots <= 20 else 0.9
    for robot in range(robots):
        colour = COLOURS[robot % len(COLOURS)]
        route = routes[robot] if routes else np.empty((0, 2))
        driven = np.empty((0, 2)) if truth is None else truth[:, robot, :2]
        if len(route) and planned:
            axes.plot(*route.T, "--", color=colour, linewidth=0.7 * width, alpha=0.7, zorder=6, dash_capstyle="round")
        if len(driven):
            axes.plot(*driven.T, "-", color=colour, linewidth=width, zorder=7, solid_joinstyle="round")
        start, goal = (route if len(route) else driven)[[0, -1]]
        if fleet is not None and np.isfinite(start).all():
            axes.add_patch(Circle(start, fleet.robots[robot].radius, facecolor=colour, alpha=0.25, zorder=7))
        for point, marker, size in ((start, "o", 9), (goal, "*", 15))[: 2 if goals else 1]:
            if np.isfinite(point).all():
                _mark(axes, point, marker, size, colour, str(robot))
    _legend(axes, bool(routes) and planned, truth is not None, goals, people)


def _mark(axes: Any, point: Float, marker: str, size: int, colour: str, text: str) -> None:
    style: dict[str, Any] = {"ha": "center", "va": "center_baseline", "fontsize": 5.5, "fontweight": "bold"}
    axes.plot(*point, marker, color=colour, markersize=size, markeredgecolor="white", markeredgewidth=0.8, zorder=8)
    axes.text(*point, text, color="white", zorder=9, **style)


def _legend(axes: Any, planned: bool, driven: bool, goals: bool, people: bool) -> None:
    from matplotlib.lines import Line2D

    grey: dict[str, Any] = {"color": "#555555"}
    person: dict[str, Any] = {"color": PERSON, "linewidth": 0.6, "marker": "o", "markersize": 6}
    entries = [
        *([Line2D([], [], linestyle="--", linewidth=1.1, label="planned", **grey)] if planned else []),
        *([Line2D([], [], linewidth=1.6, label="driven", **grey)] if driven else []),
        Line2D([], [], linestyle="", marker="o", markersize=6, label="start", **grey),
        *([Line2D([], [], linestyle="", marker="*", markersize=9, label="goal", **grey)] if goals else []),
        *([Line2D([], [], label="people", markerfacecolor="white", **person)] if people else []),
    ]
    axes.legend(
        handles=entries, loc="lower left", bbox_to_anchor=(0, 1), ncols=len(entries), frameon=False, borderpad=0
    )
