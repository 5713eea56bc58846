"""The sensor data of the robots, and the part of them that navigators and controllers get."""

from typing import Self

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float, Int, Int16, Int32, array


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
    """f8[n,3,3], finite, symmetric and positive semi-definite, or None."""


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
    def alone(cls, observation: Observation) -> Self:
        """Return one row for robot 0."""
        points = observation.path[1:] if len(observation.path) > 1 else observation.path
        return cls(
            now=observation.now,
            robot=np.zeros(1, np.int64),
            pose=observation.pose[None],
            twist=observation.twist[None],
            foot=observation.path[:1],
            points=points,
            begin=np.zeros(1, np.int64),
            end=np.array([len(points)]),
            yaw=np.array([observation.yaw]),
            speed=np.array([observation.speed]),
            tolerance=observation.tolerance,
            fleet_pose=observation.pose[None],
            scans=() if observation.scan is None else (attrs.evolve(observation.scan, robot=np.zeros(1, np.int32)),),
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
