"""Poses of a fleet from reports that come now and then: robots drive from report to report, within their limits.

Reports jump: they are rare, late, and as good as the localization of the vehicles. A recording is judged by what robots
can do, so the recorded robots follow the reports no faster than their models drive. They go on to where a vehicle can
stop at the soonest after its report.
"""

import math
from collections import deque

import numpy as np

from mrpbench_core.api import Float, RobotModel, wrapped

NEAR_M, NEAR_RAD = 0.1, 0.3
"""Metres and radians within which a robot goes on to the next report."""
BESIDE_M = 0.5
"""Metres from a route within which a place is beside it."""
BRAKING = 0.95
"""Share of its acceleration with which a robot brakes, so that it does not overshoot in steps of a control period."""


class Tracker:
    """Follows the reports of a fleet.

    Args:
        robots: of the fleet.
        pose: f8[n,3] x, y (metres), yaw (radians) at first.
        period: of a step, simulated seconds.
    """

    def __init__(self, robots: tuple[RobotModel, ...], pose: Float, period: float) -> None:
        self._period, self._passed = period, period / 2
        limits = [(it.max_speed, it.acceleration, it.max_turn_rate, it.turn_acceleration) for it in robots]
        self._limits = np.array(limits).reshape(-1, 4).T
        self.pose = pose.copy()
        """f8[n,3] now."""
        self.twist = np.zeros((len(robots), 2))
        """f8[n,2] m/s forward, rad/s."""
        self._target = pose.copy()
        self._came, self._faced = np.ones(len(robots), bool), np.ones(len(robots), bool)
        """bool[n] each: the robot has been at the place of its target, and has had its yaw."""
        self._rest = np.zeros(len(robots))
        """f8[n] metres ahead of the target on which the robot need not stop."""
        self._reports: list[deque[tuple[float, float, float]]] = [deque() for _ in robots]
        self._last: list[tuple[float, ...]] = [()] * len(robots)
        self._behind: set[int] = set()
        """Robots that have reports after their target."""

    def report(
        self, robot: int, x: float, y: float, yaw: float, speed: float = 0.0, straight: float = math.inf
    ) -> None:
        """Add a report: metres, radians, m/s forward, and the metres for which the robot can go on straight ahead."""
        report = x, y, yaw, speed
        if self._last[robot] == report:
            return
        self._last[robot] = report
        braking = min(speed * abs(speed) / (2 * self._limits[1, robot]), straight)
        stop = x + braking * math.cos(yaw), y + braking * math.sin(yaw), yaw
        self._reports[robot].append(stop)
        self._rest[robot] = self._ahead(robot)
        self._behind.add(robot)

    def step(self) -> None:
        """Go on by one period."""
        self._look()
        for robot in list(self._behind):
            self._advance(robot)
        period, pose = self._period, self.pose
        top, acceleration, top_rate, turn_acceleration = self._limits
        turn = wrapped(self._target[:, 2] - pose[:, 2])
        rate = np.minimum.reduce(
            [top_rate, np.sqrt(2 * BRAKING * turn_acceleration * np.abs(turn)), np.abs(turn) / period]
        )
        passed, self._passed = self._passed, period  # at first, speeds change in the middle of the first step
        omega = _near(np.copysign(rate, turn), self.twist[:, 1], turn_acceleration * passed)
        heading = pose[:, 2] + omega * period / 2
        shift = self._target[:, :2] - pose[:, :2]
        length = np.hypot(shift[:, 0], shift[:, 1])
        through = np.abs(turn) <= NEAR_RAD  # others stop at their target to turn
        left = length + np.where(through, self._rest, 0.0)
        speed = np.minimum.reduce([top, np.sqrt(2 * BRAKING * acceleration * left), left / period])
        velocity = shift * (speed / np.maximum(length, 1e-9))[:, None]
        cosine, sine = np.cos(heading), np.sin(heading)
        ahead = _near(velocity[:, 0] * cosine + velocity[:, 1] * sine, self.twist[:, 0], acceleration * passed)
        aside = velocity[:, 1] * cosine - velocity[:, 0] * sine
        off = np.abs(shift[:, 1] * cosine - shift[:, 0] * sine) / period
        most = np.minimum(np.sqrt(np.maximum(top**2 - ahead**2, 0.0)), off)
        aside = np.clip(aside, -most, most)
        moved = np.column_stack([ahead * cosine - aside * sine, ahead * sine + aside * cosine]) * period
        self.pose = np.column_stack([pose[:, :2] + moved, wrapped(pose[:, 2] + omega * period)])
        self.twist = np.column_stack([ahead, omega])

    def _look(self) -> None:
        """Note who has come to the place and to the yaw of its target, be it only in passing."""
        shift = self._target - self.pose
        reach = np.maximum(NEAR_M, 1.5 * np.abs(self.twist[:, 0]) * self._period)
        self._came |= np.hypot(shift[:, 0], shift[:, 1]) <= reach
        self._faced |= np.abs(wrapped(shift[:, 2])) <= NEAR_RAD

    def _advance(self, robot: int) -> None:
        """Take the next report of a robot for its target once it has reached the one before."""
        reports, (x, y, yaw) = self._reports[robot], self.pose[robot].tolist()
        reach = max(NEAR_M, 1.5 * abs(float(self.twist[robot, 0])) * self._period)
        came, faced = bool(self._came[robot]), bool(self._faced[robot])
        while came and faced:
            self._target[robot] = target = reports.popleft()
            came = math.hypot(target[0] - x, target[1] - y) <= reach
            faced = abs(math.remainder(target[2] - yaw, 2 * math.pi)) <= NEAR_RAD
            if not reports:
                self._behind.discard(robot)
                break
        self._came[robot], self._faced[robot], self._rest[robot] = came, faced, self._ahead(robot)

    def _ahead(self, robot: int) -> float:
        """Return the metres from the target through the reports after it, up to the first one that asks for a turn."""
        metres, (x, y, yaw) = 0.0, self._target[robot].tolist()
        for report in self._reports[robot]:
            if abs(math.remainder(report[2] - yaw, 2 * math.pi)) > NEAR_RAD:
                break
            metres += math.hypot(report[0] - x, report[1] - y)
            x, y, yaw = report
        return metres


