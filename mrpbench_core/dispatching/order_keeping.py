"""Dispatchers that release each move once the moves that precede it in some order are out of its way."""

import copy
from collections.abc import Mapping
from typing import Self

import attrs
import numpy as np

from mrpbench_core.api import Dispatcher, DispatchError, DispatcherSession, option
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.dispatching.dependency_graph import REACHED, DependencyGraph
from mrpbench_core.dispatching.speed_profiles import PERIOD, SpeedProfiles
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32, read_only
from mrpbench_core.model.execution.orders import FleetView, Orders
from mrpbench_core.model.planning.plan import Paths, Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.type2_edges import Moves


@attrs.frozen(kw_only=True)
class OrderKeepingDispatcher(Dispatcher):
    """The options of a dispatcher whose session is an `OrderKeepingSession`."""

    group_margin: float = option(
        0.03,
        help="distance beyond their radii that two robots of a rotation must keep if they move exactly in step; the "
        "navigator waypoints needs 0.0283 m, other navigators may need more",
        unit="m",
        validator=attrs.validators.ge(0),
    )
    lookahead: int = option(
        8,
        help="segments released at most beyond the one under way; a new plan must keep the released segments",
        validator=attrs.validators.ge(1),
    )
    request_ahead: int = option(
        2,
        help="segments before a door, lift or mutex at which a robot asks for it, once the robots before it have left",
        validator=attrs.validators.ge(0),
    )
    speed_profiles: bool = option(
        False, help="robots that would have to wait drive slowly before, so that they need not stop"
    )
    speed_margin: float = option(
        0.5,
        help="time by which a robot that drives slowly comes later to where it waits than it may go on; it brakes "
        "otherwise, because it may go on only when it is there",
        unit="s",
        validator=attrs.validators.ge(0),
    )

    def idle_options(self) -> Mapping[str, str]:
        """Return options that the others make idle."""
        return {} if self.speed_profiles else {"speed_margin": "speed_profiles is false"}


class OrderKeepingSession(DispatcherSession):
    """Releases one plan after another, each in its own order unless `retime` is told another one."""

    def __init__(self, options: OrderKeepingDispatcher, problem: Problem, plan: Plan) -> None:
        self.options = options
        self.counts = np.zeros((2, len(problem)), np.int64)
        """Counts i8[2,n] of leading segments reached and cleared."""
        self.released: Int32 = np.zeros(len(problem), np.int32)
        self._view_counts = self.released, self.released
        """What was reached and cleared in the view before."""
        self.plan = plan
        self.adopt(problem, plan)

    def adopt(self, problem: Problem, plan: Plan, cut: Int32 | None = None) -> None:
        """Continue with `plan`; released segments remain released.

        Raises:
            DispatchError: the plan has faults or conflicts, or robots wait for one another in a cycle that is not a
                rotation, or in a rotation that their footprints and `group_margin`, or a door, lift or mutex, do not
                allow. Or it does not contain the released segments, or it lets a robot pass first where another one is
                on its way already. The session then continues with its old plan.
        """
        report = check_plan(problem, plan, conflict_limit=3)
        if not report.valid:
            raise DispatchError("; ".join(map(str, report.faults[:3] + report.conflicts)))
        gone: Int32 = np.zeros(len(problem), np.int32) if cut is None else cut
        old, new = (Paths.of(paths) for paths in (self.plan.paths, plan.paths))
        for robot in _differing(old.part(gone, self.released), new.part(np.zeros_like(gone), self.released - gone)):
            count = self.released[robot]
            raise DispatchError(f"the new path of robot {robot} does not begin with the {count} segments released")
        counts, released = np.maximum(self.counts - gone, 0), self.released - gone
        committed: Int32 = np.maximum(released, problem.committed).astype("i4")
        graph = DependencyGraph(problem, plan, self.options.group_margin, self.options.request_ahead, counts)
        graph.commit(committed)
        self.problem, self.plan, self.graph, self.counts = problem, plan, graph, counts
        self._speed: Float = np.zeros(0)
        self._profiles = (
            SpeedProfiles(problem, graph, self.options.speed_margin) if self.options.speed_profiles else None
        )
        self._profiles_due = -np.inf
        self._free = graph.released.copy()
        self._begin_to_release(committed)

    def waits_for(self, robot: int) -> list[int]:
        """Return the robots that come first in the current order, of which the dispatcher does not know that they have
        passed.
        """
        return self.graph.blockers(robot)

    def _copied(self) -> Self:
        """A copy for `DispatcherSession.copied`; a derived class copies what else it changes in place."""
        twin = copy.copy(self)
        twin.graph = self.graph.copied()
        twin._profiles = self._profiles and self._profiles.of(twin.graph)
        return twin

    def retime(self, moves: Moves, chosen: Bool) -> None:
        """Release the plan from now on in the order that its moves have at other times.

        Args:
            moves: at the new times.
            chosen: bool[m] as in `DependencyGraph.retime`.

        Raises:
            DispatchError: as `DependencyGraph.retime`; the order then remains as it was.
        """
        self.graph.retime(moves, chosen, self.released)
        self._begin_to_release(self.released)

    def _begin_to_release(self, committed: Int32) -> None:
        self.orders: Orders | None = None
        self.released = committed
        self._release()

    def update(self, now: float, view: FleetView) -> Orders:
        """Release the moves that no longer wait for anything, given the progress of the robots."""
        counts = self._progress(view)
        slowed = self._profiles is not None and now >= self._profiles_due
        if slowed and self._profiles is not None:
            self._speed, self._profiles_due = self._profiles.speed(counts, view.pose[:, :2]), now + PERIOD
            self._free = self.graph.released.copy()  # as these limits assume
        if self.orders is None or counts is not self.counts or self.graph.requests or slowed:
            self.orders = self._orders(view, counts)
        return self.orders

    def _progress(self, view: FleetView) -> Int:
        """The counts i8[2,n] of leading segments reached and cleared: the same array while none changes."""
        if view.reached is self._view_counts[0] and view.cleared is self._view_counts[1]:
            return self.counts
        self._view_counts = view.reached, view.cleared
        counts = np.maximum(self.counts, self._view_counts)
        return counts if np.count_nonzero(counts != self.counts) else self.counts

    def _orders(self, view: FleetView, counts: Int) -> Orders:
        if changed := counts is not self.counts:
            self.counts = counts
            self.graph.update(counts)
        requested = self.graph.request(counts, view.granted)
        if requested or changed:
            self._release()
            if len(self._speed):  # robots that may go on now do not wait for the next profile
                self._speed = np.where(self.graph.released > self._free, np.inf, self._speed)
        requests = self.graph.requests.pairs()
        in_step = self.graph.in_step(counts[REACHED])
        return Orders(released=self.released, requests=requests, in_step=in_step, speed=self._speed)

    def _release(self) -> None:
        ahead = (self.counts[REACHED] + (1 + self.options.lookahead)).astype(np.int32)
        self.released = read_only(np.maximum(self.released, np.minimum(self.graph.released, ahead)))


def _differing(old: Paths, new: Paths) -> list[int]:
    """The robots whose paths use different edges."""
    differs = old.size != new.size
    same = ~differs[old.robot]
    unequal = old.edge[same] != new.edge[~differs[new.robot]]
    differs[old.robot[same][unequal]] = True
    return np.flatnonzero(differs).tolist()
