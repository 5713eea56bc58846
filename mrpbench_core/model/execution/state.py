"""The inputs of a simulator, and the true state that it returns."""

from collections.abc import Mapping

import attrs

from mrpbench_core.model.common.arrays import Float, Int16, Int32, array


@attrs.frozen(kw_only=True)
class Inputs:
    """The inputs of the simulator for one control period."""

    twist: Float = array("f8", 2)
    """f8[n,2] commanded m/s, rad/s."""
    movers: Float | None = None
    """f8[m,4]: x, y, vx, vy of things that are not robots at the end of the period, or None. They move there in a
    straight line, and nothing stops them; one that was nowhere, or more than a metre away, is put there; an infinite
    place means that it is absent."""
    mover_level: Int16 | None = None
    """i2[m]; None = all stay on the level on which they were, at first level 0."""
    legs: Float | None = None
    """f8[m,5]: x, y, x, y of two discs as which lidars see each mover (its legs), and their radius; None = the bodies
    of the movers."""
    facilities: Mapping[str, float] = attrs.field(factory=dict)
    """Name of a door -> commanded opening 0..1; of a lift -> height in metres that its cabin is to go to; what is not
    named stays as it is. See `mrpbench_core.model.worlds.facilities`."""


@attrs.frozen(kw_only=True)
class State:
    """The true state after one control period."""

    pose: Float = array("f8", 3)
    """f8[n,3] x, y, yaw in `map`."""
    twist: Float = array("f8", 2)
    """f8[n,2] true m/s forward, rad/s."""
    level: Int16 = array("i2")
    contacts: Int32 = array("i4", 2)
    """i4[k,2]: robot and what it touched during the period: a robot of higher index, -1 = wall, obstacle or door, or
    n + j = mover j."""
    contact_force: Float | None = None
    """f8[k]: the normal force of each contact, its mean over the period, N; None if the simulator does not know it."""
    facilities: Mapping[str, float] = attrs.field(factory=dict)
    """Name of each door -> opening 0..1; of each lift -> height of its cabin in metres. Empty if the simulator has
    neither."""
