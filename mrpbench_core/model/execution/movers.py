"""People and other things that move among the robots, and how lidars see them."""

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float, Int16, Int32, array
from mrpbench_core.model.execution.state import Inputs, State
from mrpbench_core.model.worlds.level_layout import LevelLayout

FASTEST = 5.0
"""m/s at which a mover moves at most, and pushes a robot; one that is farther away was put there."""

JUMP = 1.0
"""Metres in a control period beyond which a mover does not move but is put where it is to be."""

LARGEST_RADIUS = 10.0
"""Metres of a mover."""
LONGEST_KIND = 64
"""Characters of what it is."""


@attrs.frozen(kw_only=True)
class Mover:
    """What does not change about a mover. Its body is a disc."""

    radius: float
    """metres of the disc that touches, at most 10."""
    kind: str = "person"
    """What it is, as names, pictures and bags say it: `person`, `cart`; at most 64 characters."""
    leg_radius: float = 0.0
    """metres of each of the two legs that lidars see, at most those of the disc; 0 = they see the disc."""


@attrs.frozen(kw_only=True)
class Movers:
    """Where movers are, in the order of their indices."""

    pose: Float = array("f8", 3)
    """f8[m,3] x, y, yaw in `map`."""
    velocity: Float = array("f8", 2)
    """f8[m,2] x, y in m/s."""
    level: Int16 = array("i2")
    """i2[m] index into `World.levels`; -1 = absent, with the pose at which it will come or has left."""
    arrivals: Int32 | None = None
    """i4[m] number of goals that each has reached so far, -1 = has none; None = none has any."""


@attrs.frozen(kw_only=True)
class CrowdView:
    """What a crowd sees of the truth when it moves: robots as at the beginning of the control period."""

    state: State
    """The robots, those on level -1 not being there, and what doors and lifts do."""
    others: Movers
    """The movers of the other crowds; those of crowds before this one have moved in this period already."""
    radius: Float = array("f8")
    """f8 of those, metres."""


class MoverDiscs:
    """The discs of the movers of one simulation, in the plane in which levels lie side by side."""

    def __init__(self, layout: LevelLayout, radii: Float) -> None:
        self._layout, self._radii = layout, radii
        self.place: Float = np.full((len(radii), 2), np.inf)
        """f8[m,2] in `map`."""
        self.level: Int16 = np.zeros(len(radii), np.int16)
        self.body = self.place
        """f8[m,2] centres of what touches; infinite until the first inputs place them."""
        self.scan_discs, self.scan_radius = self.body, radii
        """f8[k,2], f8[k]: what lidars see."""

    def update(self, inputs: Inputs) -> None:
        """Place the movers as the inputs say; without movers in the inputs they stay."""
        if inputs.movers is None:
            return
        if inputs.mover_level is not None:
            self.level = inputs.mover_level
        self.place, level = inputs.movers[:, :2], self.level
        self.body = self._layout.to_plane(self.place, level)
        self.scan_discs, self.scan_radius = self.body, self._radii
        if inputs.legs is not None:
            self.scan_discs = self._layout.to_plane(inputs.legs[:, :4].reshape(-1, 2), np.repeat(level, 2))
            self.scan_radius = np.repeat(inputs.legs[:, 4], 2)

    def among(self, pose: Float, level: Int16, radius: Float) -> tuple[Float, Int16, Float]:
        """Robots and movers together, for doors, which stop before both: places f8[k,2], levels i2[k], radii f8[k]."""
        if not len(self.place):
            return pose, level, radius
        places = np.concatenate([pose[:, :2], self.place])
        return places, np.concatenate([level, self.level]), np.concatenate([radius, self._radii])
