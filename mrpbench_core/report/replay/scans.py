"""Scans of a recording, thinned to what a page can carry."""

from typing import Any

import numpy as np

from mrpbench_core.model.arrays import Float, Int
from mrpbench_core.report.replay.packing import Packing
from mrpbench_core.store.recording import Recording

RANGES = 16_000_000
"""Ranges a page carries at most, but for one scan of each robot."""
BEAMS = 120
"""Beams of a scan that are kept at least."""
QUANTUM = 0.01
"""metres."""


def pack_scans(recording: Recording, packing: Packing, ranges: int = RANGES) -> dict[str, int] | None:
    """Pack the scans by robot, in the order of time; a range of 0 means that nothing was hit.

    Returns:
        `beam_step` and `scan_step`: of how many beams and scans one was kept; None if there are no scans.
    """
    if not {"scan_time", "scan_robot", "scan_ranges"} <= recording.channels.keys():
        return None
    times, robots = recording.channel("scan_time"), recording.channel("scan_robot").astype(np.int64)
    if not len(times):
        return None
    order = np.lexsort((times, robots))
    first = np.searchsorted(robots[order], np.arange(robots.max() + 2))
    turn = np.arange(len(order)) - first[robots[order]]
    beams = next(chunk["scan_ranges"].shape[1] for chunk in recording.chunks() if "scan_ranges" in chunk)
    beam_step = max(1, min(beams // BEAMS, -(-len(order) * beams // ranges)))
    scan_step = max(1, -(-len(order) * -(-beams // beam_step) // ranges))
    chosen = order[turn % scan_step == 0]
    packing.add_metres("scan_time", times[chosen])
    packing.add("scan_robot", robots[chosen])
    packing.add("scan_ranges", _chosen(recording, chosen, beam_step), QUANTUM)
    return {"beam_step": beam_step, "scan_step": scan_step}


def _chosen(recording: Recording, chosen: Int, beam_step: int) -> Any:
    """The chosen rows, chunk by chunk: all scans of a long run may not fit into memory."""
    rows = np.empty(0)
    place = np.argsort(chosen)
    wanted = chosen[place]
    done = 0
    for chunk in recording.chunks():
        if "scan_ranges" not in chunk:
            continue
        part = chunk["scan_ranges"][:, ::beam_step]
        if not rows.size:
            rows = np.zeros((len(chosen), part.shape[1]), np.int32)
        low, high = np.searchsorted(wanted, [done, done + len(part)])
        rows[place[low:high], : part.shape[1]] = _steps(part[wanted[low:high] - done])
        done += len(part)
    return rows


def _steps(ranges: Float) -> Any:
    known = np.isfinite(ranges)
    return np.where(known, np.clip(np.rint(np.where(known, ranges, 0) / QUANTUM), 1, 65535), 0).astype(np.int32)
