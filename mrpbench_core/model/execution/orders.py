"""The inputs and the decisions of a dispatcher."""

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Byte, Float, Int, Int16, Int32, array
from mrpbench_core.model.execution.motion import Event


@attrs.frozen(kw_only=True)
class FleetView:
    """The state of the fleet as a dispatcher sees it: estimates, never ground truth."""

    revision: int
    """Number of calls of `adopt`, which tells the plan that the indices below refer to."""
    reached: Int32 = array("i4")
    """i4[n]: number of leading path segments each robot has completed."""
    cleared: Int32 = array("i4")
    """i4[n]: number of leading path segments whose *start vertex* the robot's footprint has left, so that another robot
    fits there."""
    pose: Float = array("f8", 3)
    """f8[n,3] estimated x, y, yaw."""
    level: Int16 = array("i2")
    mode: Byte = array("u1")
    """u1[n] of `Mode`."""
    granted: tuple[tuple[int, str], ...] = ()
    """(robot, resource) pairs that robots may use now: the robot holds the resource, the door is open, or the lift has
    arrived and its doors are open."""


@attrs.frozen(kw_only=True)
class Orders:
    """The segments that a dispatcher releases, and its requests."""

    released: Int32 = array("i4")
    """i4[n]: number of leading path segments each robot may complete; never decreases within a revision."""
    requests: tuple[tuple[int, str], ...] = ()
    """(robot, resource) pairs requested or in use, the longest requested first. A pair that is left out is released."""
    in_step: tuple[tuple[tuple[int, int], ...], ...] = ()
    """Groups of (robot, segment) that rotate: each robot moves to where the next one of its group starts, so none of
    them may lead the others along these segments by more than a small distance."""
    speed: Float = array("f8", factory=lambda: np.zeros(0))
    """f8[n] m/s: upper limit of each robot now, inf = none; empty: there are no limits in the whole execution. No rule
    depends on it: a robot that ignores it only drives on to where it has to wait."""
    replan: str = ""
    """Why a new plan is needed now, such as `robot 3 has another path`; empty: the dispatcher needs none. Not without
    physics."""
    events: tuple[Event, ...] = ()
    """What the dispatcher adds to the recording, with the time of this control period. Not without physics."""


@attrs.frozen(kw_only=True)
class BatchOrders:
    """The orders for d executions of one plan; see `Orders`. There are neither requests nor limits of speed."""

    released: Int = array("i8")
    """i8[d,n]: number of leading path segments each robot may complete; never decreases."""
    in_step: Int = array("i8", 4, factory=lambda: np.empty((0, 4), np.int64))
    """i8[k,4]: number of a group that rotates in one execution, the execution, robot and segment of one of its members;
    groups are numbered from 0 without gaps."""
