"""Packs the trajectories that controllers weighed, thinned out if there are too many for a page."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.store.recording import Recording
from mrpbench_replay.packing import Packing

TRAJECTORIES = 100_000
"""Largest number of trajectories on a page."""
QUANTUM = 0.005
"""Resolution in metres."""
REFUSED, UNKNOWN, RANKS = 255, 254, 250
"""How costs are packed: ranks among the samples of a moment, from 0 to `RANKS`, or one of these."""


def pack_trajectories(recording: Recording, packing: Packing, most: int = TRAJECTORIES) -> dict[str, Any] | None:
    """Pack the trajectories by robot and moment, in the order of time, with the ranks of their costs.

    Returns:
        `step`: one of so many moments is kept; `critics`: names by index; None if there are no trajectories.
    """
    if "trajectory_time" not in recording.channels or not len(times := recording.channel("trajectory_time")):
        return None
    robots = recording.channel("trajectory_robot").astype(np.int64)
    order = np.lexsort((times, robots))  # stable: within a moment the chosen one stays first
    new = np.append(True, (np.diff(times[order]) != 0) | (np.diff(robots[order]) != 0))
    moment = np.cumsum(new) - 1
    step = -(-len(order) // most)
    sampled = moment % step == 0
    rows, first = order[sampled], new[sampled].nonzero()[0]
    size = np.diff(np.append(first, len(rows)))
    packing.add_metres("trajectory_time", times[rows][first])
    packing.add("trajectory_robot", robots[rows][first])
    packing.add("trajectory_first", np.append(first, len(rows)))
    packing.add("trajectory_chosen", recording.channel("trajectory_chosen")[rows])
    cost = recording.channel("trajectory_cost")[rows]
    packing.add("trajectory_rank", np.concatenate([_ranks(each) for each in np.split(cost, np.cumsum(size)[:-1])]))
    pose = _chosen(recording, rows)
    for index, axis in enumerate("xy"):
        packing.add_metres(f"trajectory_{axis}", pose[..., index], QUANTUM)
    return {"step": step, "critics": _pack_critics(recording, packing)}


def _ranks(cost: Float) -> Int:
    """Ranks of the finite costs of a moment, equal for equal costs."""
    ranks = np.where(np.isnan(cost), UNKNOWN, REFUSED)
    finite = np.isfinite(cost)
    values, place = np.unique(cost[finite], return_inverse=True)
    ranks[finite] = np.rint(place * RANKS / max(len(values) - 1, 1))
    return ranks


def _chosen(recording: Recording, rows: Int) -> Float:
    """Read the poses of chosen rows chunk by chunk; chunks with fewer poses repeat the last one."""
    width = max(part.shape[1] for part in _parts(recording))
    poses = np.zeros((len(rows), width, 3))
    place = np.argsort(rows)
    wanted, done = rows[place], 0
    for part in _parts(recording):
        low, high = np.searchsorted(wanted, [done, done + len(part)])
        trajectories = part[wanted[low:high] - done]
        poses[place[low:high]] = trajectories[:, np.minimum(np.arange(width), part.shape[1] - 1)]
        done += len(part)
    return poses


def _parts(recording: Recording) -> Iterator[Float]:
    return (chunk["trajectory_pose"] for chunk in recording.chunks() if "trajectory_pose" in chunk)


def _pack_critics(recording: Recording, packing: Packing) -> list[str]:
    """Pack the scores by robot, in the order of time; return the names of critics."""
    if "critic_time" not in recording.channels or not len(times := recording.channel("critic_time")):
        return []
    robots = recording.channel("critic_robot").astype(np.int64)
    order = np.lexsort((times, robots))
    names = recording.channel("critic_name")
    _, first, index = np.unique(names, return_index=True, return_inverse=True)
    place = np.argsort(first)  # names as they come, which is the order of the critics
    packing.add_metres("critic_time", times[order])
    packing.add("critic_robot", robots[order])
    packing.add("critic_name", np.argsort(place)[index][order])
    packing.add_metres("critic_score", recording.channel("critic_score")[order], 1e-4)
    return [str(name) for name in names[first[place]]]
