"""LaCAM*: a plan within milliseconds, improved until the budget is spent."""

from typing import ClassVar

import numpy as np

from mrpbench_core.api.planner import Promise
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_planners_mapf.configurations import ConfigurationPlanner
from mrpbench_planners_mapf.recipe import native_planner


@native_planner("lacam")
class Lacam(ConfigurationPlanner):
    """Searches depth first over configurations of all robots (Okumura, AAAI 2023, IJCAI 2023), then improves the plan.

    Complete: `unsolvable` means that every configuration was seen. The first plan is improved in turn by a second plan
    that takes robots nearest first (`prioritized`); where there is no room for that, by a plan along guide paths
    (`guides`; Okumura, AAMAS 2024) or, in a crowd, by further first plans drawn at random; by continuing the search
    (`star`); and by replanning groups of robots (`neighbourhoods`). Improvement ends when the plan cannot become
    better, after `limits.iterations` steps, or when the time is over. The result is optimal, and `lower_bound` equals
    its cost, once all better configurations are ruled out; this happens with few robots only.

    Where moves take several ticks, or robots have footprints or use resources, a configuration says where robots stand
    between their moves, and each move starts as soon as those before it allow. Guide paths and `star` do not apply
    there; when neighbourhoods bring nothing any more, they are planned from another first plan. The result is not
    proved to be optimal. The search stays complete, because a robot on an edge excludes
    all that it will exclude at its end. Problems in which this does not hold are skipped.
    """

    supports: ClassVar[frozenset[Feature]] = ConfigurationPlanner.supports - {Feature.COMMITMENTS}
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.COMPLETE, Promise.DETERMINISTIC})

    def skip(self, problem: Problem) -> str | None:
        """See `Planner.skip`; also problems in which an edge excludes less than the vertex at its end."""
        return super().skip(problem) or _missed_plans(problem)


def _missed_plans(problem: Problem) -> str | None:
    """Return why a plan may need a robot to set out to a vertex that it may not yet enter, or None."""
    edges = problem.roadmap.edges
    slow = (problem.roadmap.duration[problem.profile] > 1).any()
    if slow and not (Feature.FOOTPRINTS in problem.features and (problem.radius > 0).all()):
        return "supports edges of several ticks only for robots with footprints"
    if (slow or problem.roadmap.resources) and len(np.unique(edges, axis=0)) < len(edges):
        return "does not support several edges from one vertex to another"
    for resource in problem.roadmap.resources:
        if not np.isin(np.flatnonzero(np.isin(edges[:, 1], resource.vertices)), resource.edges).all():
            return f"supports no resource with a vertex but without an edge to it, as {resource.name!r}"
    return None
