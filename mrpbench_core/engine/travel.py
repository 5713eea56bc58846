"""Shortest travel times on a roadmap, many targets at once.

Dial, "Algorithm 360: Shortest-path forest with topological ordering", Communications of the ACM 1969: since durations
are whole ticks, vertices are settled bucket by bucket, here for several searches together and a bucket as one array.
"""

import heapq
from collections import defaultdict
from collections.abc import Iterable, Sequence

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.planning.roadmap import Roadmap

STATES = 2**24
"""Pairs of target and vertex searched at once: bounds memory to some 300 MB."""


def travel_ticks(roadmap: Roadmap, profile: int, targets: Sequence[int], sources: Sequence[int]) -> Float:
    """Ticks f8[targets,sources] that a robot of a motion profile, alone, takes from each source to each target.

    inf = no path.
    """
    together = max(1, STATES // max(1, len(roadmap.position)))
    ticks = np.empty((len(targets), len(sources)))
    for begin in range(0, len(targets), together):
        batch = np.asarray(targets[begin : begin + together], np.int64)
        ticks[begin : begin + len(batch)] = _search(roadmap, profile, batch)[:, np.asarray(sources, np.int64)]
    return ticks


def through(first: Float, legs: Iterable[Float]) -> Float:
    """Least sums f8[a,z] of ways that pass one place of each set, in order.

    Args:
        first: f8[a,p] from some places to those of the first set.
        legs: f8[p,q] from the places of each set to those of the next; the last set has z.
    """
    for leg in legs:
        first = (first[:, :, None] + leg[None]).min(axis=1)
    return first


def _search(roadmap: Roadmap, profile: int, targets: Int) -> Float:
    """Ticks f8[targets,V] to each target, searched backward."""
    count = len(roadmap.position)
    duration = roadmap.duration[profile].astype(np.int64)
    usable = np.flatnonzero(duration >= 0)
    order = usable[np.argsort(roadmap.edges[usable, 1], kind="stable")]
    first = np.searchsorted(roadmap.edges[order, 1], np.arange(count + 1))
    tail, spent = roadmap.edges[order, 0].astype(np.int64), duration[order]
    ticks = np.full(len(targets) * count, np.inf)
    start = np.arange(len(targets)) * count + targets
    ticks[start] = 0
    buckets: dict[int, list[Int]] = defaultdict(list, {0: [start]})
    times = [0]
    while times:
        now = heapq.heappop(times)
        states = np.sort(np.concatenate(buckets.pop(now)))
        states = states[(ticks[states] == now) & np.append(True, states[1:] != states[:-1])]
        vertex = states % count
        degree = first[vertex + 1] - first[vertex]
        edge = np.repeat(first[vertex] - np.cumsum(degree) + degree, degree) + np.arange(degree.sum())
        before = np.repeat(states - vertex, degree) + tail[edge]
        arrival = now + spent[edge]
        sooner = arrival < ticks[before]
        before, arrival = before[sooner], arrival[sooner]
        order = np.argsort(arrival, kind="stable")
        groups = np.split(order, np.flatnonzero(np.diff(arrival[order])) + 1) if len(order) else []
        for alike in reversed(groups):  # latest first, so that the soonest arrival is the one that remains
            time = int(arrival[alike[0]])
            ticks[before[alike]] = time
            if time not in buckets:
                heapq.heappush(times, time)
            buckets[time].append(before[alike])
    return ticks.reshape(len(targets), count)
