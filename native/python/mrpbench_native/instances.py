"""The input of the solvers. Values that a caller omits have the simplest defaults."""

from collections.abc import Iterable, Sequence
from types import ModuleType
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

import mrpbench_native.mapf as mapf


class SolverRoadmap(NamedTuple):
    """A graph; `edges` and `duration` as in `mrpbench_core.model.planning.roadmap.Roadmap`."""

    position: NDArray[np.float64]
    """f8[V,2] metres."""
    edges: NDArray[np.int32]
    """i4[E,2]: from, to."""
    duration: NDArray[np.int32]
    """i4[profiles,E] ticks, -1 where robots of that profile cannot go."""


class Segments(NamedTuple):
    """The beginning of a path that is already fixed."""

    edge: NDArray[np.int32]
    """i4[k], -1 = wait."""
    enter: NDArray[np.int64]
    """i8[k] ticks."""
    leave: NDArray[np.int64]
    """i8[k] ticks."""


class Committed(NamedTuple):
    """The beginnings of all paths that are already fixed, robot after robot."""

    first: NDArray[np.int64]
    """i8[n+1]: those of robot i are the rows `first[i]:first[i + 1]`."""
    edge: NDArray[np.int32]
    """i4[k] as in `Segments`, like the other columns."""
    enter: NDArray[np.int64]
    leave: NDArray[np.int64]

    @classmethod
    def of(cls, segments: Sequence[Segments], robots: int) -> Self:
        """Join the segments of each of so many robots; () = nothing is fixed."""
        return cls(
            _first(len(path.edge) for path in segments) if segments else np.zeros(robots + 1, "i8"),
            _joined([path.edge for path in segments], "i4"),
            _joined([path.enter for path in segments], "i8"),
            _joined([path.leave for path in segments], "i8"),
        )


class Robots(NamedTuple):
    """The robots, one row each."""

    start: NDArray[np.int32]
    """i4[n]: vertices."""
    goals: Sequence[NDArray[np.int32]]
    """For each robot the vertices at which it may end, i4[g]."""
    via: Sequence[Sequence[NDArray[np.int32]]] = ()
    """For each robot the sets of vertices to visit before, in order, each i4[g]; () = none. Not all solvers do."""
    ready: NDArray[np.int64] | None = None
    """i8[n]: ticks before which robots do not leave; None = 0."""
    profile: NDArray[np.int32] | None = None
    """i4[n]: rows of `SolverRoadmap.duration`; None = 0."""
    radius: NDArray[np.float64] | None = None
    """f8[n] metres; None = 0."""
    committed: Sequence[Segments] | Committed = ()
    """For each robot what is fixed of its path; () = nothing."""
    rank: NDArray[np.int32] | None = None
    """i4[n]: those with lower ranks go first, where a planner has an order; None = 0."""


class SolverExclusions(NamedTuple):
    """Elements (vertices, then edges) closer than the robots' radii allow, as sparse rows."""

    first: NDArray[np.int64]
    element: NDArray[np.int32]
    distance: NDArray[np.float64]
    """f8 metres."""


class SolverResource(NamedTuple):
    """Elements that at most `capacity` robots use at a time, each for `setup` ticks longer than it is on them."""

    element: NDArray[np.int32]
    capacity: int = 1
    setup: int = 0


NO_EXCLUSIONS = SolverExclusions(np.empty(0, "i8"), np.empty(0, "i4"), np.empty(0))


def build_instance(
    roadmap: SolverRoadmap | mapf.Roadmap,
    robots: Robots,
    *,
    exclusions: SolverExclusions = NO_EXCLUSIONS,
    resources: Sequence[SolverResource] = (),
    following_forbidden: bool = False,
    disappear_at_goal: bool = False,
    k: int = 0,
    horizon: int | None = None,
    module: ModuleType = mapf,
) -> mapf.Instance:
    """Join the lists of all robots and resources into the arrays that C++ takes.

    With a `Roadmap` of the module, solvers go on with the distances that they found for other instances on it.
    The instance is one of `module`: `mrpbench_native.mapf`, or a module of solvers that is built against its headers.
    With `k` the paths are free of conflicts although each robot is up to `k` ticks late (k-robust plans). With a
    `horizon`, a tick, conflicts that begin later may stay, and paths may end there.

    Raises:
        ValueError: the data make no sense; the message names the robot or the array.
        TypeError: an array has the wrong type or shape.
    """
    count = len(robots.start)
    committed = robots.committed
    if not isinstance(committed, Committed):
        committed = Committed.of(committed, count)
    via = robots.via or [()] * count
    visits = [goals for sets in via for goals in sets]
    instance: mapf.Instance = module.Instance(
        roadmap=roadmap._asdict() if isinstance(roadmap, SolverRoadmap) else roadmap,
        robots={
            "start": robots.start,
            "ready": np.zeros(count, "i8") if robots.ready is None else robots.ready,
            "profile": np.zeros(count, "i4") if robots.profile is None else robots.profile,
            "radius": np.zeros(count) if robots.radius is None else robots.radius,
            "rank": np.zeros(count, "i4") if robots.rank is None else robots.rank,
            "goal_first": _first(map(len, robots.goals)),
            "goal": _joined(robots.goals, "i4"),
            "via_first": _first(map(len, via)),
            "via_goal_first": _first(map(len, visits)),
            "via_goal": _joined(visits, "i4"),
            **{f"committed_{name}": column for name, column in committed._asdict().items()},
        },
        exclusions=exclusions._asdict(),
        resources={
            "first": _first(len(resource.element) for resource in resources),
            "element": _joined([resource.element for resource in resources], "i4"),
            "capacity": np.array([resource.capacity for resource in resources], "i4"),
            "setup": np.array([resource.setup for resource in resources], "i8"),
        },
        following_forbidden=following_forbidden,
        disappear_at_goal=disappear_at_goal,
        **({"k": k} if k else {}),  # modules built against the headers of earlier versions do not know these
        **({} if horizon is None else {"horizon": horizon}),
    )
    return instance


def _first(lengths: Iterable[int]) -> NDArray[np.int64]:
    return np.cumsum([0, *lengths], dtype="i8")


def _joined(parts: Sequence[NDArray[Any]], dtype: str) -> NDArray[Any]:
    return np.concatenate([np.empty(0, dtype), *parts]).astype(dtype)
