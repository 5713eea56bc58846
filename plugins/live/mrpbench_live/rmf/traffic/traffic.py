"""What the components of one run share: the robots, where they are to go, and the plans that they were sent."""

import math
import time
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import attrs
import numpy as np

from mrpbench_core.api import Event, Float, Goals, Int, Int32, Plan, Problem
from mrpbench_core.files.printing import printable
from mrpbench_live.rmf.messages import CODE_TEMPORARILY_UNREACHABLE, Messages, plan_key, stamp
from mrpbench_live.rmf.traffic.composing import Composed, compose
from mrpbench_live.rmf.traffic.destinations import RefusedError, Wish, wish_of
from mrpbench_live.rmf.traffic.participants import Participants
from mrpbench_live.rmf.traffic.posting import Blockers, Posted, Waypoints, message_of
from mrpbench_live.rmf.wire import LEAST_S, Wire

PACKAGE = "rmf_prototype_msgs"
NOWHERE = bytes(16)
"""Session of the plans of robots that have no destination, and have to make way."""
LONGEST_S = 0.5
"""Simulated seconds at most from a new destination until there is a plan for it, while others come."""


class Traffic:
    """The traffic of one run.

    Args:
        messages: the types.
        wire: that sends and receives them.
        names: of the robots.
    """

    def __init__(self, messages: Messages, wire: Wire, names: Sequence[str]) -> None:
        self._messages, self.wire, self._names = messages, wire, names
        self.participants = Participants(wire, names)
        self.wishes: dict[int, Wish] = {}
        """Where each robot is to go, in the order in which that was asked."""
        self._waiting: set[int] = set()
        """Robots at whose destinations others are."""
        self.unplanned: dict[int, str] = {}
        """Why some robots need another plan."""
        self._since = math.inf
        """Simulated seconds at which the first of them came."""
        self._quiet = True
        """No destination came when robots were heard last."""
        self.posted: dict[int, Posted] = {}
        """The plan of each robot."""
        self._unsent: dict[int, Callable[[], Any]] = {}
        """Makes the message of each plan that has not been sent yet."""
        self._position: Float = np.empty((0, 2))
        """f8[v,2] of the roadmap."""
        self._versions: dict[bytes, int] = {}
        self._sessions = 0
        """Plans that were made for all robots together."""
        self._released: dict[int, int] = {}
        """The waypoint that each robot was released to."""
        self._shown: dict[int, int] = {}
        """The waypoint that each robot had reached when `places` was called before."""

    def hear(self, now: float, problem: Problem) -> list[Event]:
        """Take in destinations and errors; return what the recording should say.

        Args:
            now: simulated seconds.
            problem: its roadmap has the destinations.
        """
        events = []
        level = problem.roadmap.level[problem.start]
        for robot, destination in _all_of(self.participants.destinations):
            known = self.wishes.get(robot)
            if known is not None and known.session == bytes(destination.session.uuid):
                continue
            try:
                wish = wish_of(destination, problem.roadmap, int(level[robot]))
            except RefusedError as refused:
                self._refuse(robot, bytes(destination.session.uuid), refused.code, refused.message)
                events.append(Event(stamp=now, kind="destination_refused", robot=robot, detail=refused.message))
                continue
            self.wishes.pop(robot, None)
            self._waiting.discard(robot)
            self.wishes[robot] = wish
            self.unplanned[robot] = f"{self._names[robot]} has another destination"
            x, y = problem.roadmap.position[wish.vertex].tolist()
            events.append(Event(stamp=now, kind="destination", robot=robot, detail=f"({x:g}, {y:g})"))
        for robot, error in _all_of(self.participants.errors):
            posted = self.posted.get(robot)
            if posted is not None and posted.key == plan_key(error.plan_id):
                detail = printable(f"{error.error.code} {error.error.message}")[:300]
                events.append(Event(stamp=now, kind="plan_error", robot=robot, detail=detail))
                self.unplanned[robot] = f"{self._names[robot]} asks for another plan"
        self._quiet = not any(event.kind == "destination" for event in events)
        self._since = min(self._since, now) if self.unplanned else math.inf
        return events

    def replan(self, now: float) -> str:
        """Return why there has to be another plan now, or nothing.

        Destinations that are posted together come one after another. Planned one by one, two robots that swap their
        destinations would need two plans, and the first destination would be refused as that of the other robot.
        """
        is_time = self._quiet or now >= self._since + LONGEST_S - 1e-9
        return next(iter(self.unplanned.values()), "") if is_time else ""

    def goals(self, ends: Sequence[int]) -> Goals:
        """Return where robots are to go: to their destinations, or to where they end anyway, `ends`[n].

        Where another robot is or will be at a destination, a robot waits until that has another one.
        """
        before, self._waiting = self._waiting, set()
        while (robot := self._robbed(ends)) is not None:
            self._waiting.add(robot)
        for robot in sorted(self._waiting - before):
            session = self.wishes[robot].session
            self._refuse(robot, session, CODE_TEMPORARILY_UNREACHABLE, "another robot is or will be there")
        return tuple(((self.wishes[robot].vertex if self._goes(robot) else end,),) for robot, end in enumerate(ends))

    def _goes(self, robot: int) -> bool:
        """Tell whether a robot has a destination, and may go there."""
        return robot in self.wishes and robot not in self._waiting

    def _robbed(self, ends: Sequence[int]) -> int | None:
        """The first robot whose destination is that of one before it, or where a robot stays; None: there is none."""
        taken = {end for robot, end in enumerate(ends) if not self._goes(robot)}
        for robot, wish in self.wishes.items():
            if self._goes(robot) and wish.vertex in taken:
                return robot
            taken.add(wish.vertex)
        return None

    def failed(self) -> None:
        """Say that there is no plan to the destinations that are new."""
        for robot in self.unplanned:
            if self._goes(robot):
                session = self.wishes[robot].session
                self._refuse(robot, session, CODE_TEMPORARILY_UNREACHABLE, "no plan to the destination was found")

    def compose(self, problem: Problem, plan: Plan, reached: Int, released: Int, before: Int) -> Composed:
        """Return what a plan says to each robot; those that asked for another one do not keep the one that they have.

        Args:
            problem: that the plan solves.
            plan: of all robots.
            reached: i8[n] leading segments that are over.
            released: i8[n] leading segments that are released.
            before: i8[n] what is `reached`, as segments of the plan before.

        Raises:
            DispatchError: outside robots cannot follow it, see `blockers_of`.
        """
        may_keep = {
            robot: posted
            for robot, posted in self.posted.items()
            if robot not in self.unplanned and posted.key[0] == self._session(robot)
        }
        return compose(problem, plan, reached, released, before, may_keep)

    def post(self, problem: Problem, composed: Composed) -> None:
        """Send a plan, in `serve`, to all robots that it concerns: those with destinations, and those that make way."""
        self._sessions += 1
        self._position = problem.roadmap.position
        kept, before = composed.kept, self.posted
        self.posted = {
            robot: attrs.evolve(before[robot], waypoints=way)
            if robot in kept
            else self._posted(robot, way, composed.blockers[robot])
            for robot, way in enumerate(composed.waypoints)
            if robot in kept or robot in self.wishes or len(way.segments) > 1
        }
        self._released, self._shown = (
            {robot: waypoint for robot, waypoint in waypoints.items() if robot in kept}
            for waypoints in (self._released, self._shown)
        )
        self.unplanned.clear()
        now = stamp(self._messages)
        self._unsent = {robot: made for robot, made in self._unsent.items() if robot in kept} | {
            robot: partial(message_of, self._messages, problem, posted, self.posted, self._names, now)
            for robot, posted in self.posted.items()
            if robot not in kept
        }

    def serve(self, due: float) -> None:
        """Send plans in half of the time that is left, and take in messages until it is `due` as of `time.monotonic`.

        Plans of large fleets so take several control periods, in which robots follow the plans that they have.
        """
        now = time.monotonic()
        until = now + max(LEAST_S, (due - now) / 2)
        while self._unsent and time.monotonic() < until:
            robot = next(iter(self._unsent))
            self.wire.publish(f"{self._names[robot]}/plan", self._unsent.pop(robot)())
        self.wire.serve(due)

    def places(self, robot: int) -> Float:
        """Return the places f8[k,2] (metres) of the waypoints of a robot, see `OutsideRobots.route`."""
        posted, progress = self.posted.get(robot), self.participants.robots[robot].progress
        vertices = np.zeros(0, np.int64) if posted is None else posted.waypoints.vertex[self._shown.get(robot, 0) :]
        if posted is not None and progress is not None and progress[0] == posted.key:
            self._shown[robot] = progress[1]
        found: Float = self._position[vertices]
        return found

    def release(self, released: Int32) -> None:
        """Tell robots that have their plans how far they may drive: `released` i4[n] leading segments."""
        for robot, posted in self.posted.items():
            if robot in self._unsent:
                continue
            waypoint = posted.waypoints.last(int(released[robot]))
            if waypoint != self._released.get(robot):
                self._released[robot] = waypoint
                message = self._messages.new(f"{PACKAGE}/PlanRelease", waypoint_id=waypoint, plan_id=posted.plan_id)
                self.wire.publish(f"{self._names[robot]}/plan/release", message)

    def reached(self, before: Int32) -> Int:
        """Return the leading segments i8[n] that are over by what robots report, at least those `before` i4[n]."""
        found: Int = before.astype(np.int64)
        for robot, posted in self.posted.items():
            progress = self.participants.robots[robot].progress
            if progress is not None and progress[0] == posted.key:
                segments = posted.waypoints.segments
                found[robot] = max(found[robot], int(segments[min(progress[1], len(segments) - 1)]))
        return found

    def _session(self, robot: int) -> bytes:
        """The session of a plan that is made for a robot now."""
        return self.wishes[robot].session if self._goes(robot) else NOWHERE

    def _posted(self, robot: int, waypoints: Waypoints, blockers: Blockers) -> Posted:
        session = self._session(robot)
        key = robot.to_bytes(4) + session
        version = self._versions[key] = self._versions.get(key, -1) + 1
        uuid = self._messages.new("unique_identifier_msgs/UUID", uuid=list(session))
        plan_id = self._messages.new(
            f"{PACKAGE}/PlanId", destination_session=uuid, mapf_session=self._sessions, plan_version=version
        )
        return Posted(key=plan_key(plan_id), plan_id=plan_id, waypoints=waypoints, blockers=blockers)

    def _refuse(self, robot: int, session: bytes, code: int, text: str) -> None:
        error = self._messages.new(f"{PACKAGE}/Error", code=code, message=text)
        uuid = self._messages.new("unique_identifier_msgs/UUID", uuid=list(session))
        message = self._messages.new(f"{PACKAGE}/DestinationError", error=error, session=uuid)
        self.wire.publish(f"{self._names[robot]}/destination/error", message)


def _all_of(newest: dict[int, Any]) -> list[tuple[int, Any]]:
    """Take out what has come."""
    found = list(newest.items())
    newest.clear()
    return found
