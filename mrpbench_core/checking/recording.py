"""Validates a recording; `mrpbench_core.model.runs.recording` says what its channels mean."""

from collections.abc import Collection, Iterator, Mapping
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.runs.recording import PERIODIC

ROBOTS, ANY, MOVERS = -1, -2, -3
"""Sizes of rows that depend on the fleet, on something else, or on the crowds."""


@attrs.frozen
class Layout:
    """How the rows of a channel are stored."""

    kinds: str
    """Kinds of NumPy types: f, i, u, U."""
    axis: str
    """The channel with the time of each row."""
    row: tuple[int, ...] = ()
    """Shape of a row."""


_FLOAT = {"truth": 3, "truth_twist": 2, "estimate": 3, "odometry": 5, "command": 2}
"""Numbers for each robot and sample; other periodic channels have one."""
_SCALARS = {
    "contact": {"f": "force"},
    "scan": {"iu": "robot"},
    "trajectory": {"iu": "robot chosen", "f": "cost"},
    "critic": {"iu": "robot", "U": "name", "f": "score"},
    "route": {"iu": "revision robot segment level edge leave", "f": "speed"},
    "errand": {"iu": "task number level", "f": "service deadline", "i": "priority"},
    "task": {"i": "index robot errand", "U": "event"},
    "event": {"U": "kind detail", "i": "robot"},
    "map": {"iu": "robot", "f": "side"},
}
"""Channels with one number or text for each row, by the first part of their names and the kinds of their types."""
LAYOUTS: Mapping[str, Layout] = {
    "time": Layout("f", "time"),
    **{name: Layout("f", "time", (ROBOTS, width)) for name, width in _FLOAT.items()},
    **{name: Layout("iu", "time", (ROBOTS,)) for name in PERIODIC if name not in _FLOAT},
    "speed_limit": Layout("f", "time", (ROBOTS,)),
    "facility": Layout("f", "time", (ANY,)),
    "mover": Layout("f", "time", (MOVERS, 5)),
    "mover_level": Layout("iu", "time", (MOVERS,)),
    "mover_arrivals": Layout("i", "time", (MOVERS,)),
    **{f"{axis}_time": Layout("f", f"{axis}_time") for axis in _SCALARS},
    **{
        f"{axis}_{name}": Layout(kinds, f"{axis}_time")
        for axis, columns in _SCALARS.items()
        for kinds, names in columns.items()
        for name in names.split()
    },
    "contact": Layout("i", "contact_time", (2,)),
    "scan_ranges": Layout("f", "scan_time", (ANY,)),
    "trajectory_pose": Layout("f", "trajectory_time", (ANY, 3)),
    "route_waypoint": Layout("f", "route_time", (3,)),
    "errand_goal": Layout("f", "errand_time", (3,)),
    "map_corner": Layout("f", "map_time", (2,)),
    "map_cells": Layout("i", "map_time", (ANY, ANY)),
    "draw": Layout("iu", "draw"),
    **{f"draw_{name}": Layout("f", "draw", (ROBOTS,)) for name in ("arrival", "waiting")},
}
_LEAST_ROBOT = {
    **dict.fromkeys(("scan_robot", "route_robot", "trajectory_robot", "critic_robot", "map_robot"), 0),
    **dict.fromkeys(("event_robot", "task_robot"), -1),
}
"""The least index in channels that name robots; -1 = none."""
OPTIONAL = frozenset({"route_segment", "route_edge", "route_leave", "errand_number", "contact_force"})
"""Channels that older recordings lack beside the others with their time axis."""
LARGEST = 1e9
"""Bound of positions (metres), angles, speeds and times (seconds)."""
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
    faults = check_names(channels) if "time" in channels else ["has no channel time"]
    movers = len(channels["mover"][0]) if "mover" in channels and len(channels["mover"]) else 0
    if not faults:
        faults = [
            fault
            for name, rows in channels.items()
            if (fault := check_channel(name, rows, channels[axis_of(name)], len(fleet), movers)) is not None
        ]
    if not faults:
        faults += [*_finite(channels), *_order(channels)]
    if not faults:
        faults += _jumps(channels, fleet)
    return faults


