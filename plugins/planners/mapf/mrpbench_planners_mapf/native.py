"""Between the model and the solvers in C++: a problem becomes an instance, an answer becomes a plan."""

import time
from collections.abc import Mapping, Sequence
from itertools import chain
from types import ModuleType

import numpy as np
from mrpbench_native import mapf
from mrpbench_native.instances import (
    NO_EXCLUSIONS,
    Committed,
    Robots,
    SolverExclusions,
    SolverResource,
    SolverRoadmap,
    build_instance,
)

from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.planning.conflicts import exclusions
from mrpbench_core.model.planning.plan import AnytimePoint, Budget, Paths, Plan, PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_core.model.planning.window import until


class KnownRoadmap:
    """The roadmap of the last call, with the distances on it that a solver of a module found then."""

    def __init__(self, module: ModuleType) -> None:
        self._module = module
        self._arrays: SolverRoadmap | None = None
        self._known: mapf.Roadmap | None = None

    def of(self, arrays: SolverRoadmap) -> SolverRoadmap | mapf.Roadmap:
        """Return the same roadmap as before if it has not changed."""
        if not hasattr(self._module, "Roadmap"):  # built against the headers of an earlier version
            return arrays
        names = SolverRoadmap._fields
        same = (np.array_equal(getattr(self._arrays, name), getattr(arrays, name)) for name in names)
        if self._known is None or not all(same):
            self._arrays, self._known = arrays, self._module.Roadmap(arrays._asdict())
        return self._known


def solve(
    problem: Problem,
    budget: Budget,
    algorithm: str,
    options: Mapping[str, object],
    module: ModuleType = mapf,
    rank: Int32 | None = None,
    known: KnownRoadmap | None = None,
) -> PlanResult:
    """Run an algorithm of `module` with its options, within what is left of `budget` after the conversion.

    Robots with lower `rank` i4[n] go first where the algorithm has an order; None = it chooses. What is `known` of the
    roadmap saves time.
    """
    start = time.monotonic()
    instance = _instance(problem, module, rank, known)
    converted = time.monotonic() - start
    answer: mapf.Answer = module.solve(
        instance,
        algorithm,
        dict(options),
        wall_s=budget.wall_s - converted,
        memory_bytes=budget.memory_bytes,
    )
    status = PlanStatus(answer.status)
    plan = _plan(answer) if status is PlanStatus.SOLVED else None
    if plan is not None and problem.horizon is not None:
        plan = until(problem.horizon, problem, plan)
    return PlanResult(
        status=status,
        plan=plan,
        lower_bound=answer.lower_bound if problem.horizon is None else float("nan"),  # on the costs of whole paths
        clock_bound=answer.clock_bound,
        statistics={name: value for name, value in answer.statistics.items() if name != "failed_robot" or value >= 0},
        history=tuple(
            AnytimePoint(seconds=converted + seconds, cost=cost, lower_bound=bound)
            for seconds, cost, bound in answer.history.tolist()
        ),
    )


def _instance(problem: Problem, module: ModuleType, rank: Int32 | None, known: KnownRoadmap | None) -> mapf.Instance:
    roadmap, prefix = problem.roadmap, Paths.of(problem.commitments)
    visits = max(map(len, problem.goals), default=0) > 1
    arrays = SolverRoadmap(roadmap.position, roadmap.edges, roadmap.duration)
    robots = Robots(
        start=problem.start,
        goals=_goals([sequence[-1] if sequence else range(len(roadmap.position)) for sequence in problem.goals]),
        via=[_goals(sequence[:-1]) for sequence in problem.goals] if visits else (),
        ready=problem.ready,
        profile=problem.profile,
        radius=problem.radius,
        committed=Committed(prefix.first, prefix.edge, prefix.enter, prefix.leave) if problem.commitments else (),
        rank=rank,
    )
    edges_after = len(roadmap.position)  # elements are vertices, then edges
    resources = [
        SolverResource(
            np.array([*resource.vertices, *(edges_after + edge for edge in resource.edges)]),
            resource.capacity,
            resource.setup_ticks,
        )
        for resource in roadmap.resources
    ]
    return build_instance(
        arrays if known is None else known.of(arrays),
        robots,
        exclusions=_exclusions(problem),
        resources=resources,
        following_forbidden=problem.rules.following == "forbidden",
        disappear_at_goal=problem.rules.at_goal == "disappear",
        k=problem.rules.k,
        horizon=problem.horizon,
        module=module,
    )


def _goals(sets: Sequence[Sequence[int]]) -> list[Int32]:
    """The vertices i4[g] of each set of goals, sorted."""
    if set(map(len, sets)) == {1}:  # the usual case
        return [*np.fromiter(chain.from_iterable(sets), np.int32, len(sets)).reshape(-1, 1)]
    return [np.array(sorted(set(goal)), np.int32) for goal in sets]


def _exclusions(problem: Problem) -> SolverExclusions:
    """Elements closer than the sum of the two largest radii; none without footprints."""
    if Feature.FOOTPRINTS not in problem.features:
        return NO_EXCLUSIONS
    near = exclusions(problem.roadmap, float(np.sort(problem.radius)[-2:].sum()))
    return SolverExclusions(near.first.astype("i8"), near.element.astype("i4"), near.distance.astype("f8"))


def _plan(answer: mapf.Answer) -> Plan:
    return Plan(paths=Paths(first=answer.first, edge=answer.edge, enter=answer.enter, leave=answer.leave))
