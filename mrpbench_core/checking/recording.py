"""Validates a recording; `mrpbench_core.model.runs.recording` says what its channels mean."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.runs.recording import PERIODIC

WIDTH = {"truth": 3, "truth_twist": 2, "estimate": 3, "odometry": 5, "command": 2}
"""Numbers for each robot and sample; other periodic channels have one."""
TIMES = {
    "contact_time": ("contact",),
    "scan_time": ("scan_robot", "scan_ranges"),
    "route_time": ("route_revision", "route_robot", "route_waypoint", "route_level", "route_speed"),
    "event_time": ("event_kind", "event_robot", "event_detail"),
}
"""Channels with a time axis of their own."""
SLACK = 1.5
"""Factor by which a robot may exceed its speed limit: physics pushes robots, and drops them into place."""
NUDGE = 0.02
"""Metres that a robot may always move between two samples."""

Channels = Mapping[str, NDArray[Any]]


def check_recording(channels: Channels, fleet: Fleet) -> list[str]:
    """The faults of a recording, one sentence each; at most one for each robot, channel and rule.

    In a valid recording, times increase and shapes match the fleet; poses and commands are finite; `released`,
    `reached` and `cleared` never decrease; a robot reaches only segments that are released, and clears the start of a
    segment only after it has reached that vertex; no robot moves faster than its speed limit allows.
    """
    if "time" not in channels:
        return ["has no channel time"]
    faults = [*_shapes(channels, len(fleet)), *_axes(channels)]
    if not faults:
        faults += [*_finite(channels), *_order(channels), *_indices(channels, len(fleet))]
    if not faults:
        faults += _jumps(channels, fleet)
    return faults


def _shapes(channels: Channels, robots: int) -> Iterator[str]:
    samples = len(channels["time"])
    for name in PERIODIC:
        width = (WIDTH[name],) if name in WIDTH else ()
        if name in channels and channels[name].shape != (samples, robots, *width):
            yield f"{name} has shape {channels[name].shape} instead of {(samples, robots, *width)}"
    for time, companions in TIMES.items():
        for name in companions:
            if (name in channels) != (time in channels):
                yield f"has {name if name in channels else time} without {time if name in channels else name}"
            elif name in channels and len(channels[name]) != len(channels[time]):
                yield f"{name} has {len(channels[name])} rows instead of {len(channels[time])}"


def _axes(channels: Channels) -> Iterator[str]:
    for name in ("time", *TIMES):
        values = channels.get(name, np.empty(0))
        if not np.isfinite(values).all():
            yield f"{name} is not finite"
        elif name == "time" and (np.diff(values) <= 0).any():
            yield f"time does not increase after {values[int((np.diff(values) <= 0).argmax())]:g} s"
        elif (np.diff(values) < 0).any():
            yield f"{name} decreases after {values[int((np.diff(values) < 0).argmax())]:g} s"


def _finite(channels: Channels) -> Iterator[str]:
    for name in WIDTH:
        if name in channels:
            bad = np.logical_not(np.isfinite(channels[name]).all(axis=2))
            yield from _first(bad, channels["time"], f"robot {{robot}} has no finite {name} at {{time:g}} s")


def _order(channels: Channels) -> Iterator[str]:
    time = channels["time"]
    for name in ("released", "reached", "cleared"):
        if name in channels:
            yield from _first(
                np.diff(channels[name], axis=0) < 0, time[1:], f"robot {{robot}}: {name} decreases at {{time:g}} s"
            )
    if "released" in channels and "reached" in channels:
        early = channels["reached"] > channels["released"]
        yield from _first(early, time, "robot {robot} reached a segment at {time:g} s that was not released")
    if "reached" in channels and "cleared" in channels:
        early = channels["cleared"] > channels["reached"] + 1
        yield from _first(early, time, "robot {robot} cleared a segment at {time:g} s that it had not reached")


def _indices(channels: Channels, robots: int) -> Iterator[str]:
    if "contact" in channels:
        contact = channels["contact"].reshape(-1, 2)
        one, other = contact[:, 0], contact[:, 1]
        if ((one < 0) | (one >= robots) | (other < -1) | (other >= robots) | (one == other)).any():
            yield "contact names a robot that does not exist, or a robot touching itself"
    for name, least in (("scan_robot", 0), ("event_robot", -1), ("route_robot", 0)):
        values = channels.get(name, np.empty(0))
        if ((values < least) | (values >= robots)).any():
            yield f"{name} names a robot that does not exist"


def _jumps(channels: Channels, fleet: Fleet) -> Iterator[str]:
    if "truth" not in channels:
        return
    time, truth = channels["time"], channels["truth"]
    moved = np.hypot(*np.moveaxis(np.diff(truth[..., :2], axis=0), -1, 0))
    limit = np.array([robot.max_speed for robot in fleet.robots])
    far = moved > SLACK * np.diff(time)[:, None] * limit + NUDGE
    yield from _first(far, time[1:], "robot {robot} moves at {time:g} s faster than its speed limit allows")


def _first(bad: NDArray[np.bool_], time: NDArray[Any], sentence: str) -> Iterator[str]:
    """The first bad sample of each robot, in words."""
    for robot in np.flatnonzero(bad.any(axis=0)).tolist():
        yield sentence.format(robot=robot, time=time[int(bad[:, robot].argmax())])
