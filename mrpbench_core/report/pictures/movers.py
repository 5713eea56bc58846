"""People and other movers in a picture."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.execution.movers import Mover
from mrpbench_core.report.pictures.style import PERSON
from mrpbench_core.store.recording import Recording


def read_movers(recording: Recording, level: int) -> Float:
    """Return poses f8[T,m,3] of all movers in metres and radians, NaN where they are not on the level."""
    if "mover" not in recording.channels:
        return np.empty((len(recording.channel("time")) if "time" in recording.channels else 0, 0, 3))
    here = recording.channel("mover_level") == level
    return np.where(here[..., None], recording.channel("mover")[..., :3], np.nan)


def plot_movers(axes: Any, bodies: Sequence[Mover], poses: Float) -> None:
    """Draw where people and other movers went, poses f8[T,m,3], NaN elsewhere, and their bodies where they end."""
    from matplotlib.collections import LineCollection, PatchCollection
    from matplotlib.patches import Circle

    ways = list(poses[..., :2].swapaxes(0, 1))
    axes.add_collection(LineCollection(ways, colors=PERSON, linewidths=0.6, alpha=0.6, zorder=5.5))
    ends = [(way[np.isfinite(way[:, 0])], body.radius) for way, body in zip(ways, bodies, strict=True)]
    discs = [Circle(way[-1], radius) for way, radius in ends if len(way)]
    axes.add_collection(PatchCollection(discs, facecolor="white", edgecolor=PERSON, linewidth=1.0, zorder=5.6))
