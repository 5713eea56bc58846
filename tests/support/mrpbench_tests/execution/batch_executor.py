"""Robots that drive the released parts of a plan in many executions at once, with the delays that runs have.

Time passes in steps of one control period. A robot begins and ends moves at steps only, so all times are whole numbers.
Every array has the executions first, then the robots.
"""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.engine.execution.delays import DrawnDelays
from mrpbench_core.engine.execution.worst_case import Adversary
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.execution.orders import FleetView
from mrpbench_core.model.planning.plan import Paths, Plan
from mrpbench_core.model.planning.problem import Problem

NOT_YET = 1 << 60
"""The step of what has not happened; no execution has so many."""


class BatchExecutor:
    """Moves the robots of d executions.

    Args:
        problem: of the plan.
        plan: released to the robots.
        period: seconds of one step.
        random: draws how late robots report that they have cleared a vertex.
    """

    def __init__(self, problem: Problem, plan: Plan, period: float, random: np.random.Generator) -> None:
        robots = len(problem)
        self.period, self.now = period, 0
        self.reached: Int = np.zeros((1, robots), np.int64)
        self.cleared: Int = np.zeros((1, robots), np.int64)
        self._done: Float = np.zeros((1, robots))  # planned seconds of the present move
        self.begun: Int = np.full((1, robots, 0), NOT_YET)
        """Step i8[d,n,s] at which each segment is begun."""
        self.ended: Int = np.full((1, robots, 0), NOT_YET)
        self._late = random.choice([0.0, 0.3, 1.0], robots)
        self._robot: Int = np.arange(robots)
        self.adopt(problem, plan)

    def adopt(self, problem: Problem, plan: Plan) -> None:
        """Continue with a plan that begins with what was released of the old one."""
        self.problem, self.plan = problem, plan
        paths, robots, roadmap = Paths.of(plan.paths), len(problem), problem.roadmap
        self.length: Int = paths.size.astype(np.int64)
        shape = robots, int(self.length.max(initial=0)) + 1
        self.edge: Int = np.full(shape, -1)
        """Edge i8[n,s] of each segment, -1 for waits and after the end."""
        self.edge[paths.robot, paths.segment] = paths.edge
        move = self.edge >= 0
        row = np.nonzero(move)[0]
        edge = self.edge[move]
        self._duration: Float = np.zeros(shape)
        self._duration[move] = roadmap.duration[problem.profile[row], edge] * roadmap.tick
        tail, head = (roadmap.position[ends] for ends in roadmap.edges[edge].reshape(-1, 2).T)
        metres = np.hypot(*(head - tail).T)
        self._pace: Float = np.full(shape, np.inf)
        self._pace[move] = np.where(metres > 0, self._duration[move] / np.maximum(metres, 1e-9), np.inf)
        reach = (problem.radius + problem.radius.max(initial=0.0))[row]
        share = np.minimum(1.0, reach / np.maximum(metres, 1e-9))
        self._clearing: Float = np.full(shape, np.inf)
        self._clearing[move] = self._duration[move] * (share + self._late[row] * (1 - share))
        count = np.where(move, np.arange(1, shape[1] + 1), 0)
        self._settled: Int = np.maximum.accumulate(np.hstack([np.zeros((robots, 1), np.int64), count[:, :-1]]), axis=1)
        self.vertex: Int = np.empty(shape, np.int64)
        """Vertex i8[n,s] at which each segment begins."""
        self.vertex[:, 0] = problem.start
        for at in range(1, shape[1]):
            before = self.edge[:, at - 1]
            self.vertex[:, at] = np.where(before >= 0, roadmap.edges[before, 1], self.vertex[:, at - 1])
        old, more = self.begun.shape[2], (*self.begun.shape[:2], max(0, shape[1] - self.begun.shape[2]))
        keep = min(old, shape[1])
        self.begun = np.concatenate([self.begun[..., :keep], np.full(more, NOT_YET)], axis=2)
        self.ended = np.concatenate([self.ended[..., :keep], np.full(more, NOT_YET)], axis=2)

    def times(self, count: int) -> None:
        """Go on in `count` executions from where the only one is."""
        for name in ("reached", "cleared", "_done", "begun", "ended"):
            array = getattr(self, name)
            setattr(self, name, np.repeat(array, count, axis=0))

    @property
    def drained(self) -> Bool:
        """The executions bool[d] in which all robots have reached the ends of their paths."""
        found: Bool = np.asarray((self.reached >= self.length).all(axis=1))
        return found

    def view(self, execution: int, revision: int, granted: tuple[tuple[int, str], ...]) -> FleetView:
        """One of the fleets as a dispatcher sees it."""
        at, roadmap = self.reached[execution], self.problem.roadmap
        tail, edge = self.vertex[self._robot, at], self.edge[self._robot, at]
        head = np.where(edge >= 0, roadmap.edges[edge, 1], tail)
        share = self._done[execution] / np.maximum(self._duration[self._robot, at], 1e-9)
        place = roadmap.position[tail] + share[:, None] * (roadmap.position[head] - roadmap.position[tail])
        return FleetView(
            revision=revision,
            reached=at.astype(np.int32),
            cleared=self.cleared[execution].astype(np.int32),
            pose=np.column_stack([place, np.zeros(len(place))]),
            level=roadmap.level[tail],
            mode=np.where(share > 0, Mode.FOLLOWING, Mode.WAITING),
            granted=granted,
        )

    def step(
        self,
        released: Int,
        in_step: Int,
        limit: Float,
        delays: DrawnDelays,
        adversaries: Sequence[Adversary],
    ) -> None:
        """Move all robots for one control period.

        Args:
            released: i8[d,n].
            in_step: i8[k,4] as in `BatchOrders`.
            limit: m/s f8[d,n].
            delays: of d draws.
            adversaries: one for each execution, or none.
        """
        now = self.now * self.period
        delays.begun(now)
        stopped: Bool = delays.stopped.reshape(self.reached.shape)
        for number, adversary in enumerate(adversaries):
            adversary.update(now, self.reached[number], released[number])
            stopped[number] |= adversary.stopped
        self._end_waits(released)
        count = self.reached.size
        speed = delays.speed(np.arange(count), self.reached.reshape(-1)).reshape(self.reached.shape)
        speed = np.minimum(speed, limit * self._pace[self._robot, self.reached])
        going = (self.reached < released) & ~stopped
        self._keep_in_step(in_step, going, speed)
        execution, robot = np.nonzero(going)
        at = self.reached[execution, robot]
        fresh = self._done[execution, robot] == 0
        self.begun[execution[fresh], robot[fresh], at[fresh]] = self.now
        self._done[execution, robot] += speed[execution, robot] * self.period
        ends = self._done[execution, robot] >= self._duration[robot, at] - 1e-9
        execution, robot, at = execution[ends], robot[ends], at[ends]
        self.now += 1
        self.ended[execution, robot, at] = self.now
        self.reached[execution, robot] += 1
        self._done[execution, robot] = 0.0
        self._end_waits(released)
        on_way = (self._done >= self._clearing[self._robot, self.reached]) & (self._done > 0)
        cleared = np.where(on_way, self.reached + 1, self._settled[self._robot, self.reached])
        self.cleared = np.maximum(self.cleared, cleared)

    def _end_waits(self, released: Int) -> None:
        while (waits := (self.reached < released) & (self.edge[self._robot, self.reached] < 0)).any():
            self.reached += waits

    def _keep_in_step(self, in_step: Int, going: Bool, speed: Float) -> None:
        """Let the members of each group begin together, as fast as the slowest of them."""
        for number in range(int(in_step[:, 0].max(initial=-1)) + 1):
            _, execution, robot, segment = in_step[in_step[:, 0] == number].T
            at = self.reached[execution, robot]
            if (at < segment).any():
                held = at == segment
                going[execution[held], robot[held]] = False
                continue
            inside = at == segment
            execution, robot = execution[inside], robot[inside]
            going[execution, robot] = going[execution, robot].all()
            speed[execution, robot] = speed[execution, robot].min(initial=np.inf)
