"""Ways around what blocks the released path, which controllers find from what their sensors show.

A detour begins where the robot is and ends on the released path, so it never leads beyond the released part. Where the
end of the path itself is occupied, a detour may end beside it, if `planner_tolerance` of the navigator allows that.
"""

from collections.abc import Iterable

import attrs
import numpy as np

from mrpbench_core.api.controller import FleetControllerSession
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.execution.motion import Event
from mrpbench_core.model.execution.observation import Observations
from mrpbench_navigators_waypoints.route_follower import RouteFollower

_REACHED = 0.1
"""metres from a point of a detour at which the robot goes on to the next one."""


class Detours:
    """The detours of all robots. Robots that are stuck ask for one in turn.

    Args:
        follower: the routes that the detours leave.
        controllers: find the detours.
        planner_tolerance: metres from an occupied end of the path that count as reached if the robot gets no nearer.
        waypoint_tolerance: metres from the end of such a detour at which the robot has arrived there.
    """

    def __init__(
        self,
        follower: RouteFollower,
        controllers: FleetControllerSession,
        planner_tolerance: float,
        waypoint_tolerance: float,
    ) -> None:
        self._follower, self._controllers = follower, controllers
        self._planner_tolerance, self._waypoint_tolerance = planner_tolerance, waypoint_tolerance
        self._detours: dict[int, Float] = {}
        self._to_beside: set[int] = set()
        """Robots whose detour ends beside the end of the path."""
        self._detouring = follower.activities.detouring

    def __bool__(self) -> bool:
        """Tell whether any robot is on a detour."""
        return bool(self._detours)

    def cancel(self, robot: int) -> None:
        """Forget the detour of a robot; it may ask for another at once."""
        self._drop(robot)
        self._follower.ask_at_once(robot)

    def _drop(self, robot: int) -> None:
        self._detours.pop(robot, None)
        self._detouring[robot] = False
        self._to_beside.discard(robot)

    def cancel_all(self) -> None:
        """Forget all detours: there are new routes."""
        self._detours.clear()
        self._detouring[:] = False
        self._to_beside.clear()

    def shorten(self, pose: Float) -> None:
        """Drop what robots have passed, and all of robots that rotate.

        At the end of a detour robots follow their route again.
        """
        for robot, detour in list(self._detours.items()):
            if self._follower.activities.rotating[robot] or self._follower.only_turns(robot):
                self.cancel(robot)
                continue
            left = detour
            while len(left) and np.hypot(*(left[0] - pose[robot, :2])) <= self._tolerance(robot, left):
                left = left[1:]
            if len(left):
                self._detours[robot] = left
            elif robot in self._to_beside:
                self._skip_path_end(robot)
            else:
                self._drop(robot)
                self._follower.rejoin(robot, *detour[-1].tolist())

    def _tolerance(self, robot: int, detour: Float) -> float:
        """Metres from the first point of a detour at which the robot goes on to the next one."""
        ends_beside = len(detour) == 1 and robot in self._to_beside
        return self._waypoint_tolerance if ends_beside else _REACHED

    def _skip_path_end(self, robot: int) -> None:
        """Count the end of the path as reached, since the robot gets no nearer; the robot may ask again at once."""
        self.cancel(robot)
        self._follower.skip_path_end(robot)

    def request(self, observations: Observations, rows: Iterable[int]) -> list[Event]:
        """Ask the controllers for detours of some rows of observations, which are of the routes, not of detours."""
        return [event for row in rows for event in self._request_one(observations, row)]

    def _request_one(self, observations: Observations, row: int) -> list[Event]:
        robot, place = int(observations.robot[row]), observations.pose[row, :2]
        if self._follower.only_turns(robot):  # a detour would not turn it
            return []
        tolerance = self._planner_tolerance
        detour = self._controllers.reroute(observations, row)
        beside = detour is None and tolerance > 0
        if beside:
            detour = self._controllers.approach(observations, row, tolerance)
        near = self._waypoint_tolerance if beside else _REACHED
        if detour is None or not len(detour) or np.hypot(*(detour[-1] - place)) <= near:
            self._drop(robot)
            if beside and detour is not None:  # the robot is there already
                self._skip_path_end(robot)
            return []
        is_new = robot not in self._detours
        self._detours[robot] = np.asarray(detour, float)
        self._detouring[robot] = True
        (self._to_beside.add if beside else self._to_beside.discard)(robot)
        return [Event(stamp=observations.now, kind="detour", robot=robot)] if is_new else []

    def apply(self, observations: Observations) -> Observations:
        """The same observations with detours in the place of the paths that they go around."""
        if not self._detours:
            return observations
        foot, begin, end = observations.foot.copy(), observations.begin.copy(), observations.end.copy()
        yaw = observations.yaw.copy()
        points, count = [observations.points], len(observations.points)
        for row in self._detouring[observations.robot].nonzero()[0].tolist():
            detour = self._detours[int(observations.robot[row])]
            reaches_end = bool((detour[-1] == observations.points[observations.end[row] - 1]).all())
            foot[row] = observations.pose[row, :2]
            begin[row], end[row] = count, count + len(detour)
            yaw[row] = yaw[row] if reaches_end else np.nan
            points.append(detour)
            count += len(detour)
        return attrs.evolve(observations, foot=foot, points=np.concatenate(points), begin=begin, end=end, yaw=yaw)
