"""The commands and reports of a navigator."""

from enum import IntEnum

import attrs

from mrpbench_core.model.common.arrays import Byte, Float, Int32, array


class Mode(IntEnum):
    """The current activity of a robot. Recordings store the numbers; 3 is no longer used."""

    FOLLOWING = 0
    WAITING = 1
    RECOVERING = 2
    ABORTED = 4


@attrs.frozen(kw_only=True)
class Event:
    """An event in the recording, such as a recovery, an abort, a replan or a contact."""

    stamp: float
    kind: str
    robot: int = -1
    detail: str = ""


@attrs.frozen(kw_only=True)
class Motion:
    """The commands of a navigator, and the progress of its robots."""

    twist: Float = array("f8", 2)
    """f8[n,2] commanded m/s, rad/s."""
    reached: Int32 = array("i4")
    cleared: Int32 = array("i4")
    mode: Byte = array("u1")
    events: tuple[Event, ...] = ()
