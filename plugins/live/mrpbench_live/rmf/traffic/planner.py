"""The planner `rmf`: plans to the destinations that are posted for outside robots."""

from typing import ClassVar

import attrs

from mrpbench_core.api import (
    Budget,
    Feature,
    Planner,
    PlannerSession,
    PlanResult,
    PlanStatus,
    Problem,
    Promise,
    option,
)
from mrpbench_core.model.planning.problem import features_of
from mrpbench_live.rmf.traffic.shared import traffic_of


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
        traffic = traffic_of("planner")
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
    changed = attrs.evolve(problem, goals=goals)
    features = problem.features & {Feature.FOOTPRINTS, Feature.COMMITMENTS}
    return attrs.evolve(changed, features=features_of(changed) | features)
