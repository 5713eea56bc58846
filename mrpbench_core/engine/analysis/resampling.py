"""Resamples the positions of a recording at even times."""

import attrs
import numpy as np

from mrpbench_core.api.importer import Track
from mrpbench_core.model.arrays import Float

STANDING = 0.25
"""metres. A robot that is this near to its position before a gap stood still: AMCL is silent while a robot moves by
less than its `update_min_d`, which is 0.25 m by default (Nav2)."""


@attrs.frozen
class Resampled:
    """A track at even times."""

    pose: Float
    """f8[T,3]; NaN where the robot's position is unknown."""
    notes: tuple[str, ...]
    """What had to be assumed."""
    gaps: tuple[str, ...]
    """What is unknown."""


def even_times(begin: float, end: float, rate: float) -> Float:
    """Times f8[T] from `begin` every `1 / rate` seconds, and `end`."""
    times = begin + np.arange(int((end - begin) * rate + 1e-6) + 1) / rate
    return np.append(times, end) if end - times[-1] > 1e-6 else times


def resample(track: Track, time: Float, max_gap: float) -> Resampled:
    """Poses of a track at `time` f8[T], straight between samples.

    Between samples more than `max_gap` seconds apart, a robot that has moved was anywhere. Before its first sample and
    after its last it is held where it was seen first and last.
    """
    first, last = float(track.time[0]), float(track.time[-1])
    columns = [track.pose[:, 0], track.pose[:, 1], np.unwrap(track.pose[:, 2])]
    pose = np.stack([np.interp(time, track.time, column) for column in columns], axis=-1)
    notes = []
    if first - time[0] > max_gap:
        notes.append(f"{track.robot} appears {first - time[0]:.1f} s late: held at its first position until then")
    if time[-1] - last > max_gap:
        notes.append(f"{track.robot} is last seen {time[-1] - last:.1f} s before the end: held at its last position")
    gaps = []
    moved = np.hypot(*np.diff(track.pose[:, :2], axis=0).T)
    for index in np.flatnonzero((np.diff(track.time) > max_gap) & (moved > STANDING)):
        since, until = track.time[index], track.time[index + 1]
        inside = (time > since) & (time < until)
        if inside.any():
            pose[inside] = np.nan
            gaps.append(f"{track.robot} moved {moved[index]:.2f} m unseen from {since:.1f} to {until:.1f} s")
    return Resampled(pose, tuple(notes), tuple(gaps))
