"""The least cost by brute force: A* over the joint states of all robots, one tick at a time.

Slow and plain on purpose, for a handful of robots on a dozen vertices: it shares no code with planners or validators,
only the rules of `model.planning.conflicts`. Two robots are checked at each tick and between each two.
From some tick on, what can follow depends on the joint state alone, so that the search can see all states and a problem
without a plan is known to have none. The state includes how long each robot still uses each resource.

Plans cross each edge in exactly its duration.
"""

import heapq
import itertools
import math
from collections.abc import Callable, Iterable, Iterator

from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_tests.oracles.conflict_rules import ConflictRules, Uses
from mrpbench_tests.oracles.robot_steps import DONE, RobotState, RobotStep, RobotSteps

UNSUPPORTED = frozenset({Feature.HORIZON, Feature.SINCE})
"""The feature that this search does not support."""
MOST_STATES = 6_000
"""States after which a search ends without an answer, by default."""


def least_sum_of_costs(problem: Problem, most_states: int = MOST_STATES, assign: bool = False) -> float | None:
    """The least sum of costs in ticks; inf if there is no plan, None if it is not known after `most_states` states.

    Args:
        problem: what to plan.
        most_states: the number of joint states after which the search gives up.
        assign: require that robots end at different goals, even where they disappear there: the optimum over all
            assignments of robots to goals.

    Raises:
        ValueError: the problem has a feature that this search does not support.
    """
    return _Search(problem, sum, assign).run(most_states)


def least_makespan(problem: Problem, most_states: int = MOST_STATES) -> float | None:
    """The least tick at which the last robot arrives; see `least_sum_of_costs`."""
    return _Search(problem, max, assign=False).run(most_states)


def earliest_arrival(problem: Problem, robot: int) -> float:
    """The tick at which a robot with one goal set arrives if it is alone; inf if it cannot."""
    steps = RobotSteps(problem)
    return steps.earliest_arrival(robot, 0, steps.first[robot])


class _Search:
    def __init__(self, problem: Problem, total: Callable[[Iterable[float]], float], assign: bool) -> None:
        if unsupported := problem.features & UNSUPPORTED:
            raise ValueError(f"cannot search problems with {', '.join(sorted(unsupported))}")
        self.total = total
        self.assign = assign
        self.robots = RobotSteps(problem)
        self.rules = ConflictRules(problem, self.robots.edges)

    def run(self, most_states: int) -> float | None:
        first = self.robots.first
        places = [state.place for state in first]
        uses = self.rules.uses(self.rules.no_uses(), places)
        if self.rules.any_conflict(places) or self.rules.over_capacity(uses):
            return math.inf
        order = itertools.count()
        queue = [(self._bound(0, 0, first), next(order), 0, 0.0, first, uses)]
        closed = set()
        while queue:
            _, _, tick, cost, states, uses = heapq.heappop(queue)
            if all(state.phase == DONE for state in states):
                return cost
            key = min(tick, self.robots.settled), states, uses
            if key in closed:
                continue
            closed.add(key)
            if len(closed) > most_states:
                return None
            for steps, later in self._successors(tick, states, uses):
                after = tuple(step.then for step in steps)
                paid = [self.robots.arrival(robot, tick) for robot, step in enumerate(steps) if step.ends]
                spent = self.total([cost, *paid])
                bound = self._bound(tick + 1, spent, after)
                if bound < math.inf:
                    heapq.heappush(queue, (bound, next(order), tick + 1, spent, after, later))
        return math.inf

    def _bound(self, tick: int, cost: float, states: tuple[RobotState, ...]) -> float:
        """A lower bound on the cost of all plans that pass through a joint state."""
        to_come = [
            self.robots.earliest_arrival(robot, tick, state)
            for robot, state in enumerate(states)
            if state.phase != DONE
        ]
        return self.total([cost, *to_come])

    def _successors(
        self, tick: int, states: tuple[RobotState, ...], uses: Uses
    ) -> Iterator[tuple[tuple[RobotStep, ...], Uses]]:
        """Joint steps without conflict, and the uses of resources after each."""
        choices = [self.robots.steps(robot, tick, state) for robot, state in enumerate(states)]
        for steps in self._joint((), choices):
            if self.assign and self._share_a_goal(steps):
                continue
            if self.rules.overtaking(states, steps):
                continue
            between = self.rules.uses(uses, [step.during for step in steps])
            later = self.rules.uses(between, [step.place for step in steps])
            if not self.rules.over_capacity(between) and not self.rules.over_capacity(later):
                yield steps, later

    def _joint(self, chosen: tuple[RobotStep, ...], choices: list[list[RobotStep]]) -> Iterator[tuple[RobotStep, ...]]:
        """All ways to add a step of each other robot to the steps of the first ones, without conflict."""
        robot = len(chosen)
        if robot == len(choices):
            yield chosen
            return
        for step in choices[robot]:
            if not any(self.rules.conflict(other, robot, before, step) for other, before in enumerate(chosen)):
                yield from self._joint((*chosen, step), choices)

    def _share_a_goal(self, steps: tuple[RobotStep, ...]) -> bool:
        goals = [step.then.place for step in steps if step.then.phase == DONE]
        return len(set(goals)) < len(goals)
