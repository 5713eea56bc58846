"""Reads events, contacts and arrivals of a recording."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.runs.plans import RecordedPlan
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.runs.switches import switches
from mrpbench_core.store.recording import Recording
from mrpbench_replay.facility_events import read_facility_events

PAUSE = 0.5
"""Seconds without touching after which another contact of the same two robots begins."""


def read_events(recording: Recording, context: RunContext, plans: Sequence[RecordedPlan]) -> list[list[Any]]:
    """Return events, motions of doors and lifts, switches and arrivals as [seconds, kind, robot, detail], by time."""
    events: list[list[Any]] = []
    names = ("event_time", "event_kind", "event_robot", "event_detail")
    if set(names) <= recording.channels.keys():
        times, kinds, robots, details = (recording.channel(name).tolist() for name in names)
        rows = zip(times, kinds, robots, details, strict=True)
        events += [[round(time, 3), *rest] for time, *rest in rows if rest[0] != "contact"]  # see `read_contacts`
    events += read_facility_events(recording, context.world)
    if "reached" in recording.channels:
        events += _arrivals(recording.channel("time"), recording.channel("reached"), context)
        events += _switches(recording, context, plans)
    return sorted(events, key=lambda event: (event[0], event[2]))


def _switches(recording: Recording, context: RunContext, plans: Sequence[RecordedPlan]) -> list[list[Any]]:
    time, reached, names = recording.channel("time"), recording.channel("reached"), context.fleet.names
    if any(len(plan.routes) != reached.shape[1] for plan in plans):
        return []
    changes = switches(context.problem, plans, time, reached)
    return [
        [round(when, 3), "switch", robot, f"passed {names[other]}, which is first in the plan"]
        for when, robot, other in changes
    ]


def _arrivals(times: Float, reached: Int, context: RunContext) -> list[list[Any]]:
    last_move = np.array([route.last_move for route in context.routes])
    if reached.shape[1:] != last_move.shape:
        return []
    done = reached >= last_move
    when = times[done.argmax(axis=0)]
    moved = np.flatnonzero(done.any(axis=0) & (last_move > 0))
    return [[round(float(when[robot]), 3), "arrived", int(robot), ""] for robot in moved]


def read_contacts(recording: Recording) -> list[list[Any]]:
    """Return contacts as [first second, last second, robot, other robot or -1], in the order of time."""
    if not {"contact_time", "contact"} <= recording.channels.keys():
        return []
    times, pairs = recording.channel("contact_time"), recording.channel("contact")
    if not len(times):
        return []
    order = np.lexsort((times, pairs[:, 1], pairs[:, 0]))
    times, pairs = times[order], pairs[order]
    fresh = np.r_[True, (pairs[1:] != pairs[:-1]).any(axis=1) | (np.diff(times) > PAUSE)]
    first = np.flatnonzero(fresh)
    last = np.r_[first[1:], len(times)] - 1
    spans = zip(times[first].tolist(), times[last].tolist(), pairs[first].tolist(), strict=True)
    return sorted([round(begin, 3), round(end, 3), *pair] for begin, end, pair in spans)
