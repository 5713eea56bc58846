"""The data that simulator, localizer, dispatcher, navigator and controller exchange in every control period."""

from collections.abc import Mapping
from enum import IntEnum
from typing import Self

import attrs
import numpy as np

from mrpbench_core.model.arrays import Bool, Byte, Float, Int, Int16, Int32, array


class Mode(IntEnum):
    """The current activity of a robot. Recordings store the numbers; 3 is no longer used."""

    FOLLOWING = 0
    WAITING = 1
    RECOVERING = 2
    ABORTED = 4


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
    replan: str | None = None
    """The reason why a new plan is needed, or None."""


@attrs.frozen(kw_only=True)
class Route:
    """One robot's path in metres, as a navigator needs it."""

    waypoint: Float = array("f8", 3)
    """f8[k+1,3]: x, y, yaw (NaN = any): the start, then the end of each path segment."""
    level: Int16 = array("i2")
    """i2[k+1]."""
    speed: Float = array("f8")
    """f8[k] m/s: upper limit on each segment, inf = none."""

    @property
    def is_move(self) -> Bool:
        """bool[k]: the segment leads to another place or level; the others are waits."""
        moved: Bool = (np.diff(self.waypoint[:, :2], axis=0) != 0).any(axis=1) | (np.diff(self.level) != 0)
        return moved

    @property
    def last_move(self) -> int:
        """Number of leading segments up to the last move, 0 = none: the robot arrives when it has completed these.

        The waits after it do not count, because a new plan may add some: it begins with what was released and then
        lets robots wait until it takes effect.
        """
        moves = np.flatnonzero(self.is_move)
        return int(moves[-1]) + 1 if len(moves) else 0


@attrs.frozen(kw_only=True)
class ScanBatch:
    """Scans of several robots with equal lidars, taken at the same time."""

    stamp: float
    """simulated seconds."""
    robot: Int32 = array("i4")
    """i4[k]."""
    ranges: Float = array("f8")
    """f8[k,beams] metres, inf = no return. Beam i points at i * 2*pi / beams from straight ahead, counter-clockwise."""


@attrs.frozen(kw_only=True)
class Odometry:
    """The motion that the robots measure."""

    pose: Float = array("f8", 3)
    """f8[n,3] x, y, yaw, each in a fixed frame of its robot. Only differences have a meaning."""
    twist: Float = array("f8", 2)
    """f8[n,2]: m/s forward, rad/s counter-clockwise."""


@attrs.frozen(kw_only=True)
class Estimate:
    """The estimated poses of the robots."""

    pose: Float = array("f8", 3)
    """f8[n,3] in the frame `map`."""
    covariance: Float | None = None
    """f8[n,3,3] or None."""


@attrs.frozen(kw_only=True)
class FleetObservation:
    """The inputs of a navigator."""

    estimate: Estimate
    odometry: Odometry
    level: Int16 = array("i2")
    scans: tuple[ScanBatch, ...] = ()
    """Only those that are new since the last period."""


@attrs.frozen(kw_only=True)
class Observation:
    """The inputs of the controller of one robot."""

    now: float
    pose: Float = array("f8")
    """f8[3] estimated x, y, yaw in `map`."""
    twist: Float = array("f8")
    """f8[2] measured m/s, rad/s."""
    path: Float = array("f8", 2)
    """f8[k,2]: the nearest point of the route, then released waypoints. The robot has to stop at the last one, which
    may be a bend that it has not reached yet."""
    yaw: float = float("nan")
    """Yaw to take at the last waypoint, NaN = any."""
    speed: float = float("inf")
    """m/s allowed now."""
    tolerance: float = 0.1
    """Metres from the last waypoint at which it counts as reached."""
    scan: ScanBatch | None = None
    """This robot's newest scan if it is new since the last call (one row)."""


@attrs.frozen(kw_only=True, eq=False)
class Observations:
    """The inputs of the controllers of k robots, row by row; see `Observation`. The arrays must not be changed."""

    now: float
    robot: Int
    """i8[k] index of each row's robot, ascending."""
    pose: Float
    """f8[k,3] estimated x, y, yaw in `map`."""
    twist: Float
    """f8[k,2] measured m/s, rad/s."""
    foot: Float
    """f8[k,2]: the nearest point of the route, where each path begins."""
    points: Float
    """f8[p,2]: the waypoints of many paths."""
    begin: Int
    """i8[k]: the path of row i is `foot[i]`, then `points[begin[i]:end[i]]`, at least one."""
    end: Int
    yaw: Float
    """f8[k]: yaw to take at the last waypoint, NaN = any."""
    speed: Float
    """f8[k] m/s allowed now."""
    tolerance: float = 0.1
    """Metres from the last waypoint at which it counts as reached."""
    scans: tuple[ScanBatch, ...] = ()
    """All scans that are new since the last period, including those of robots without a row."""
    fleet_pose: Float
    """f8[n,3] estimated poses of all robots."""

    @classmethod
    def alone(cls, seen: Observation) -> Self:
        """Return one row for robot 0."""
        points = seen.path[1:] if len(seen.path) > 1 else seen.path
        return cls(
            now=seen.now,
            robot=np.zeros(1, np.int64),
            pose=seen.pose[None],
            twist=seen.twist[None],
            foot=seen.path[:1],
            points=points,
            begin=np.zeros(1, np.int64),
            end=np.array([len(points)]),
            yaw=np.array([seen.yaw]),
            speed=np.array([seen.speed]),
            tolerance=seen.tolerance,
            fleet_pose=seen.pose[None],
            scans=() if seen.scan is None else (attrs.evolve(seen.scan, robot=np.zeros(1, np.int32)),),
        )

    def path(self, row: int) -> Float:
        """Return the path f8[k,2] of one row."""
        return np.vstack([self.foot[row : row + 1], self.points[self.begin[row] : self.end[row]]])

    def of(self, row: int, scan: ScanBatch | None = None) -> Observation:
        """Return what the controller of one row knows."""
        return Observation(
            now=self.now,
            pose=self.pose[row],
            twist=self.twist[row],
            path=self.path(row),
            yaw=float(self.yaw[row]),
            speed=float(self.speed[row]),
            tolerance=self.tolerance,
            scan=scan,
        )


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


@attrs.frozen(kw_only=True)
class Inputs:
    """The inputs of the simulator for one control period."""

    twist: Float = array("f8", 2)
    """f8[n,2] commanded m/s, rad/s."""
    movers: Float | None = None
    """f8[m,4]: x, y, vx, vy of things that are not robots, or None."""
    facilities: Mapping[str, float] = attrs.field(factory=dict)
    """Name of a door -> commanded opening 0..1; of a lift -> height in metres that its cabin is to go to; what is not
    named stays as it is. See `mrpbench_core.model.facilities`."""


@attrs.frozen(kw_only=True)
class State:
    """The true state after one control period."""

    pose: Float = array("f8", 3)
    """f8[n,3] x, y, yaw in `map`."""
    twist: Float = array("f8", 2)
    """f8[n,2] true m/s forward, rad/s."""
    level: Int16 = array("i2")
    contacts: Int32 = array("i4", 2)
    """i4[k,2]: robot and what it touched during the period (a robot of higher index, or -1 = wall or obstacle)."""
    facilities: Mapping[str, float] = attrs.field(factory=dict)
    """Name of each door -> opening 0..1; of each lift -> height of its cabin in metres. Empty if the simulator has
    neither."""
