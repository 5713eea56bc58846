"""The simulator, the navigator, the planner and the dispatcher `rmf`: outside robots are the robots of a run.

A run has a process of its own, so the four share one `Traffic`.
"""

import sys
from collections.abc import Sequence
from typing import ClassVar

import attrs
import numpy as np
from attrs.validators import ge, gt

from mrpbench_core.api import (
    Budget,
    Controller,
    Dispatcher,
    DispatcherSession,
    Facilities,
    Feature,
    Fleet,
    FleetObservation,
    FleetView,
    Float,
    InputError,
    Inputs,
    Int,
    Int16,
    Int32,
    Mode,
    Motion,
    Navigator,
    NavigatorSession,
    Orders,
    Plan,
    Planner,
    PlannerSession,
    PlanResult,
    PlanStatus,
    Problem,
    Promise,
    Route,
    ScanBatch,
    Simulation,
    Simulator,
    State,
    World,
    option,
)
from mrpbench_core.model.planning.problem import features_of
from mrpbench_live.fleet.overlaps import Overlaps
from mrpbench_live.fleet.pace import Pace
from mrpbench_live.fleet.tracking import Tracker
from mrpbench_live.rmf.messages import messages_of
from mrpbench_live.rmf.traffic.traffic import Traffic
from mrpbench_live.rmf.wire import Wire

SLACK = 1e-6
"""metres."""
STANDING = 0.01
"""m/s below which a robot stands."""


class _Run:
    """What the components of one run share."""

    traffic: Traffic | None = None


def _traffic(kind: str) -> Traffic:
    if _Run.traffic is None:
        raise InputError(f"{kind}: `rmf` needs `simulator: rmf`, which has the robots")
    return _Run.traffic


@attrs.frozen(kw_only=True)
class RmfRobots(Simulator):
    """Outside robots of next-generation Open-RMF over DDS: what they report as odometry counts as the truth.

    A participant is the robot of its name. The recorded robot drives from report to report within the limits of its
    model. Contacts are overlaps of the bodies at these poses.
    """

    live: ClassVar[bool] = True

    domain: int = option(0, help="DDS domain, the ROS_DOMAIN_ID of the other side", validator=ge(0))
    pace: float = option(1.0, help="simulated seconds per second of wall time", validator=gt(0))
    patience: float = option(30.0, help="wall time to wait for all robots", unit="s", validator=gt(0))
    messages: str = option("", help="file of message definitions; empty: those of mrpbench-live")

    def open(
        self,
        world: World,
        fleet: Fleet,
        placements: Float,
        seed: int,
        period: float,
        movers: Sequence[float] = (),
        levels: Int16 | None = None,
    ) -> Simulation:
        """Wait for the robots.

        Raises:
            InputError: a robot is missing or elsewhere; or the world has doors, lifts or movers.
        """
        del seed
        if Facilities(world).names:
            raise InputError("simulator: `rmf` has no doors and no lifts, and the world has")
        if movers:
            raise InputError("simulator: `rmf` has no crowds: leave out `crowds`")
        messages = messages_of(self.messages)
        wire = Wire(messages, self.domain)
        traffic = Traffic(messages, wire, fleet.names)
        starts = dict(zip(fleet.names, map(tuple, placements[:, :2].tolist()), strict=True))
        try:
            traffic.participants.meet(starts, self.patience)
        except BaseException:
            wire.close()
            raise
        _Run.traffic = traffic
        on = np.zeros(len(fleet), np.int16) if levels is None else levels
        return _Reported(traffic, Pace(self.pace), fleet, placements, on, period)


class _Reported(Simulation):
    """The robots as they report themselves."""

    def __init__(
        self, traffic: Traffic, pace: Pace, fleet: Fleet, placements: Float, levels: Int16, period: float
    ) -> None:
        self._traffic, self._pace, self._period, self._steps = traffic, pace, period, 0
        self._tracker = Tracker(fleet.robots, placements, period)
        self._levels, self._overlaps, self._closed = levels, Overlaps(fleet.robots), False
        self._state = State(
            pose=placements.copy(), twist=np.zeros((len(fleet), 2)), level=levels, contacts=np.empty((0, 2), np.int32)
        )

    @property
    def state(self) -> State:
        return self._state

    def step(self, inputs: Inputs) -> State:
        """Listen until the control period is over; the commands are for simulators."""
        del inputs
        self._steps += 1
        now = self._steps * self._period
        if self._steps == 1:
            self._pace.due(0.0)
        self._traffic.wire.serve(self._pace.due(now))
        if change := self._pace.change(now):
            sys.stderr.write(f"at {now:.1f} s: {change}\n")
        for robot, it in enumerate(self._traffic.participants.robots):
            if it.pose is not None:
                self._tracker.report(robot, *it.pose, it.speed)
        self._tracker.step()
        pose = self._tracker.pose
        contacts = self._overlaps.of(pose, self._levels)
        self._state = State(pose=pose, twist=self._tracker.twist, level=self._levels, contacts=contacts)
        return self._state

    def scans(self) -> tuple[ScanBatch, ...]:
        return ()

    def close(self) -> None:
        if not self._closed:
            self._closed, _Run.traffic = True, None
            self._traffic.wire.close()


