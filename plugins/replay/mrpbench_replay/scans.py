"""Packs the scans of a recording, thinned out if there are too many for a page."""

from collections.abc import Iterator

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int, Int32
from mrpbench_core.store.recording import Recording
from mrpbench_replay.packing import Packing

RANGES = 16_000_000
"""Largest number of ranges on a page; one scan per robot is always kept."""
BEAMS = 120
"""Smallest number of beams of a scan that are kept."""
QUANTUM = 0.01
"""Resolution in metres."""


def pack_scans(recording: Recording, packing: Packing, ranges: int = RANGES) -> dict[str, int] | None:
    """Pack the scans by robot, in the order of time; a range of 0 means that nothing was hit.

    Returns:
        `beam_step` and `scan_step`: one of so many beams and scans is kept; None if there are no scans.
    """
    if not {"scan_time", "scan_robot", "scan_ranges"} <= recording.channels.keys():
        return None
    times, robots = recording.channel("scan_time"), recording.channel("scan_robot").astype(np.int64)
    if not len(times):
        return None
    order = np.lexsort((times, robots))
    first = np.searchsorted(robots[order], np.arange(robots.max() + 2))
    turn = np.arange(len(order)) - first[robots[order]]
    beams = max(ranges.shape[1] for ranges in _parts(recording))  # chunks without long scans are narrower
    beam_step = max(1, min(beams // BEAMS, -(-len(order) * beams // ranges)))
    scan_step = max(1, -(-len(order) * -(-beams // beam_step) // ranges))
    chosen = order[turn % scan_step == 0]
    packing.add_metres("scan_time", times[chosen])
    packing.add("scan_robot", robots[chosen])
    packing.add("scan_ranges", _chosen(recording, chosen, beam_step, beams), QUANTUM)
    return {"beam_step": beam_step, "scan_step": scan_step}


def _chosen(recording: Recording, chosen: Int, beam_step: int, beams: int) -> Int32:
    """Read the chosen rows chunk by chunk, since the scans of a long run may not fit into memory."""
    rows = np.zeros((len(chosen), -(-beams // beam_step)), np.int32)
    place = np.argsort(chosen)
    wanted = chosen[place]
    done = 0
    for ranges in _parts(recording):
        low, high = np.searchsorted(wanted, [done, done + len(ranges)])
        steps = _steps(ranges[wanted[low:high] - done, ::beam_step])
        rows[place[low:high], : steps.shape[1]] = steps
        done += len(ranges)
    return rows


def _parts(recording: Recording) -> Iterator[Float]:
    return (chunk["scan_ranges"] for chunk in recording.chunks() if "scan_ranges" in chunk)


def _steps(ranges: Float) -> Int32:
    known = np.isfinite(ranges)
    steps = np.clip(np.rint(np.where(known, ranges, 0) / QUANTUM), 1, 65535)
    return np.where(known, steps, 0).astype(np.int32)
