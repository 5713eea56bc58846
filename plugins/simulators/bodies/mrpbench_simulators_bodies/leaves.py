"""Leaves of doors: boxes that are placed anew whenever a door moves."""

from collections.abc import Iterator, Mapping

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.worlds.doors import leaf_segments
from mrpbench_core.model.worlds.facilities import Facilities, OperatedDoor
from mrpbench_core.model.worlds.level_layout import LevelLayout


@attrs.frozen
class Leaf:
    """An upright box on the floor."""

    length: float
    thickness: float
    height: float


def leaves_of(facilities: Facilities, state: Mapping[str, float]) -> tuple[Leaf, ...]:
    """The leaves of all doors on all levels; their sizes do not depend on the state."""
    return tuple(
        Leaf(length + gate.door.thickness, gate.door.thickness, gate.door.height)
        for gate, _, lines in _parts(facilities, state)
        for length in np.hypot(*(lines[:, 2:] - lines[:, :2]).T).tolist()
    )


def leaf_poses(facilities: Facilities, layout: LevelLayout, state: Mapping[str, float]) -> Float:
    """Poses f8[k,3] in the plane of the middle of each leaf."""
    poses = [np.empty((0, 3))]
    for _, level, lines in _parts(facilities, state):
        ends = layout.to_plane(lines.reshape(-1, 2), np.full(2 * len(lines), level, np.int16)).reshape(-1, 2, 2)
        along = ends[:, 1] - ends[:, 0]
        poses.append(np.column_stack([ends.mean(axis=1), np.arctan2(along[:, 1], along[:, 0])]))
    return np.concatenate(poses)


def _parts(facilities: Facilities, state: Mapping[str, float]) -> Iterator[tuple[OperatedDoor, int, Float]]:
    for gate in facilities.doors:
        for level in gate.levels:
            yield gate, level, leaf_segments(gate.door, facilities.opening(gate, state, level))
