"""Cuts a stream of chunks into blocks of whole instants, so that chunk borders leave no trace in the bag.

A chunk may end between two things of one instant (a pose, then the scan taken at it). What is not older than the
newest periodic sample is therefore held back until the next chunk, which is at most one sampling period of data.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.runs.recording import PERIODIC, Chunk

AXES = {
    "time": (*PERIODIC, "facility", "mover", "mover_level", "mover_arrivals"),
    "scan_time": ("scan_robot", "scan_ranges"),
    "map_time": ("map_robot", "map_corner", "map_side", "map_cells"),
    "trajectory_time": ("trajectory_robot", "trajectory_chosen", "trajectory_cost", "trajectory_pose"),
    "contact_time": ("contact",),
    "event_time": ("event_kind", "event_robot", "event_detail"),
    "route_time": (
        "route_revision",
        "route_robot",
        "route_segment",
        "route_waypoint",
        "route_level",
        "route_speed",
        "route_edge",
        "route_leave",
    ),
}
"""Channels by the time axis they share."""


class Blocks:
    """Chunks that were pushed and not yet yielded."""

    def __init__(self, instants: int) -> None:
        """Blocks hold at most `instants` periodic samples."""
        self.instants = instants
        self.waiting: dict[str, Chunk] = {axis: {} for axis in AXES}

    def push(self, chunk: Chunk) -> Iterator[Chunk]:
        """Take in a chunk; yield blocks of what no later chunk can precede, with only those channels that have rows."""
        for axis, channels in AXES.items():
            rows = {name: chunk[name] for name in (axis, *channels) if name in chunk}
            if len(rows.get(axis, ())):
                before = self.waiting[axis]
                self.waiting[axis] = {n: _append(before[n], rows[n]) for n in rows} if before else rows
        times = self.waiting["time"].get("time")
        if times is not None:
            yield from self._cut(times, float(times[-1]))

    def finish(self) -> Iterator[Chunk]:
        """Yield the rest; the last block of a run."""
        yield from self._cut(self.waiting["time"].get("time", np.empty(0)), np.inf)

    def _cut(self, times: Float, until: float) -> Iterator[Chunk]:
        for edge in (*times[self.instants : -1 : self.instants], until):
            block: dict[str, NDArray[Any]] = {}
            for axis, rows in self.waiting.items():
                count = int(np.searchsorted(rows[axis], edge)) if rows else 0
                if count:
                    block |= {name: values[:count] for name, values in rows.items()}
                    self.waiting[axis] = {name: values[count:] for name, values in rows.items()}
            if block:
                yield block


def _append(before: NDArray[Any], after: NDArray[Any]) -> NDArray[Any]:
    """Rows after rows. Scans are as wide as the widest lidar among them, which differs from chunk to chunk."""
    if before.ndim == 2 and before.shape[1] != after.shape[1]:
        width = max(before.shape[1], after.shape[1])
        before, after = (
            np.pad(rows, ((0, 0), (0, width - rows.shape[1])), constant_values=np.nan) for rows in (before, after)
        )
    return np.concatenate([before, after])
