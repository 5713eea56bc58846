"""Decides when the current plan is replaced during execution, and requests the new one."""

import math
from collections.abc import Callable, Sequence

import attrs
import numpy as np

from mrpbench_core.api.predictor import PredictorSession
from mrpbench_core.config.settings import Replanning, RunConfig
from mrpbench_core.engine.execution.commitments import commitments, not_ahead, remaining
from mrpbench_core.engine.execution.cutting import driven, without
from mrpbench_core.engine.execution.destinations import Destinations
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.execution.orders import FleetView
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import Paths, Plan, PlanResult
from mrpbench_core.model.planning.problem import Feature, Problem, ends_of, features_of
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.type2_edges import moves_of
from mrpbench_core.model.planning.window import leads_to_goals
from mrpbench_core.model.runs.routing import Router

RETRY_S = 1.0
"""Simulated seconds after which a planner that found no new plan is asked again, unless the settings say more."""

Ask = Callable[[Problem], tuple[PlanResult, str | None, float]]
"""Calls the planner; returns its answer, why there is no plan to use, and the wall seconds beyond its budget."""


@attrs.frozen(kw_only=True)
class Revision:
    """A new plan that waits to take effect."""

    due: float
    """simulated seconds."""
    reason: str
    problem: Problem
    plan: Plan | None
    routes: Sequence[Route] = ()
    fault: str = ""
    """The reason why there is no plan, or why it must not be used."""
    leads: Bool
    """bool[n]: the path ends at a goal of its robot, not at the end of the window."""
    cut: Int32
    """i4[n] leading segments of the plan before that are left out."""
    unchanged: Int32
    """i4[n] leading waypoints of its routes that are those of the routes before."""
    destinations: Destinations
    """Where it leads."""


