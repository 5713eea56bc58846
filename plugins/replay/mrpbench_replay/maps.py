"""Packs the maps that robots built, with fewer states if there are too many for a page."""

from typing import Any

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.store.recording import Recording
from mrpbench_replay.packing import Packing

TILES = 20_000
"""Largest number of tiles on a page; the last state of each tile is always kept."""
CHANNELS = frozenset({"map_time", "map_robot", "map_corner", "map_side", "map_cells"})


def pack_maps(recording: Recording, packing: Packing, tiles: int = TILES) -> dict[str, Any] | None:
    """Pack the tiles in the order of time: `map_corner` in cells, `map_cells` as 0 = unknown, 1 = free, 101 = occupied.

    Returns:
        `side` of a cell in metres, and `step`: seconds between the states that are kept, 0 = all; None without maps.
    """
    if not recording.channels.keys() >= CHANNELS:
        return None
    side = recording.channel("map_side")
    if not len(side):
        return None
    time, robot = recording.channel("map_time"), recording.channel("map_robot")
    place = np.rint(recording.channel("map_corner") / side[:, None]).astype(np.int64)
    chosen, step = _thinned(time, np.column_stack([robot, place]), tiles)
    packing.add_metres("map_time", time[chosen])
    packing.add("map_robot", robot[chosen])
    packing.add("map_corner", place[chosen])
    packing.add("map_cells", recording.channel("map_cells")[chosen].astype(np.int32) + 1)
    return {"side": float(side[0]), "step": step}


def _thinned(time: Float, place: Int, tiles: int) -> tuple[Int, float]:
    """The rows that are kept: of each place (robot, column, row), the last one in each `step` seconds."""
    chosen, step = np.arange(len(time)), 0.0
    while len(chosen) > tiles:
        step = 2 * step or 10.0
        keys = np.column_stack([place, np.floor(time / step).astype(np.int64)])[::-1]
        chosen = np.sort(len(time) - 1 - np.unique(keys, axis=0, return_index=True)[1])
        if step > time[-1]:
            break
    return chosen, step
