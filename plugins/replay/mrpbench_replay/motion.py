"""Packs the motion of robots for the page: one row per robot, one column per sample."""

import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.store.recording import Recording
from mrpbench_replay.packing import Packing

ANGLE = 0.001
"""Resolution in radians."""
ASTRAY = 0.02
"""Metres; estimates that never differ from the truth by more are not packed."""
COUNTS = {"reached": None, "released": None, "mode": None, "level": 0}
"""Channels of integers, and a value without information: a channel with this value only is not packed."""


def read_poses(recording: Recording) -> tuple[Float, Float]:
    """Return times f8[T] and poses f8[T,n,3] in metres and radians: the truth, or the estimates if there is none.

    Raises:
        InputError: the recording holds no samples.
    """
    name = recording.pose_channel
    if name is None:
        raise InputError("the recording holds no poses", hint="a run that ended before its execution cannot be shown")
    return recording.channel("time"), recording.channel(name)


def read_levels(recording: Recording) -> tuple[Float, dict[int, Float]]:
    """Return times f8[T] and poses f8[T,n,3] by level, NaN on other levels; the level with most robots is first."""
    times, poses = read_poses(recording)
    if "level" not in recording.channels:
        return times, {0: poses}
    levels = recording.channel("level")
    count = np.bincount(levels.ravel())
    visited = [level for level in np.argsort(-count, kind="stable").tolist() if count[level]]
    return times, {level: np.where((levels == level)[..., None], poses, np.nan) for level in visited}


def pack_motion(recording: Recording, packing: Packing) -> None:
    """Pack times, poses, estimates that differ from them, progress and mode."""
    times, poses = read_poses(recording)
    packing.add_metres("time", times)
    _pack_poses(packing, "", poses)
    if {"truth", "estimate"} <= recording.channels.keys():
        estimate = recording.channel("estimate")
        if np.nanmax(np.abs(estimate[..., :2] - poses[..., :2]), initial=0) > ASTRAY:
            _pack_poses(packing, "estimate_", estimate)
    for name, nothing in COUNTS.items():
        if name in recording.channels and (nothing is None or (recording.channel(name) != nothing).any()):
            packing.add(name, recording.channel(name).T)


def _pack_poses(packing: Packing, prefix: str, poses: Float) -> None:
    """Pack poses: yaw is unwrapped so that the page can interpolate it, and unknown poses repeat the last known one."""
    known: Bool = np.asarray(np.isfinite(poses).all(axis=2))
    if not known.all():
        packing.add(f"{prefix}known", known.T)
        poses = _fill(poses, known)
    for index, axis in enumerate("xy"):
        packing.add_metres(f"{prefix}{axis}", poses[..., index].T)
    packing.add_metres(f"{prefix}yaw", np.unwrap(poses[..., 2], axis=0).T, ANGLE)


def _fill(poses: Float, known: Bool) -> Float:
    latest = np.maximum.accumulate(np.where(known, np.arange(len(poses))[:, None], -1), axis=0)
    first = known.argmax(axis=0)
    filled: Float = np.take_along_axis(poses, np.where(latest < 0, first, latest)[..., None], axis=0)
    return np.nan_to_num(filled)
