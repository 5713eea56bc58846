"""Between the model and the solvers in C++: a problem becomes plain arrays, an answer becomes a plan."""

import time
from collections.abc import Callable, Iterable
from itertools import pairwise

import numpy as np
from mrpbench_native import mapf

from mrpbench_core.model.conflicts import exclusions
from mrpbench_core.model.plan import AnytimePoint, Budget, Path, Plan, PlanResult, PlanStatus
from mrpbench_core.model.problem import Feature, Problem
from mrpbench_core.model.roadmap import Resource, Roadmap

SUPPORTED = frozenset(
    {
        Feature.EDGE_DURATIONS,
        Feature.FOOTPRINTS,
        Feature.PROFILES,
        Feature.GOAL_SETS,
        Feature.COMMITMENTS,
        Feature.FOLLOWING_FORBIDDEN,
    }
)
NOTHING = Path(edge=np.empty(0, np.int32), enter=np.empty(0, np.int64), leave=np.empty(0, np.int64))


def solve(problem: Problem, budget: Budget, solver: Callable[..., mapf.Answer], **options: object) -> PlanResult:
    """Ask a solver, with its options and what is left of `budget` after the conversion."""
    start = time.monotonic()
    if "seed" in options and options["seed"] is None:
        options["seed"] = budget.seed
    instance = _instance(problem)
    converted = time.monotonic() - start
    answer = solver(instance, **options, wall_s=budget.wall_s - converted, memory_bytes=budget.memory_bytes)
    status = PlanStatus(answer.status)
    return PlanResult(
        status=status,
        plan=_plan(answer) if status is PlanStatus.SOLVED else None,
        lower_bound=answer.lower_bound,
        clock_bound=answer.clock_bound,
        statistics={name: value for name, value in answer.statistics.items() if name != "failed_robot" or value >= 0},
        history=tuple(
            AnytimePoint(seconds=converted + seconds, cost=cost, lower_bound=bound)
            for seconds, cost, bound in answer.history.tolist()
        ),
    )


def _instance(problem: Problem) -> mapf.Instance:
    roadmap = problem.roadmap
    goals = [np.unique(sequence[-1]) for sequence in problem.goals]
    committed = problem.commitments or (NOTHING,) * len(problem)
    near = _exclusions(problem)
    return mapf.Instance(
        position=roadmap.position,
        edges=roadmap.edges,
        duration=roadmap.duration,
        profile=problem.profile,
        radius=problem.radius,
        start=problem.start,
        ready=problem.ready,
        goal_first=_first(len(goal) for goal in goals),
        goal=_joined(goals, "i4"),
        committed_first=_first(len(path) for path in committed),
        committed_edge=_joined([path.edge for path in committed], "i4"),
        committed_enter=_joined([path.enter for path in committed], "i8"),
        committed_leave=_joined([path.leave for path in committed], "i8"),
        exclusion_first=near[0],
        exclusion_element=near[1],
        exclusion_distance=near[2],
        resource_first=_first(len(resource.vertices) + len(resource.edges) for resource in roadmap.resources),
        resource_element=_joined([_elements(roadmap, resource) for resource in roadmap.resources], "i4"),
        resource_capacity=np.array([resource.capacity for resource in roadmap.resources], "i4"),
        resource_setup=np.array([resource.setup_ticks for resource in roadmap.resources], "i8"),
        following_forbidden=problem.rules.following == "forbidden",
        disappear_at_goal=problem.rules.at_goal == "disappear",
    )


def _elements(roadmap: Roadmap, resource: Resource) -> np.ndarray:
    """Vertices as they are, edges after them."""
    return np.array([*resource.vertices, *(len(roadmap.position) + edge for edge in resource.edges)])


def _exclusions(problem: Problem) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Elements nearer than the two largest radii together; empty without footprints."""
    if Feature.FOOTPRINTS not in problem.features:
        return np.empty(0, "i8"), np.empty(0, "i4"), np.empty(0, "f8")
    near = exclusions(problem.roadmap, float(np.sort(problem.radius)[-2:].sum()))
    return near.first.astype("i8"), near.element.astype("i4"), near.distance.astype("f8")


def _first(lengths: Iterable[int]) -> np.ndarray:
    return np.cumsum([0, *lengths], dtype="i8")


def _joined(parts: list[np.ndarray], dtype: str) -> np.ndarray:
    return np.concatenate([np.empty(0, dtype), *parts]).astype(dtype)


def _plan(answer: mapf.Answer) -> Plan:
    edge, enter, leave = answer.edge, answer.enter, answer.leave
    rows = [slice(first, end) for first, end in pairwise(answer.first.tolist())]
    return Plan(paths=tuple(Path(edge=edge[row], enter=enter[row], leave=leave[row]) for row in rows))