def corners_of(route: Float) -> Float:
    """Return the places f8[k,2] at which a route f8[m,2] begins, turns and ends."""
    leg = np.diff(route, axis=0)
    leg /= np.maximum(np.hypot(leg[:, 0], leg[:, 1]), 1e-9)[:, None]
    turns = (np.abs(np.diff(leg, axis=0)) > 1e-6).any(axis=1)
    found: Float = route[np.concatenate([[True], turns, [True]])] if len(route) > 1 else route
    return found


def corners_between(route: Float, before: tuple[float, float], after: tuple[float, float]) -> list[tuple[float, float]]:
    """Return the corners of a route f8[k,2] between two places beside it; none if one of them is not beside it.

    Where a route passes a place twice, the shortest way along it counts, in whole legs.
    """
    if len(route) < 3:
        return []
    tail, leg = route[:-1], np.diff(route, axis=0)
    length = np.maximum((leg**2).sum(axis=1), 1e-12)
    legs = []
    for place in (before, after):
        share = np.clip(((place - tail) * leg).sum(axis=1) / length, 0.0, 1.0)
        away = np.hypot(*(tail + share[:, None] * leg - place).T)
        legs.append(np.flatnonzero(away <= min(BESIDE_M, away.min() + NEAR_M)).tolist())
    pairs = [(last - first, first, last) for first in legs[0] for last in legs[1] if last >= first]
    _, first, last = min(pairs, default=(0, 0, 0))
    return [(x, y) for x, y in route[first + 1 : last + 1].tolist()]


def straight_ahead(route: Float, place: tuple[float, float], yaw: float) -> float:
    """Return the metres for which a robot at a place stays beside a route f8[k,2] straight ahead; inf without one.

    That is as far as the end of the leg of the route at which it is and which it faces, and nothing if it faces none.
    """
    if len(route) < 2:
        return math.inf
    tail, leg = route[:-1], np.diff(route, axis=0)
    length = np.maximum(np.hypot(leg[:, 0], leg[:, 1]), 1e-6)
    along = ((place - tail) * leg).sum(axis=1) / length
    nearest = np.hypot(*(tail + (np.clip(along, 0.0, length) / length)[:, None] * leg - place).T)
    beside = nearest <= nearest.min() + NEAR_M
    facing = (leg[:, 0] * math.cos(yaw) + leg[:, 1] * math.sin(yaw)) / length
    left = np.where(facing >= math.cos(NEAR_RAD), length - along, 0.0)
    return max(0.0, float(left[beside].max()))


def _near(wanted: Float, before: Float, change: Float) -> Float:
    """The values nearest to those wanted that differ from those before by no more than a change."""
    found: Float = np.clip(wanted, before - change, before + change)
    return found
