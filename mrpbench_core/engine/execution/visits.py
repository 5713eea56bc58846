"""Which goals robots have visited on their way to the last one: what is reported counts only at their true places."""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int16, Int32
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Goals, GoalSet, Problem
from mrpbench_core.model.planning.visits import advance, left

NEVER = np.iinfo(np.int32).max


class Visits:
    """Counts the goals that robots have visited, in the order of their sequences.

    A robot has visited a goal when the segment that leads there is reported as reached and it is truly near, at any
    speed.

    Args:
        problem: gives the goals; those before the last one count.
        plan: the current one.
        tolerance: metres from a goal within which a robot visits it.
    """

    def __init__(self, problem: Problem, plan: Plan, tolerance: float) -> None:
        self._tolerance = tolerance
        self.lead_to(problem.goals, np.zeros(len(problem), np.int64))
        self.follow(problem, plan)

    def lead_to(self, goals: Goals, visited: Int) -> None:
        """Go on with other goals, of which robots have `visited` i8[n] already."""
        self._goals = goals
        self.count: Int = visited.copy()
        """i8[n]: the number of goals that each robot has visited."""

    def follow(self, problem: Problem, plan: Plan) -> None:
        """Go on with a plan to goals of `problem`; it leads to what is left of a robot's goals, or elsewhere."""
        self._roadmap = problem.roadmap
        self._due = {robot: self._segments(problem, plan, robot) for robot in self._unfinished()}
        """For robots with goals to visit, the number of segments to reach for each goal of the sequence."""

    def update(self, place: Float, level: Int16, reached: Int32) -> None:
        """Count goals.

        Args:
            place: f8[n,2+] metres, where robots truly are.
            level: i2[n].
            reached: i4[n] segments of their paths that are reported as reached.
        """
        for robot, due in self._due.items():
            while self.count[robot] < len(due) and due[self.count[robot]] <= reached[robot]:
                if not self._is_at(self._goals[robot][self.count[robot]], place[robot, :2], level[robot]):
                    break
                self.count[robot] += 1

    @property
    def complete(self) -> Bool:
        """bool[n]: only the last goal is left."""
        complete = np.ones(len(self._goals), bool)
        complete[self._unfinished()] = False
        return complete

    @property
    def remaining(self) -> Goals:
        """What is left of the sequences of goals."""
        return tuple(left(sequence, int(self.count[robot])) for robot, sequence in enumerate(self._goals))

    def contradiction(self) -> str | None:
        """Say which goal a robot has not visited, or None."""
        robot = next(iter(self._unfinished()), None)
        if robot is None:
            return None
        return f"robot {robot} did not come within {self._tolerance:g} m of goal {self.count[robot]} of its sequence"

    def _unfinished(self) -> list[int]:
        if max(map(len, self._goals), default=0) < 2:
            return []
        ahead = zip(self._goals, self.count.tolist(), strict=True)
        return [robot for robot, (goals, visited) in enumerate(ahead) if visited < len(goals) - 1]

    def _segments(self, problem: Problem, plan: Plan, robot: int) -> list[int]:
        """How many segments lead to each goal of a robot but the last one."""
        goals, ahead = self._goals[robot], problem.goals[robot]
        due = [NEVER] * (len(goals) - 1)
        behind = len(goals) - len(ahead)
        if behind < 0 or goals[behind:] != ahead:
            return due
        visited = 0
        for reached, vertex in enumerate(plan.paths[robot].vertices(self._roadmap, int(problem.start[robot])).tolist()):
            before, visited = visited, advance(ahead[:-1], visited, vertex)
            due[behind + before : behind + visited] = [reached] * (visited - before)
        return due

    def _is_at(self, goal: GoalSet, place: Float, level: int) -> bool:
        vertices = list(goal)
        near = np.hypot(*(self._roadmap.position[vertices] - place).T) <= self._tolerance
        return bool((near & (self._roadmap.level[vertices] == level)).any())
