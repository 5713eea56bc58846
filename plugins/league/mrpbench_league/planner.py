"""Plans steps by the rules of the League of Robot Runners."""

from typing import ClassVar, Literal

import attrs

from mrpbench_core.api import Planner, Promise, between, option
from mrpbench_core.model.planning.plan import Budget, PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem


@attrs.frozen(kw_only=True)
class StepPlanner(Planner):
    """Plans the next steps of robots with headings in a discrete execution. It gives no plan of a whole run, and serves
    `simulator: league` alone.
    """

    promises: ClassVar[frozenset[Promise]] = frozenset()

    method: Literal["epibt", "pibt"] = option(
        "epibt", help="pibt: PIBT with turns; epibt: PIBT over operations of several actions"
    )
    depth: int | None = option(
        None,
        help="actions of an operation of epibt; none: 5 up to 3,000 robots, else 4",
        validator=attrs.validators.in_((None, 3, 4, 5)),
    )
    improve: bool = option(True, help="improve the operations of epibt by large neighbourhood search")

    threads: int = option(
        1,
        help="threads of this improvement; results do not depend on their number if `limits.iterations` is given",
        validator=between(1, 1024),
    )
    guidance: bool = option(True, help="let moves cost more where robots come the other way or stay")
    active: int | None = option(
        None,
        help="robots that have a goal at the same time, at most; none: half as many as there are free cells",
        validator=attrs.validators.optional(attrs.validators.ge(1)),
    )

    def idle_options(self) -> dict[str, str]:
        """Return options that others make idle."""
        if self.method != "epibt":
            return dict.fromkeys(("depth", "improve", "threads"), "`method` is not epibt")
        return {} if self.improve else {"threads": "`improve` is off"}

    def skip(self, problem: Problem) -> str | None:  # noqa: ARG002
        """Return that a plan of the whole run is not asked of it."""
        return "plans steps of `simulator: league` alone"

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:  # noqa: ARG002
        """Give up, see `skip`."""
        return PlanResult(status=PlanStatus.GAVE_UP)