@attrs.frozen(kw_only=True)
class RmfProgress(Navigator):
    """Reads the progress of the robots of `simulator: rmf`. The configured `controller` is not asked.

    A robot has reached what it reports as reached, and has cleared a segment when it is so far from its start that any
    other robot fits there.
    """

    live: ClassVar[bool] = True

    def start(
        self, fleet: Fleet, world: World, routes: Sequence[Route], controller: Controller, period: float, seed: int
    ) -> NavigatorSession:
        """Begin with robots that stand at the starts.

        Raises:
            InputError: the simulator is another one.
        """
        del world, controller, period, seed
        return _Progress(_traffic("navigator"), fleet, routes)


class _Progress(NavigatorSession):
    """Counts what robots have done."""

    def __init__(self, traffic: Traffic, fleet: Fleet, routes: Sequence[Route]) -> None:
        self._traffic = traffic
        radii = fleet.radii
        self._clearance: list[float] = (radii + radii.max(initial=0.0)).tolist()
        self._reached: Int32 = np.zeros(len(fleet), np.int32)
        self._cleared: Int32 = np.zeros(len(fleet), np.int32)
        self._take(routes)

    def adopt(self, routes: Sequence[Route], cut: Int32 | None = None) -> None:
        gone = np.zeros(len(self._reached), np.int32) if cut is None else cut
        self._reached = (self._reached - gone).astype(np.int32)
        self._cleared = np.maximum(self._cleared - gone, 0).astype(np.int32)
        self._take(routes)

    def _take(self, routes: Sequence[Route]) -> None:
        self._places = [route.waypoint[:, :2] for route in routes]
        self._is_move = [route.is_move.tolist() for route in routes]

    def step(self, now: float, observation: FleetObservation, orders: Orders) -> Motion:
        del now, observation  # what robots report is newer
        reached = np.minimum(self._traffic.reached(self._reached), orders.released).astype(np.int32)
        cleared = self._cleared.copy()
        mode = np.full(len(reached), Mode.FOLLOWING, np.uint8)
        for robot, it in enumerate(self._traffic.participants.robots):
            moves, released = self._is_move[robot], int(orders.released[robot])
            while reached[robot] < released and not moves[reached[robot]]:
                reached[robot] += 1
            assert it.pose is not None
            cleared[robot] = self._cleared_by(robot, int(cleared[robot]), int(reached[robot]), it.pose)
            if reached[robot] >= released and abs(it.speed) < STANDING:
                mode[robot] = Mode.WAITING
        self._reached, self._cleared = reached, cleared
        return Motion(twist=np.zeros((len(reached), 2)), reached=reached, cleared=cleared, mode=mode)

    def _cleared_by(self, robot: int, cleared: int, reached: int, pose: tuple[float, float, float]) -> int:
        """The leading segments whose starts a robot has left; a wait is left with the move after it."""
        places, moves, clearance = self._places[robot], self._is_move[robot], self._clearance[robot] - SLACK
        while True:
            move = next((segment for segment in range(cleared, len(moves)) if moves[segment]), None)
            if move is None or move > reached:
                return cleared
            start, end = places[move], places[move + 1]
            is_through = move < reached and np.hypot(*(end - start)) >= clearance
            if not is_through and np.hypot(pose[0] - start[0], pose[1] - start[1]) < clearance:
                return cleared
            cleared = move + 1


