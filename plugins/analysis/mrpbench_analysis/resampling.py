"""Resamples the positions of a recording at even times."""

import attrs
import numpy as np

from mrpbench_core.api.format import Track
from mrpbench_core.files.text import counted
from mrpbench_core.model.common.arrays import Float

STANDING = 0.25
"""metres. A robot that is this near to its position before a gap stood still: AMCL is silent while a robot moves by
less than its `update_min_d`, which is 0.25 m by default (Nav2)."""


MOVES = 0.05
"""metres or radians. Poses of a source that is silent while the robot stands are at least so far apart."""
SHARE = 0.9
"""Share of the poses that must be so far apart."""


@attrs.frozen
class Resampled:
    """A track at even times."""

    pose: Float
    """f8[T,3]; NaN where the robot's position is unknown."""
    notes: tuple[str, ...]
    """Assumptions, one sentence each."""
    gaps: tuple[str, ...]
    """The times at which the pose is unknown, in words."""
    trigger: float = 0.0
    """metres that the robot moves unseen between two poses, if the source is silent while it stands; else 0."""


def even_times(begin: float, end: float, rate: float) -> Float:
    """Times f8[T] from `begin` every `1 / rate` seconds, and `end`."""
    times = begin + np.arange(int((end - begin) * rate + 1e-6) + 1) / rate
    return np.append(times, end) if end - times[-1] > 1e-6 else times


def motion_trigger(track: Track, max_gap: float) -> float:
    """Metres between two poses of a moving robot, if the source gives poses only while the robot moves; else 0.

    AMCL publishes a pose when the robot has moved by `update_min_d` or turned by `update_min_a` (Nav2).
    """
    step = np.abs(np.diff(np.column_stack([track.pose[:, :2], np.unwrap(track.pose[:, 2])]), axis=0))
    moved, turned, silent = np.hypot(step[:, 0], step[:, 1]), step[:, 2], np.diff(track.time) > max_gap
    if not silent.any() or silent.all():
        return 0.0
    moves = (moved >= MOVES) | (turned >= MOVES)
    return float(moved[~silent].max()) if moves[~silent].mean() >= SHARE else 0.0


def resample(track: Track, time: Float, max_gap: float) -> Resampled:
    """Poses of a track at `time` f8[T], straight between samples.

    Between samples more than `max_gap` seconds apart, a robot that has moved was anywhere. A robot whose source is
    silent while it stands has stood until it began to move to the next pose. Before its first sample and after its last
    a robot is held where it was seen first and last.
    """
    first, last = float(track.time[0]), float(track.time[-1])
    trigger = motion_trigger(track, max_gap)
    moved = np.hypot(*np.diff(track.pose[:, :2], axis=0).T)
    silent = np.diff(track.time) > max_gap
    stood = silent & (moved <= max(STANDING, 1.5 * trigger))
    known, poses = track.time, np.column_stack([track.pose[:, :2], np.unwrap(track.pose[:, 2])])
    if trigger:
        usual = float(np.median(np.diff(track.time)[~silent]))
        places = np.flatnonzero(stood)
        known = np.insert(known, places + 1, known[places + 1] - usual)
        poses = np.insert(poses, places + 1, poses[places], axis=0)
    pose = np.stack([np.interp(time, known, column) for column in poses.T], axis=-1)
    notes = []
    if first - time[0] > max_gap:
        notes.append(f"{track.robot} appears {first - time[0]:.1f} s late: held at its first position until then")
    if trigger:
        notes.append(
            f"{track.robot}: {track.topic} gives poses only while the robot moves, at most {trigger:.2f} m apart: it is"
            f" held where it was during {counted(int(np.count_nonzero(stood)), 'gap')}"
        )
    elif time[-1] - last > max_gap:
        notes.append(f"{track.robot} is last seen {time[-1] - last:.1f} s before the end: held at its last position")
    gaps = []
    for index in np.flatnonzero(silent & (moved > max(STANDING, 1.5 * trigger))):
        since, until = track.time[index], track.time[index + 1]
        inside = (time > since) & (time < until)
        if inside.any():
            pose[inside] = np.nan
            gaps.append(f"{track.robot} moved {moved[index]:.2f} m unseen from {since:.1f} to {until:.1f} s")
    return Resampled(pose, tuple(notes), tuple(gaps), trigger)
