"""The planner, the dispatcher and the task source `live`: paths, releases and work come from outside.

A run has a process of its own, so its three components share one `_Run`.
"""

import sys
from collections.abc import Sequence
from typing import ClassVar

import attrs
import numpy as np
from attrs.validators import gt

from mrpbench_core.api import (
    Budget,
    Dispatcher,
    DispatchError,
    DispatcherSession,
    Event,
    Feature,
    Fleet,
    FleetView,
    InputError,
    Int,
    Int32,
    Mode,
    Orders,
    Plan,
    Planner,
    PlanResult,
    PlanStatus,
    Problem,
    Promise,
    Roadmap,
    Task,
    TaskSource,
    TaskStream,
    World,
    option,
    wrapped,
)
from mrpbench_live.fleet.interface import Interface
from mrpbench_live.fleet.pace import Pace
from mrpbench_live.fleet.paths import FleetPaths, FleetState
from mrpbench_live.fleet.plans import PlannedMoves, continued
from mrpbench_live.fleet.site import Site


class _Run:
    """What the components of one run share."""

    site: Site | None = None
    paths: FleetPaths | None = None


@attrs.frozen(kw_only=True)
class LiveTasks(TaskSource):
    """The work of the fleet is known to an outside party alone; the run lasts until `limits.execution`."""

    live: ClassVar[bool] = True

    def start(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> TaskStream:
        """Begin a stream without tasks."""
        del seed
        _Run.site, _Run.paths = Site(world, roadmap, fleet), None
        return _NoTasks()


class _NoTasks(TaskStream):
    def released(self, now: float, finished: int) -> Sequence[Task]:  # noqa: ARG002 - there are none
        return ()


@attrs.frozen(kw_only=True)
class LivePlanner(Planner):
    """Gives each robot the path that the outside party wants, which decides who makes way for whom."""

    live: ClassVar[bool] = True
    supports: ClassVar[frozenset[Feature]] = frozenset(Feature)
    promises: ClassVar[frozenset[Promise]] = frozenset()
    chooses_goals: ClassVar[bool] = True

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Continue what is released by what the outside party wants."""
        del budget
        paths = _Run.paths
        if paths is None:
            raise InputError("planner: `live` plans for `dispatcher: live` only")
        return PlanResult(status=PlanStatus.SOLVED, plan=continued(problem, paths))


@attrs.frozen(kw_only=True)
class LiveDispatcher(Dispatcher):
    """Runs against a clock, and releases what an outside party releases.

    It releases the next moves only as far as a robot needs to be able to stop, so that an order can still be cancelled.
    """

    live: ClassVar[bool] = True

    interface: Interface = option(help="how the outside party sees the fleet, and tells it where to go")
    pace: float = option(1.0, help="simulated seconds per second of wall time", validator=gt(0))
    interval: float = option(0.2, help="least time between two changes of paths", unit="s", validator=gt(0))

    def start(self, problem: Problem, plan: Plan) -> DispatcherSession:
        """Connect with the outside party.

        Raises:
            InputError: the components that it needs are not chosen, or the outside party cannot be reached.
        """
        if _Run.site is None:
            raise InputError("dispatcher: `live` needs `tasks: live` and `planner: live`; `mrpbench serve` sets them")
        _Run.paths = FleetPaths(problem.roadmap, problem.start.astype(np.int64))
        return LiveSession(self, _Run.site, _Run.paths, problem, plan)


class LiveSession(DispatcherSession):
    """One run with its outside party."""

    def __init__(self, recipe: LiveDispatcher, site: Site, paths: FleetPaths, problem: Problem, plan: Plan) -> None:
        self._paths, self._interval = paths, recipe.interval
        self._pace = Pace(recipe.pace)
        robots = site.fleet.robots
        self._ahead = np.array([robot.max_speed**2 / (2 * robot.acceleration) + robot.max_speed for robot in robots])
        """f8[n] metres that are released ahead of a robot at least: it stops within them, and never brakes for want."""
        self._moves = PlannedMoves(problem, plan, np.zeros(len(problem), np.int64))
        self._released: Int = np.zeros(len(problem), np.int64)
        self._changed_at = -np.inf
        self._before: tuple[float, np.ndarray] | None = None
        self._connection = recipe.interface.connect(site, paths)

    def update(self, now: float, view: FleetView) -> Orders:
        """Report the fleet, wait until `now` is due, and release."""
        paths = self._paths
        paths.passed = self._moves.made(view.reached)
        events = [*self._connection.exchange(self._state(now, view), self._pace.due(now))]
        if change := self._pace.change(now):
            events.append(Event(stamp=now, kind="pace", detail=change))
            sys.stderr.write(f"at {now:.1f} s: {change}\n")
        allowed = np.minimum(paths.allowed, paths.planned)
        released, paths.released = self._moves.release(paths.passed, allowed, self._ahead, self._released)
        self._released = released
        replan = ""
        if paths.changed and now >= self._changed_at + self._interval - 1e-9:
            replan, self._changed_at = f"robot {min(paths.changed)} has another path", now
        return Orders(
            released=released.astype(np.int32), speed=np.maximum(paths.speed, 1e-3), replan=replan, events=tuple(events)
        )

    def adopt(self, problem: Problem, plan: Plan, cut: Int32 | None = None) -> None:
        """Continue with a plan that has the paths of the outside party."""
        gone = np.zeros(len(problem), np.int64) if cut is None else cut.astype(np.int64)
        self._moves = PlannedMoves(problem, plan, self._moves.base + self._moves.moves_before(gone))
        self._released = np.maximum(self._released - gone, problem.committed)
        if (self._moves.base + self._moves.count != self._paths.length).any():
            raise DispatchError("the plan does not have the paths of the outside party: use `planner: live`")
        self._paths.adopt(self._moves.base)

    def close(self) -> None:
        """Leave the outside party."""
        self._connection.close()

    def _state(self, now: float, view: FleetView) -> FleetState:
        """The fleet as protocols report it."""
        pose = view.pose
        velocity = np.zeros_like(pose)
        if self._before is not None and now > self._before[0]:
            change = (pose - self._before[1]) / (now - self._before[0])
            cosine, sine = np.cos(pose[:, 2]), np.sin(pose[:, 2])
            velocity[:, 0] = cosine * change[:, 0] + sine * change[:, 1]
            velocity[:, 1] = cosine * change[:, 1] - sine * change[:, 0]
            velocity[:, 2] = wrapped(pose[:, 2] - self._before[1][:, 2]) / (now - self._before[0])
        self._before = now, pose.copy()
        return FleetState(
            now=now,
            pose=pose,
            level=view.level,
            driving=(view.mode == Mode.FOLLOWING) | (view.mode == Mode.RECOVERING),
            gave_up=view.mode == Mode.ABORTED,
            velocity=velocity,
        )