@attrs.frozen(kw_only=True)
class RmfPlans(Planner):
    """Plans with any planner to the destinations that are posted for the robots of `simulator: rmf`.

    Robots without a destination stay where they are, unless the planner lets them make way.
    """

    live: ClassVar[bool] = True
    chooses_goals: ClassVar[bool] = True

    planner: Planner = option(help="the planner")

    @property
    def supports(self) -> frozenset[Feature]:  # type: ignore[override]
        """What the planner supports; it is given one goal for each robot."""
        return self.planner.supports | {Feature.GOAL_SEQUENCES}

    @property
    def promises(self) -> frozenset[Promise]:  # type: ignore[override]
        """What holds whatever the goals are."""
        return self.planner.promises & {Promise.CONFLICT_FREE}

    @property
    def reads_remaining(self) -> bool:  # type: ignore[override]
        """What the planner reads."""
        return self.planner.reads_remaining

    def skip(self, problem: Problem) -> str | None:
        """Return why the planner cannot be used, or None."""
        stand = tuple(((int(vertex),),) for vertex in problem.start)
        return self.planner.skip(_with_goals(problem, stand))

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Plan once."""
        return self.start().plan(problem, budget)

    def start(self) -> PlannerSession:
        """Begin a session of the planner."""
        keeps = Feature.FOLLOWING_FORBIDDEN in self.planner.supports
        return _ToDestinations(self.planner.start(), keeps)


class _ToDestinations(PlannerSession):
    """Asks a planner for ways to destinations.

    Outside robots cannot rotate in step, so it asks at first for a plan in which no robot follows another closely.
    """

    def __init__(self, session: PlannerSession, can_keep_apart: bool) -> None:
        self._session, self._can_keep_apart = session, can_keep_apart

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        traffic = _traffic("planner")
        ends = problem.start.tolist()
        for robot, path in enumerate(problem.commitments):
            ends[robot] = path.end(problem.roadmap, ends[robot])
        asked = _with_goals(problem, traffic.goals(ends))
        result = PlanResult(status=PlanStatus.GAVE_UP)
        if self._can_keep_apart:
            rules = attrs.evolve(problem.rules, following="forbidden")
            features = asked.features | {Feature.FOLLOWING_FORBIDDEN}
            result = self._session.plan(attrs.evolve(asked, rules=rules, features=features), budget)
        if result.plan is None:
            result = self._session.plan(asked, budget)
        if result.plan is None:
            traffic.failed()
        return result


def _with_goals(problem: Problem, goals: tuple[tuple[tuple[int, ...], ...], ...]) -> Problem:
    found = attrs.evolve(problem, goals=goals)
    kept = problem.features & {Feature.FOOTPRINTS, Feature.COMMITMENTS}
    return attrs.evolve(found, features=features_of(found) | kept)


@attrs.frozen(kw_only=True)
class RmfPlanServer(Dispatcher):
    """Posts the plans of `planner: rmf`, and with `release` executes them: any dispatcher decides who may go on.

    With an executor of others, or robots that watch the blockers of their plans themselves, `release` is off; the
    dispatcher must then release no less than they do, such as `adg` with a large `lookahead`.
    """

    live: ClassVar[bool] = True

    dispatcher: Dispatcher = option(help="decides how far along its plan each robot may go")
    release: bool = option(True, help="publish what the dispatcher releases")

    def start(self, problem: Problem, plan: Plan) -> DispatcherSession:
        """Begin with robots that stand.

        Raises:
            InputError: the simulator is another one.
            DispatchError: see `dispatcher`.
        """
        return _PlanServer(_traffic("dispatcher"), self.dispatcher.start(problem, plan), self.release, problem)


class _PlanServer(DispatcherSession):
    """Posts plans, and what a dispatcher releases of them."""

    def __init__(self, traffic: Traffic, session: DispatcherSession, releases: bool, problem: Problem) -> None:
        self._traffic, self._session, self._releases, self._problem = traffic, session, releases, problem
        self._reached: Int = np.zeros(len(problem), np.int64)
        self._released: Int = np.zeros(len(problem), np.int64)

    def update(self, now: float, view: FleetView) -> Orders:
        events = self._traffic.hear(now, self._problem)
        orders = self._session.update(now, view)
        self._reached, self._released = view.reached.astype(np.int64), orders.released.astype(np.int64)
        if self._releases:
            self._traffic.release(orders.released)
        reason = next(iter(self._traffic.unplanned.values()), "")
        if not events and orders.replan == reason:
            return orders
        return attrs.evolve(orders, replan=reason or orders.replan, events=(*orders.events, *events))

    def adopt(self, problem: Problem, plan: Plan, cut: Int32 | None = None) -> None:
        gone = np.zeros(len(problem), np.int64) if cut is None else cut.astype(np.int64)
        reached = np.maximum(self._reached - gone, 0)
        released = np.maximum(self._released - gone, problem.committed)
        composed = self._traffic.compose(problem, plan, reached, released)
        self._session.adopt(problem, plan, cut)
        self._traffic.post(problem, composed)
        self._problem = problem

    def waits_for(self, robot: int) -> Sequence[int] | None:
        return self._session.waits_for(robot)

    def close(self) -> None:
        self._session.close()
