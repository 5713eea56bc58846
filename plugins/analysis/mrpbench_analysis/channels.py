"""Estimates, odometry, commands and scans of a recording of any fleet, at the times of its positions."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_analysis.resampling import resample
from mrpbench_core.api.format import Observed, Signal, Track
from mrpbench_core.model.common.arrays import Float

SILENCE = 0.5
"""seconds after which a command no longer holds: the default time-out of ros2_control's diff_drive_controller."""
SAME = {"tf": "estimate", "amcl_pose": "estimate", "odometry": "odometry"}
"""The channel that equals the positions of a source."""

Found = tuple[dict[str, NDArray[Any]], tuple[frozenset[str], ...]]


def signal_channels(observed: Observed, time: Float, max_gap: float, notes: list[str]) -> Found:
    """Channels at `time` f8[T], and those that are no better than the positions.

    A channel is there if every robot has it without gaps in which the robot moved; scans if any robot has them. Why one
    is not there goes to `notes`.
    """
    names = [track.robot for track in observed.tracks]
    channels: dict[str, NDArray[Any]] = {}
    estimates = {track.robot: track for track in observed.estimates}
    if (poses := _poses("estimate", names, estimates, time, max_gap, notes)) is not None:
        channels["estimate"] = poses
    driven = _of(observed, "odometry")
    tracks = {name: _track(signal) for name, signal in driven.items()}
    if (poses := _poses("odometry", names, tracks, time, max_gap, notes)) is not None:
        twist = np.stack([_between(driven[name], time)[:, 3:] for name in names], axis=1)
        channels["odometry"] = np.concatenate([poses, twist], axis=-1)
    commands = _of(observed, "command")
    if _is_known_for_all("command", names, commands, notes):
        channels["command"] = np.stack([_held(commands[name], time) for name in names], axis=1)
    channels |= _scans([_of(observed, "scan_ranges").get(name) for name in names], time)
    same = {SAME[track.source] for track in observed.tracks if track.source in SAME}
    return channels, tuple(frozenset({"truth", channel}) for channel in sorted(same) if channel in channels)


def _of(observed: Observed, channel: str) -> dict[str, Signal]:
    return {signal.robot: signal for signal in observed.signals if signal.channel == channel}


def _is_known_for_all(channel: str, names: Sequence[str], known: Any, notes: list[str]) -> bool:
    lacking = [name for name in names if name not in known]
    if lacking and len(lacking) < len(names):
        notes.append(f"{', '.join(lacking)}: no {channel}, so the channel is not given")
    return not lacking


def _poses(
    channel: str, names: Sequence[str], tracks: dict[str, Track], time: Float, max_gap: float, notes: list[str]
) -> Float | None:
    """Poses f8[T,n,3], or None."""
    if not _is_known_for_all(channel, names, tracks, notes):
        return None
    resampled_tracks = [resample(tracks[name], time, max_gap) for name in names]
    gaps = [gap for resampled in resampled_tracks for gap in resampled.gaps]
    if gaps:
        notes.append(f"{channel} is not given: {gaps[0]}")
        return None
    return np.stack([resampled.pose for resampled in resampled_tracks], axis=1)


def _track(signal: Signal) -> Track:
    return Track(
        robot=signal.robot,
        source="odometry",
        topic=signal.topic,
        time=signal.time,
        pose=signal.rows[:, :3],
        height=np.full(len(signal.time), np.nan),
    )


def _between(signal: Signal, time: Float) -> Float:
    """Rows at `time`, straight between those that there are."""
    return np.stack([np.interp(time, signal.time, column) for column in signal.rows.T], axis=-1)


def _held(signal: Signal, time: Float) -> Float:
    """The newest row at `time`; zero before the first, and after a silence."""
    newest = np.searchsorted(signal.time, time + 1e-9, side="right") - 1
    valid = (newest >= 0) & (time - signal.time[newest] <= SILENCE)
    return np.where(valid[:, None], signal.rows[newest], 0.0)


def _scans(signals: Sequence[Signal | None], time: Float) -> dict[str, NDArray[Any]]:
    """Scans of all robots that have some, in order of time."""
    said = [(robot, signal) for robot, signal in enumerate(signals) if signal is not None]
    if not said:
        return {}
    stamps = np.concatenate([signal.time for _, signal in said])
    robots = np.concatenate([np.full(len(signal.time), robot, "i4") for robot, signal in said])
    ranges = np.full((len(stamps), max(signal.rows.shape[1] for _, signal in said)), np.nan, "f4")
    first = 0
    for _, signal in said:
        ranges[first : first + len(signal.rows), : signal.rows.shape[1]] = signal.rows
        first += len(signal.rows)
    order = np.argsort(stamps, kind="stable")
    order = order[(stamps[order] >= time[0]) & (stamps[order] <= time[-1])]
    return {"scan_time": stamps[order] - time[0], "scan_robot": robots[order], "scan_ranges": ranges[order]}
