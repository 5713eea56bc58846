"""The interface `rmf`: every robot is a participant of Open-RMF for an outside plan server and plan executor."""

import math
import time
from collections.abc import Sequence
from functools import partial
from typing import Any, Literal

import attrs
import numpy as np
from attrs.validators import ge, gt

from mrpbench_core.api import Event, option
from mrpbench_core.files.printing import printable
from mrpbench_live.fleet.interface import Connection, Interface
from mrpbench_live.fleet.paths import FleetPaths, FleetState
from mrpbench_live.fleet.site import Site
from mrpbench_live.rmf.messages import PlanKey, messages_of, plan_key, stamp
from mrpbench_live.rmf.robots.follower import Follower, PlanFaultError
from mrpbench_live.rmf.wire import DISCOVERY, Wire

DISCOVERY_S = 1.0
"""Seconds between two lists of participants."""
LONGEST = 300
"""Characters of what the recording says of a message, at most."""


@attrs.frozen(kw_only=True)
class Rmf(Interface):
    """Robots of next-generation Open-RMF over DDS.

    Each publishes `odom` and `plan/progress` below its name, and follows what comes on `plan`.
    """

    domain: int = option(0, help="DDS domain, the ROS_DOMAIN_ID of the other side", validator=ge(0))
    obeys: Literal["plan", "release"] = option(
        "plan",
        help="what lets robots go on: `plan`, the progress of the blockers that plans name; `release`, an executor",
    )
    rate: float = option(10.0, help="messages of each robot on each topic", unit="Hz of wall time", validator=gt(0))
    messages: str = option("", help="file of message definitions; empty: those of mrpbench-live")

    def connect(self, site: Site, paths: FleetPaths) -> "RmfFleet":
        """Join the domain.

        Raises:
            InputError: there is no access to it, a library is missing, or the definitions cannot be read.
        """
        return RmfFleet(self, site, paths)


class RmfFleet(Connection):
    """The robots of one run."""

    def __init__(self, recipe: Rmf, site: Site, paths: FleetPaths) -> None:
        self._messages = messages_of(recipe.messages)
        self._wire = Wire(self._messages, recipe.domain)
        self._names, self._obeys_plans = site.robots, recipe.obeys == "plan"
        self._state: FleetState | None = None
        self._events: list[Event] = []
        self._progress: dict[str, tuple[PlanKey | None, float]] = {}
        """The plan of each participant, and how far it is."""
        self._followers = [Follower(site, paths, robot, self._progress_of) for robot in range(len(site.robots))]
        self._period, now = 1 / recipe.rate, time.monotonic()
        self._due = now + self._period * np.arange(len(site.robots)) / max(1, len(site.robots))  # not all at once
        self._discovery_due = now
        self._odometry = [self._new_odometry(name) for name in site.robots]
        participant = "rmf_prototype_msgs/Participant"
        participants = [self._messages.new(participant, name=name) for name in site.robots]
        self._participants = self._messages.new("rmf_prototype_msgs/ParticipantList", participants=participants)
        for robot, name in enumerate(site.robots):
            self._progress[name] = None, 0.0
            for topic in ("odom", "plan/progress", "plan/error"):
                self._wire.advertise(f"{name}/{topic}")
            self._wire.subscribe(f"{name}/plan", partial(self._take, robot))
            if not self._obeys_plans:
                self._wire.subscribe(f"{name}/plan/release", self._followers[robot].release)

    def exchange(self, state: FleetState, due: float) -> Sequence[Event]:
        """Publish where robots are, take in plans, and let robots go on as far as they may."""
        self._state, now = state, time.monotonic()
        if now >= self._discovery_due:
            self._discovery_due = now + DISCOVERY_S
            for topic in DISCOVERY:
                self._wire.publish(topic, self._participants)
        for robot in np.flatnonzero(now >= self._due).tolist():
            self._due[robot] = max(self._due[robot] + self._period, now)
            self._report(robot, state)
        self._wire.serve(due)
        if self._obeys_plans:
            for robot, follower in enumerate(self._followers):
                self._note_progress(robot, state)
                follower.watch()
        events, self._events = self._events, []
        return events

    def close(self) -> None:
        """Leave the domain."""
        self._wire.close()

    def _take(self, robot: int, plan: Any) -> None:
        assert self._state is not None
        try:
            said = self._followers[robot].take(plan, int(self._state.level[robot]))
        except PlanFaultError as fault:
            error = self._messages.new("rmf_prototype_msgs/Error", code=fault.code, message=fault.message)
            refusal = self._messages.new("rmf_prototype_msgs/PlanError", error=error, plan_id=plan.plan_id)
            self._wire.publish(f"{self._names[robot]}/plan/error", refusal)
            self._note(robot, "plan_refused", fault.message)
        else:
            if said is not None:
                self._note(robot, "plan_accepted", said)

    def _note(self, robot: int, kind: str, detail: str) -> None:
        assert self._state is not None
        self._events.append(Event(stamp=self._state.now, kind=kind, robot=robot, detail=printable(detail)[:LONGEST]))

    def _report(self, robot: int, state: FleetState) -> None:
        """Publish the position of a robot, and its progress if it has a plan."""
        odometry, name = self._odometry[robot], self._names[robot]
        x, y, yaw = state.pose[robot].tolist()
        pose, twist = odometry.pose.pose, odometry.twist.twist
        pose.position.x, pose.position.y = x, y
        pose.orientation.z, pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        twist.linear.x, twist.linear.y, twist.angular.z = state.velocity[robot].tolist()
        odometry.header.stamp = stamp(self._messages)
        self._wire.publish(f"{name}/odom", odometry)
        follower = self._followers[robot]
        if follower.key is not None:
            value, reached, target = follower.progress(x, y)
            progress = self._messages.new(
                "rmf_prototype_msgs/Progress",
                progress=value,
                reached_waypoint=reached,
                target_waypoint=target,
                plan_id=follower.plan_id,
            )
            self._wire.publish(f"{name}/plan/progress", progress)

    def _note_progress(self, robot: int, state: FleetState) -> None:
        follower = self._followers[robot]
        if follower.key is not None:
            x, y = state.pose[robot, :2].tolist()
            self._progress[self._names[robot]] = follower.key, follower.progress(x, y)[0]

    def _progress_of(self, name: str, key: PlanKey) -> float:
        """How far a participant is along a plan; it is listened to from the first time on that it is asked for."""
        if name not in self._progress:
            self._progress[name] = None, 0.0
            self._wire.subscribe(f"{name}/plan/progress", lambda message: self._hear(name, message))
        known, value = self._progress[name]
        return value if known == key else 0.0

    def _hear(self, name: str, progress: Any) -> None:
        self._progress[name] = plan_key(progress.plan_id), float(progress.progress)

    def _new_odometry(self, name: str) -> Any:
        odometry = self._messages.new("nav_msgs/Odometry", child_frame_id=f"{name}/base_link")
        odometry.header.frame_id = "map"
        return odometry