def check_names(names: Collection[str]) -> list[str]:
    """Name the channels that lack others which belong to them."""
    axes = {layout.axis for name, layout in LAYOUTS.items() if name in names}
    return [
        f"has no channel {name}"
        for name, layout in LAYOUTS.items()
        if layout.axis in axes - {"time"} and name not in names and name not in OPTIONAL
    ]


def axis_of(name: str) -> str:
    """Return the channel with the time of each row of a channel; of an unknown channel, itself."""
    return LAYOUTS[name].axis if name in LAYOUTS else name


def check_channel(name: str, rows: NDArray[Any], time: NDArray[Any], robots: int, movers: int = 0) -> str | None:
    """Return what is wrong with the type, shape or numbers of a channel, as a sentence, or None.

    Args:
        name: of the channel; nothing is known of others than those of `LAYOUTS`.
        rows: the channel.
        time: the channel `axis_of(name)`.
        robots: number of robots.
        movers: number of movers.
    """
    layout = LAYOUTS.get(name)
    if layout is None:
        return None
    sizes = {ROBOTS: robots, MOVERS: movers}
    wanted = (len(time), *(sizes.get(size, size) for size in layout.row)) if time.ndim else ()
    if rows.dtype.kind not in layout.kinds or (rows.dtype.kind != "U" and rows.dtype.itemsize > 8):
        return f"{name} has the type {rows.dtype}"
    if rows.ndim != len(wanted) or any(b not in (a, ANY) for a, b in zip(rows.shape, wanted, strict=True)):
        return f"{name} has shape {rows.shape} instead of {wanted}"
    if name == layout.axis:
        return _axis(name, rows)
    if name == "contact":
        one, other = rows[:, 0], rows[:, 1]
        if ((one < 0) | (one >= robots) | (other < -1) | (other >= robots + movers) | (one == other)).any():
            return "contact names a robot that does not exist, or a robot touching itself"
    least = _LEAST_ROBOT.get(name)
    if least is not None and ((rows < least) | (rows >= robots)).any():
        return f"{name} names a robot that does not exist"
    if name in ("released", "reached", "cleared", "level", "route_level", "route_revision") and (rows < 0).any():
        return f"{name} is negative"
    if name in ("speed_limit", "map_side") and not (rows > 0).all():
        return f"{name} is not above 0"
    if name in (*_FLOAT, "facility", "mover", "route_waypoint") and (np.abs(rows) > LARGEST).any():
        return f"{name} is not finite"
    return _of_trajectories_or_maps(name, rows)


def _of_trajectories_or_maps(name: str, rows: NDArray[Any]) -> str | None:
    """What is wrong with the numbers of a channel of trajectories or maps."""
    if name == "trajectory_pose" and not rows.shape[1]:
        return "trajectory_pose has no poses"
    if name == "trajectory_chosen" and (rows > 1).any() | (rows < 0).any():
        return "trajectory_chosen is neither 0 nor 1"
    if name == "trajectory_cost" and (rows == -np.inf).any():
        return "trajectory_cost is -inf"
    if name == "critic_score" and not np.isfinite(rows).all():
        return "critic_score is not finite"
    if name in ("trajectory_pose", "map_corner", "map_side") and not (np.abs(rows) <= LARGEST).all():
        return f"{name} is not finite"
    return None


def _axis(name: str, values: NDArray[Any]) -> str | None:
    if not (np.abs(values) <= LARGEST).all():
        return f"{name} is not finite"
    late = np.diff(values) <= 0 if name == "time" else np.diff(values) < 0
    if late.any():
        verb = "does not increase" if name == "time" else "decreases"
        return f"{name} {verb} after {values[int(late.argmax())]:g} s"
    return None


def _finite(channels: Channels) -> Iterator[str]:
    for name in _FLOAT:
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
