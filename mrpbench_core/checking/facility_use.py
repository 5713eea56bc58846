"""Refuses plans that use doors or lifts, for dispatchers that do not request them."""

from mrpbench_core.api.dispatcher import DispatchError
from mrpbench_core.model.planning.occupations import occupations_of
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.type2_edges import moves_of


def refuse_facilities(problem: Problem, plan: Plan, dispatcher: str) -> None:
    """Raise DispatchError if a plan uses a door or a lift, for dispatchers that do not request them."""
    kinds = {resource.name: resource.kind for resource in problem.roadmap.resources}
    for occupation in occupations_of(problem, moves_of(problem, plan)):
        if kinds[occupation.resource] != "mutex":
            raise DispatchError(
                f"robot {occupation.robot} needs the {kinds[occupation.resource]} {occupation.resource}, "
                f"and the dispatcher {dispatcher} does not request doors or lifts: use adg"
            )
