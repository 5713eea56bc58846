"""What people do in a building all day: the states of RMF's `crowd_sim`, which are those of Menge.

S. Curtis, A. Best and D. Manocha, "Menge: A Modular Framework for Simulating Crowd Movement", Collective Dynamics 1,
2016.
"""

import attrs

from mrpbench_core.model.common.arrays import Float, Int16, array


@attrs.frozen(kw_only=True)
class Activity:
    """Something that people do until it ends: walk to one of its places, drawn at random, and stand there."""

    name: str
    places: Float = array("f8", 2, factory=list)
    """f8[k,2] metres in `map`; none = people stay where they are."""
    level: Int16 = array("i2", factory=list)
    """i2[k] index into `World.levels` of each place."""
    reach: float | None = None
    """Metres from its place within which a person has reached it; None = the activity ends by its time alone."""
    time: tuple[float, float] | None = None
    """Seconds from the beginning of the activity, drawn uniformly from this interval, after which it ends; None = it
    ends at its place alone. Without reach and time it never ends."""
    either: bool = False
    """With reach and time: True = the first of both ends it, False = the last."""
    following: tuple[tuple[int, float], ...] = ()
    """Index and weight of each activity that may follow, one of which is drawn; none = it never ends."""


@attrs.frozen(kw_only=True)
class PeopleGroup:
    """People who begin near one point with the same activity."""

    people: int
    x: float
    y: float
    level: int
    activity: int
    """Index into `World.activities`."""
