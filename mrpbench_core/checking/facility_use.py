"""Finds the doors and lifts that a plan uses, for dispatchers that do not request them."""

from mrpbench_core.model.planning.occupations import occupations_of
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.type2_edges import moves_of


def check_facility_use(problem: Problem, plan: Plan) -> list[str]:
    """Return a sentence for each door or lift that a robot uses in a plan without faults; mutexes do not count.

    A dispatcher that does not request doors and lifts (`Orders.requests`) refuses plans with such sentences, in `start`
    as well as in `adopt`: the robots would wait forever before closed doors.
    """
    kinds = {resource.name: resource.kind for resource in problem.roadmap.resources}
    used = {
        (occupation.robot, kinds[occupation.resource], occupation.resource): None
        for occupation in occupations_of(problem, moves_of(problem, plan))
        if kinds[occupation.resource] != "mutex"
    }
    return [f"robot {robot} uses the {kind} {name}" for robot, kind, name in used]