class Replanner:
    """Decides when a new plan is needed and requests it; nothing is released until the new plan takes effect.

    Args:
        settings: when to replan, and how long that takes.
        ask: calls the planner.
        router: turns plans into routes.
        problem: of the first plan.
        plan: the first plan.
        supports: features that the planner supports; with `since`, plans leave out what robots drove long ago.
        reads_remaining: the planner uses what remains of the current plan.
        chooses_goals: the planner decides where robots go.
        prediction: of what no plan moves; new plans keep away from it where they can.
    """

    def __init__(
        self,
        settings: Replanning,
        ask: Ask,
        router: Router,
        problem: Problem,
        plan: Plan,
        supports: frozenset[Feature] = frozenset(),
        reads_remaining: bool = False,
        chooses_goals: bool = False,
        prediction: PredictorSession | None = None,
    ) -> None:
        self.supports, self.yaw = supports, router.final_yaw
        self._cuts = Feature.SINCE in supports and router.plan_filter == "none"  # which may shift waypoints anywhere
        self._reads_remaining, self._chooses_goals = reads_remaining, chooses_goals
        self._settings = settings
        self._ask, self._prediction = ask, prediction
        self._router = router
        self._last = 0.0
        self._retry = max(RETRY_S, settings.delay or 0.0, settings.period or 0.0)
        self._not_before = 0.0
        self.pending: Revision | None = None
        """Requested, not executed yet."""
        self.interval = max(settings.period or 0.0, settings.delay or 0.0)
        """Simulated seconds within which the settings may call for a new plan."""
        self.failing = False
        """The last request led to no plan."""
        self.use(problem, plan)

    def use(self, problem: Problem, plan: Plan) -> None:
        """Note that a plan is executed from now on."""
        self.failing = False
        self.problem, self.plan, self.moves = problem, plan, moves_of(problem, plan)
        self._paths = Paths.of(plan.paths)
        self._first = self._paths.first
        self._arrival: Int = self._first[:-1].copy()
        self._arrival[self.moves.robot] = self._first[self.moves.robot] + self.moves.segment + 1  # the last move counts
        self._leave: Int = np.append(self._paths.leave, 0)  # one more to index at the end

    def observe(self, pose: Float, scans: Sequence[ScanBatch]) -> None:
        """Take what the robots at `pose` f8[n,3] see now."""
        if self._prediction is not None and scans:
            self._prediction.observe(pose, scans)

    def reason(self, now: float, view: FleetView, wish: str | None) -> str | None:
        """Return the reason why a new plan is needed now, or None; `wish` is that of others."""
        settings = self._settings
        if now < self._not_before:
            return None
        if wish is not None:
            return wish
        if settings.period is not None and now - self._last >= settings.period - 1e-9:
            return f"{settings.period:g} s have passed"
        if settings.delay is not None:
            late = self._late(now, view.reached)
            robot = int(late.argmax())
            if late[robot] > settings.delay:
                return f"robot {robot} is {late[robot]:.1f} s late"
        return None

    def request(
        self,
        now: float,
        reason: str,
        view: FleetView,
        released: Int32,
        to: Destinations,
        roadmap: Roadmap,
    ) -> None:
        """Ask for a plan that begins with what is `released` i4[n], and leads `to` its destinations.

        The planner gets `roadmap` instead of the problem's, since it may not always use all of that.

        It takes effect after the latency, and later if the planner exceeds its budget of wall time.
        """
        tick = self.problem.roadmap.tick
        due = now + self._settings.latency
        ready = math.ceil(now / tick - 1e-9) + self._left(view)
        problem, plan = self.problem, self.plan
        if Feature.SINCE in self.supports:
            problem, plan = not_ahead(problem, plan, view.reached, math.floor(now / tick + 1e-9))
        prefix = commitments(problem, plan, released, view.reached, ready, math.ceil(due / tick - 1e-9))
        cut: Int32 = np.zeros(len(prefix), np.int32)
        if self._cuts:
            cut = driven(plan, view.reached, view.cleared)
        current = attrs.evolve(problem, commitments=prefix)
        problem = without(problem, prefix, cut)
        if self._reads_remaining:
            problem = attrs.evolve(problem, remaining=remaining(plan, released, current))
        if self._settings.window is not None:
            horizon = max(ends_of(problem)) + math.ceil(self._settings.window / tick - 1e-9)
            problem = attrs.evolve(problem, horizon=horizon)
        problem = attrs.evolve(problem, goals=((),) * len(problem) if self._chooses_goals else to.goals)
        problem = attrs.evolve(problem, features=features_of(problem) | (self.problem.features & {Feature.FOOTPRINTS}))
        asked = problem if roadmap is problem.roadmap else attrs.evolve(problem, roadmap=roadmap)
        constrained = asked if self._prediction is None else self._prediction.constrained(asked, now)
        result, fault, late = self._ask(constrained)
        if fault and constrained is not asked:
            reason = f"{reason}; not around what is predicted: {fault}"
            result, fault, later = self._ask(asked)
            late += later
        due += late
        self._last, self._not_before = now, due
        new_plan = None if fault else result.plan
        if new_plan is not None and len(new_plan.paths) > len(problem):
            new_plan = Plan(paths=new_plan.paths[: len(problem)])
        leads = np.ones(len(problem), bool) if new_plan is None else leads_to_goals(problem, new_plan)
        router = attrs.evolve(self._router, problem=problem, final_yaw=np.where(leads, to.yaw, np.nan))
        routes: Sequence[Route] = () if new_plan is None else router(new_plan)
        self.pending = Revision(
            due=due,
            reason=reason,
            problem=problem,
            plan=new_plan,
            routes=routes,
            fault=fault or "",
            leads=leads,
            cut=cut,
            unchanged=np.zeros_like(cut) if router.plan_filter != "none" else view.reached - cut,
            destinations=to,
        )

    def take_due(self, now: float) -> Revision | None:
        """Return the new plan when it takes effect, else None."""
        if self.pending is None or now < self.pending.due - 1e-9:
            return None
        revision, self.pending = self.pending, None
        return revision

    def failed(self, now: float) -> None:
        """Note that the new plan could not be used, and delay the next request."""
        self._not_before, self.failing = now + self._retry, True

    def _late(self, now: float, reached: Int32) -> Float:
        """Seconds f8[n] by which robots are late with the first segment that they have not reached; 0 = arrived."""
        under_way = self._first[:-1] + reached < self._arrival
        planned = self._leave[np.minimum(self._first[:-1] + reached, len(self._leave) - 1)]
        late: Float = np.where(under_way, now - planned * self.problem.roadmap.tick, 0.0)
        return late

    def _left(self, view: FleetView) -> Int:
        """Ticks i8[n] that robots need from where they are to the end of the first segment not reached."""
        left = np.zeros(len(self.problem), np.int64)
        roadmap = self.problem.roadmap
        robots = np.flatnonzero(view.reached < self._paths.size)
        edge = self._paths.edge[self._first[robots] + view.reached[robots]]
        robots, edge = robots[edge >= 0], edge[edge >= 0]
        tail, head = roadmap.position[roadmap.edges[edge]].reshape(-1, 2, 2).transpose(1, 0, 2)
        length, ahead = (np.hypot(*(head - place).T) for place in (tail, view.pose[robots, :2]))
        share = np.minimum(1.0, np.divide(ahead, length, out=np.ones_like(length), where=length > 0))
        left[robots] = np.ceil(share * roadmap.duration[self.problem.profile[robots], edge])
        return left


def replanning_fault(config: RunConfig) -> str | None:
    """Return the reason why the planner cannot replan during execution as configured, or None."""
    replanning = config.replanning
    wanted = replanning.delay is not None or replanning.period is not None or config.tasks is not None
    wanted |= bool(config.faults) and config.faults.reaction != "wait"
    if config.executes and wanted and Feature.COMMITMENTS not in config.planner.supports:
        return "does not support commitments, which replanning needs; `rolling_horizon` plans with it"
    if config.executes and replanning.window is not None and Feature.HORIZON not in config.planner.supports:
        return "does not support a horizon, which `replanning.window` needs; `rolling_horizon` plans with it"
    planner = config.planner
    plain = Feature.PROFILES in planner.supports and not (planner.chooses_goals or planner.reads_remaining)
    if config.executes and wanted and replanning.prediction is not None and not plain:
        return (
            "does not support `replanning.prediction`, which adds robots with a profile, goals and paths of their own"
        )
    return None
