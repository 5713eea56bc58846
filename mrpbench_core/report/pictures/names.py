"""Names of places in a picture."""

from typing import Any

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.report.pictures.style import NAME

CROWDED = 100
"""Number of names beyond which they are smaller."""
DOT = 3
"""Pixels around a place that no name covers."""


def plot_names(figure: Any, axes: Any, named: dict[tuple[float, float], str], places: Float, *, faint: bool) -> None:
    """Write each name above, below, right or left of its place; leave out a name that fits nowhere.

    Args:
        figure: of matplotlib.
        axes: of the map, in metres.
        named: names by position in metres.
        places: f8[k,2] metres, which no name covers.
        faint: whether the names are lighter.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.patheffects import withStroke

    canvas: Any = FigureCanvasAgg(figure)
    renderer = canvas.get_renderer()
    axes.apply_aspect()  # settles where the axes are, on which positions in pixels depend
    dots = axes.transData.transform(places)
    taken = np.hstack([dots - DOT, dots + DOT])  # left, bottom, right, top in pixels
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
                color=NAME,
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
