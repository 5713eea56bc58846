"""The rules of `mrpbench_core.model.planning.conflicts`, for robots at one tick or between two; part of `optimum`."""

import itertools
from collections.abc import Sequence

from mrpbench_core.model.common.geometry import segment_distance
from mrpbench_core.model.planning.conflicts import TOLERANCE
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_tests.oracles.robot_steps import ON, RobotState, RobotStep

Uses = tuple[tuple[int, ...], ...]
"""uses[robot][resource] = the number of moments, this one included, for which the robot still uses the resource."""


class ConflictRules:
    """The elements that robots must not occupy at one moment; a moment is a tick or the time between two ticks."""

    def __init__(self, problem: Problem, edges: Sequence[tuple[int, int]]) -> None:
        self.problem, self.edges = problem, edges
        self.vertices = len(problem.roadmap.position)
        self._footprints = Feature.FOOTPRINTS in problem.features
        self._may_overtake = bool((problem.roadmap.duration > 1).any()) or bool(problem.commitments)
        self._known: dict[tuple[int, int, int | None, int | None, int | None, int | None], bool] = {}
        self._resources = [
            (
                {*resource.vertices, *(self.vertices + edge for edge in resource.edges)},
                resource.capacity,
                2 * resource.setup_ticks + 1,
            )
            for resource in problem.roadmap.resources
        ]

    def conflict(self, one: int, other: int, first: RobotStep, second: RobotStep) -> bool:
        """Tell whether steps of two robots conflict, overtaking and resources apart."""
        key = (one, other, first.during, first.place, second.during, second.place)
        if key not in self._known:
            during = self._exclude(first.during, second.during, one, other)
            self._known[key] = during or self._exclude(first.place, second.place, one, other)
        return self._known[key]

    def any_conflict(self, elements: Sequence[int]) -> bool:
        """Tell whether robots that stand at `elements` conflict."""
        pairs = itertools.combinations(enumerate(elements), 2)
        return any(self._exclude(x, y, one, other) for (one, x), (other, y) in pairs)

    def overtaking(self, states: Sequence[RobotState], steps: Sequence[RobotStep]) -> bool:
        """Tell whether a robot leaves an edge before one that entered the edge earlier (rule 3)."""
        if not self._may_overtake:
            return False
        moving = [
            (self.edges[step.during - self.vertices], state.elapsed if state.phase == ON else 0, step.then.phase != ON)
            for state, step in zip(states, steps, strict=True)
            if step.during is not None and step.during >= self.vertices
        ]
        return any(
            edge == other and elapsed < longer and leaves and not leaves_too
            for (edge, elapsed, leaves), (other, longer, leaves_too) in itertools.permutations(moving, 2)
        )

    def no_uses(self) -> Uses:
        """The uses of resources before the first moment."""
        return ((0,) * len(self._resources),) * len(self.problem)

    def uses(self, before: Uses, elements: Sequence[int | None]) -> Uses:
        """The uses of resources at the moment after `before`, in which robots occupy `elements`."""
        return tuple(
            tuple(
                lasting if element in places else max(0, left - 1)
                for (places, _, lasting), left in zip(self._resources, row, strict=True)
            )
            for row, element in zip(before, elements, strict=True)
        )

    def over_capacity(self, uses: Uses) -> bool:
        """Tell whether more robots use a resource than its capacity (rule 6)."""
        return any(
            sum(row[number] > 0 for row in uses) > capacity for number, (_, capacity, _) in enumerate(self._resources)
        )

    def _exclude(self, x: int | None, y: int | None, one: int, other: int) -> bool:
        """Tell whether two robots must not be on two elements at one moment."""
        if x is None or y is None:
            return False
        return self._same_place(x, y) or self._too_close(x, y, one, other)

    def _same_place(self, x: int, y: int) -> bool:
        """Rules 1, 2 and 4."""
        if x < self.vertices or y < self.vertices:
            return x == y
        (a, b), (c, d) = self.edges[x - self.vertices], self.edges[y - self.vertices]
        if (a, b) == (d, c):
            return True
        return self.problem.rules.following == "forbidden" and (b == c or a == d or (a, b) == (c, d))

    def _too_close(self, x: int, y: int, one: int, other: int) -> bool:
        """Rule 5."""
        if not self._footprints:
            return False
        ends = [(z, z) if z < self.vertices else self.edges[z - self.vertices] for z in (x, y)]
        level = self.problem.roadmap.level
        if not {int(level[end]) for end in ends[0]} & {int(level[end]) for end in ends[1]}:
            return False
        (a, b), (c, d) = (self.problem.roadmap.position[list(pair)] for pair in ends)
        reach = float(self.problem.radius[one] + self.problem.radius[other])
        return float(segment_distance(a, b, c, d)) < reach - TOLERANCE
