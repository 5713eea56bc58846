"""A planner for one batch, used again and again while robots drive.

Li, Tinka, Kiesel, Durham, Kumar and Koenig, "Lifelong Multi-Agent Path Finding in Large-Scale Warehouses", AAAI 2021,
plan again in every period, and resolve conflicts within a window of time. There robots are at vertices when a plan
begins; here they are on their way.
"""

from collections.abc import Callable, Sequence

import attrs
import numpy as np

from mrpbench_core.api.component import option
from mrpbench_core.api.planner import Planner, PlannerSession, Promise
from mrpbench_core.model.common.arrays import Int, Int32
from mrpbench_core.model.planning.plan import Budget, Paths, Plan, PlanResult, PlanStatus, RobotPath, waits
from mrpbench_core.model.planning.problem import Feature, Problem, ends_of
from mrpbench_core.model.planning.type2_edges import moves_of
from mrpbench_core.model.planning.visits import left, visited_goals
from mrpbench_core.model.planning.window import until


@attrs.frozen(kw_only=True)
class RollingHorizon(Planner):
    """Plans with another planner from where robots come to rest if nothing more is released to them.

    So planners without commitments serve during execution, and the problem does not grow with what was driven. The new
    part of each path begins when all robots are at such vertices. Under a dispatcher that keeps the order of a plan
    (`adg`, `gses`) no robot waits for this; `timed` keeps the times, and there they do.

    With `replanning.window`, the planner plans until the end of the window, if it can. The plan of any other planner is
    cut there.
    """

    planner: Planner = option(help="the planner of each call")

    @property
    def supports(self) -> frozenset[Feature]:  # type: ignore[override]
        """What the planner supports, a horizon, and commitments, also such that begin later than others."""
        return self.planner.supports | {Feature.COMMITMENTS, Feature.SINCE, Feature.HORIZON}

    @property
    def promises(self) -> frozenset[Promise]:  # type: ignore[override]
        """What holds for the whole if it holds for the new part."""
        return self.planner.promises & {Promise.CONFLICT_FREE, Promise.DETERMINISTIC}

    @property
    def reads_remaining(self) -> bool:  # type: ignore[override]
        """What the planner reads."""
        return self.planner.reads_remaining

    @property
    def needs_homes(self) -> bool:  # type: ignore[override]
        """What the planner needs."""
        return self.planner.needs_homes

    def skip(self, problem: Problem) -> str | None:
        """Return why the planner cannot be given the new part, or None."""
        return self.planner.skip(self._with_horizon(problem))

    def skip_tasks(self, problem: Problem, places: Int | None) -> str | None:
        """Return why the planner cannot be used with tasks, or None."""
        return self.planner.skip_tasks(problem, places)

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Plan the new part."""
        return self.start().plan(problem, budget)

    def start(self) -> PlannerSession:
        """Begin a session of the planner."""
        return RollingHorizonSession(self.planner.start(), self._with_horizon)

    def _with_horizon(self, problem: Problem) -> Problem:
        """What the planner is given."""
        rest = from_rest(problem)
        if Feature.HORIZON in self.planner.supports:
            return rest
        return attrs.evolve(rest, horizon=None, features=rest.features - {Feature.HORIZON})


class RollingHorizonSession(PlannerSession):
    """Plans new parts with a session of another planner, which is `given` another problem."""

    def __init__(self, session: PlannerSession, with_horizon: Callable[[Problem], Problem]) -> None:
        self._session, self._with_horizon = session, with_horizon

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Plan from rest, after what is committed."""
        windowed = self._with_horizon(problem)
        result = self._session.plan(windowed, budget)
        plan = result.plan
        if plan is not None and problem.horizon is not None and windowed.horizon is None:
            plan = until(problem.horizon - _rest(problem), windowed, plan)
        if plan is not None:
            plan = after_commitments(problem, plan)
        status = PlanStatus.GAVE_UP if result.status == PlanStatus.UNSOLVABLE else result.status
        return attrs.evolve(result, status=status, plan=plan, lower_bound=float("nan"))


def from_rest(problem: Problem) -> Problem:
    """Return the problem of robots that start where their commitments end, all at the same time."""
    start: Int32 = problem.start.copy()
    goals = problem.goals
    if problem.commitments:
        moves = moves_of(problem, Plan(paths=problem.commitments))
        start[moves.robot] = moves.head  # of equal robots the last one counts
        if visited := visited_goals(problem, moves.robot, moves.head):
            goals = tuple(left(sequence, visited.get(robot, 0)) for robot, sequence in enumerate(goals))
    return attrs.evolve(
        problem,
        start=start,
        goals=goals,
        ready=np.zeros_like(problem.ready),
        since=np.zeros(0, np.int64),
        commitments=(),
        remaining=_from_rest(problem),
        horizon=None if problem.horizon is None else max(0, problem.horizon - _rest(problem)),
        features=problem.features - {Feature.COMMITMENTS, Feature.SINCE},
    )


def _from_rest(problem: Problem) -> Sequence[RobotPath]:
    """What remains of the current paths, all as much later as robots need to come to rest, counted from then on."""
    if not problem.remaining:
        return ()
    paths, begin = Paths.of(problem.remaining), _rest(problem)
    moves = paths.edge >= 0
    shift = max(0, begin - int(paths.enter[moves].min(initial=begin))) - begin
    enter, leave = np.maximum(paths.enter + shift, 0), np.maximum(paths.leave + shift, 0)
    first = np.append(enter, 0)[paths.first[:-1]] * (paths.size > 0)
    return waits(np.zeros_like(first), first).then(attrs.evolve(paths, enter=enter, leave=leave))


def _rest(problem: Problem) -> int:
    """The tick at which all robots have come to rest."""
    return max(ends_of(problem) + problem.ready.tolist(), default=0) if problem.commitments else 0


def after_commitments(problem: Problem, plan: Plan) -> Plan:
    """Return the commitments of a problem, a wait until the last of them ends, and then `plan`."""
    if not problem.commitments:
        return plan
    begin = _rest(problem)
    new = Paths.of(plan.paths).later(begin)
    return Plan(paths=Paths.of(problem.commitments).then(waits(np.array(ends_of(problem)), begin), new))
