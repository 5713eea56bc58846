"""Ways around what blocks the released path, which controllers find on what their sensors show.

A detour begins where the robot is and ends on the released path, so it never leads beyond what is released. Where the
end of the path itself is occupied, it may lead beside it instead, if the navigator's `planner_tolerance` allows that.
"""

import attrs
import numpy as np

from mrpbench_core.api.controller import FleetControllerSession
from mrpbench_core.builtin.navigators.followers import Followers
from mrpbench_core.model.arrays import Bool, Float
from mrpbench_core.model.execution import Event, Observations

_REACHED = 0.1
"""metres from a point of a detour at which the next one counts."""
_MOVING = 0.05
"""metres: a robot that moves so far between two looks is not blocked."""


class Detours:
    """Detours of all robots. Robots that do not get on are looked at in turn, each once in a while.

    Args:
        followers: the routes that are detoured from.
        controllers: find the ways.
        every: control periods between two looks at the same robot; 0 = never.
        beside: metres from an occupied end of the path that count as reached if the robot gets no nearer. Above zero,
            robots look ahead while they drive too.
        near: metres from there at which it is there.
    """

    def __init__(
        self, followers: Followers, controllers: FleetControllerSession, every: int, beside: float, near: float
    ) -> None:
        self._followers, self._controllers, self._every = followers, controllers, every
        self._beside, self._near = beside, near
        self._ways: dict[int, Float] = {}
        self._instead: set[int] = set()
        """Robots whose way leads beside the end of the path."""
        count = len(followers)
        self._due = np.arange(count) % max(every, 1)
        """Period from which on each robot is looked at again."""
        self._place: Float = np.full((count, 2), np.inf)
        self._step = 0

    def cancel(self, robot: int) -> None:
        """Forget the detour of a robot; it may need another at once."""
        self._drop(robot)
        self._due[robot] = 0

    def _drop(self, robot: int) -> None:
        self._ways.pop(robot, None)
        self._instead.discard(robot)

    def cancel_all(self) -> None:
        """Forget all: there are new routes."""
        self._ways.clear()
        self._instead.clear()

    def shorten(self, pose: Float) -> None:
        """Drop what robots have passed; at the end of a detour they follow their route again."""
        for robot, way in list(self._ways.items()):
            if self._followers.only_turns(robot):
                self.cancel(robot)
                continue
            left = way
            while len(left) and np.hypot(*(left[0] - pose[robot, :2])) <= self._reach(robot, left):
                left = left[1:]
            if len(left):
                self._ways[robot] = left
            elif robot in self._instead:
                self._skip(robot)
            else:
                del self._ways[robot]
                self._followers.rejoin(robot, *way[-1].tolist())

    def _reach(self, robot: int, way: Float) -> float:
        """Metres from the first point of a way at which the next one counts."""
        return self._near if len(way) == 1 and robot in self._instead else _REACHED

    def _skip(self, robot: int) -> None:
        """The robot is as near to the end of its path as it gets: it looks for a way from here at once."""
        self.cancel(robot)
        self._followers.skip(robot)

    def look(self, observations: Observations, stopped: Bool) -> list[Event]:
        """Ask for a way around, for rows whose turn it is and that do not get on or are `stopped` bool[k].

        `observations` are of the routes, not of the detours.
        """
        self._step += 1
        if not self._every:
            return []
        due = (self._step >= self._due[observations.robot]).nonzero()[0]
        if not len(due):
            return []
        robots, places = observations.robot[due], observations.pose[due, :2]
        blocked = np.abs(places - self._place[robots]).max(axis=1) <= _MOVING
        blocked |= stopped[due] | (self._beside > 0)
        if self._ways:
            blocked |= np.isin(robots, list(self._ways))
        self._due[robots] = self._step + self._every
        self._place[robots] = places
        events = []
        for row in due[blocked].tolist():
            robot, place = int(observations.robot[row]), observations.pose[row, :2]
            if self._followers.only_turns(robot):  # no way turns it
                continue
            way = self._controllers.reroute(observations, row)
            if instead := way is None and self._beside > 0:
                way = self._controllers.approach(observations, row, self._beside)
            if way is None or not len(way) or np.hypot(*(way[-1] - place)) <= (self._near if instead else _REACHED):
                self._drop(robot)
                if instead and way is not None:  # it is there already
                    self._skip(robot)
                continue
            if robot not in self._ways:
                events.append(Event(stamp=observations.now, kind="detour", robot=robot))
            self._ways[robot] = np.asarray(way, float)
            (self._instead.add if instead else self._instead.discard)(robot)
        return events

    def lay(self, observations: Observations) -> Observations:
        """The same observations with detours in the place of the paths they go around."""
        if not self._ways:
            return observations
        foot, begin, end = observations.foot.copy(), observations.begin.copy(), observations.end.copy()
        yaw = observations.yaw.copy()
        points, count = [observations.points], len(observations.points)
        for row in np.flatnonzero(np.isin(observations.robot, list(self._ways))).tolist():
            way = self._ways[int(observations.robot[row])]
            whole = bool((way[-1] == observations.points[observations.end[row] - 1]).all())
            foot[row] = observations.pose[row, :2]
            begin[row], end[row] = count, count + len(way)
            yaw[row] = yaw[row] if whole else np.nan
            points.append(way)
            count += len(way)
        laid = np.concatenate(points)
        return attrs.evolve(observations, foot=foot, points=laid, begin=begin, end=end, yaw=yaw)
