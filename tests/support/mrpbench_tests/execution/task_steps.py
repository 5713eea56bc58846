"""Tasks without physics: robots follow each plan exactly, tick by tick, and are asked for the next one at vertices."""

import math

import attrs
import numpy as np

from mrpbench_core.api.assigner import Assigner
from mrpbench_core.api.planner import Planner
from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.engine.execution.destinations import Parking, Places
from mrpbench_core.engine.execution.queue_costs import QueueCosts
from mrpbench_core.engine.execution.task_manager import TaskManager
from mrpbench_core.engine.execution.visits import Visits
from mrpbench_core.model.common.arrays import Bool, Int, Int32
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.planning.plan import Budget, Paths, Plan
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_core.testing.fixtures.room import fleet
from mrpbench_tests.oracles.task_ledger import TaskLedger

BUDGET = Budget(wall_s=10.0, memory_bytes=1 << 30, iterations=10)


class TaskSteps:
    """Executes tasks on a roadmap whose edges take one tick, by the engine's `TaskManager`.

    Args:
        problem: robots at their starts.
        stream: gives the tasks.
        assigner: decides which robot does which.
        planner: is called when a robot has another errand.
        parking: where robots without a task go.
    """

    def __init__(
        self, problem: Problem, stream: TaskStream, assigner: Assigner, planner: Planner, parking: Parking = "stay"
    ) -> None:
        self.problem, self.tick, self.plans = problem, 0, 0
        self.ledger = TaskLedger()
        costs = QueueCosts(assigner.cost, problem.roadmap, fleet(len(problem)))
        places = Places(problem, costs.labels, parking, Feature.GOAL_SETS in planner.supports)
        sequences = Feature.GOAL_SEQUENCES in planner.supports
        self.tasks = TaskManager(stream, assigner, costs, places, problem, self.ledger, 0.0, sequences)
        self._roadmap, self._visits = problem.roadmap, Visits(problem, Plan(paths=()), 1e-6)
        self._session, self._reads = planner.start(), planner.reads_remaining
        self.at: Int = problem.start.astype(np.int64)
        """i8[n] where each robot is."""
        self._way = self.at[None]
        """i8[k,n] where each robot is in this tick and the next ones, by the current plan."""
        self._paths: Paths | None = None
        self._since = 0
        """The tick at which the current plan began."""

    def step(self, stopped: Bool | None = None, given_up: Bool | None = None, deaf: bool = False) -> None:
        """Let one tick pass.

        Args:
            stopped: bool[n] robots that are out of order, and stay where they are.
            given_up: bool[n] of them, robots that will not go on with their task.
            deaf: no plan is found if one is asked for.
        """
        robots, now = len(self.problem), self.tick * self.problem.roadmap.tick
        nobody = np.zeros(robots, bool)
        pose = np.column_stack([self._roadmap.position[self.at], np.zeros(robots)])
        state = State(
            pose=pose,
            twist=np.zeros((robots, 2)),
            level=self._roadmap.level[self.at],
            contacts=np.empty((0, 2), np.int32),
        )
        held = nobody if stopped is None else stopped
        self.tasks.begin(now, state, self.at, held, nobody if given_up is None else given_up)
        moving = (self._way[-1] != self.at).any()
        if self.tasks.reason(now) or (moving and held.any()):
            self._plan(now, held, deaf)
        ahead = self._way[1] if len(self._way) > 1 else self.at
        self._check(ahead)
        self.at, self._way, self.tick = ahead, self._way[1:] if len(self._way) > 1 else self._way, self.tick + 1
        self.ledger.position = self._roadmap.position[self.at]
        self._visits.update(self.ledger.position, self._roadmap.level[self.at], self._reached())
        arrived = (self._way == self._way[-1]).all(axis=0)
        self.tasks.judge(self.tick * self.problem.roadmap.tick, arrived, self._visits.count)

    def _plan(self, now: float, held: Bool, deaf: bool) -> None:
        """Ask for a plan from where robots are; without one, all stay."""
        to = self.tasks.destinations(now, held, self.problem)
        asked = attrs.evolve(self.problem, start=self.at.astype(np.int32), goals=to.goals)
        if self._reads and self._paths is not None:
            asked = attrs.evolve(asked, remaining=self._rest(self._paths))
        self.plans += 1
        result = None if deaf else self._session.plan(asked, BUDGET)
        if result is None or result.plan is None:
            self._way, self._paths = self.at[None], None
            return self.tasks.failed()
        self._visits.lead_to(to.goals, self.tasks.adopt(to))
        self._visits.follow(asked, result.plan)
        self._paths = Paths.of(result.plan.paths)
        self._way, self._since = _ways(asked, result.plan), self.tick
        return None

    def _reached(self) -> Int32:
        """The segments i4[n] of the current plan that are over."""
        robots = len(self.problem)
        if self._paths is None:
            return np.zeros(robots, np.int32)
        over = self._paths.leave <= self.tick - self._since
        return np.bincount(self._paths.robot[over], minlength=robots).astype(np.int32)

    def _rest(self, paths: Paths) -> Paths:
        """What is left of the current plan, counted from now on."""
        gone = self.tick - self._since
        rest = paths.part(self._reached(), paths.size)
        return attrs.evolve(rest, enter=np.maximum(rest.enter - gone, 0), leave=rest.leave - gone)

    def _check(self, ahead: Int) -> None:
        """Note robots that meet."""
        if len(np.unique(ahead)) < len(ahead):
            self.ledger.faults.append(f"tick {self.tick}: robots meet at a vertex")
        count = len(self.problem.roadmap.position)
        moved = ahead != self.at
        if np.isin((self.at * count + ahead)[moved], (ahead * count + self.at)[moved]).any():
            self.ledger.faults.append(f"tick {self.tick}: robots swap")


def _ways(problem: Problem, plan: Plan) -> Int:
    """Vertices i8[k,n] of all robots in each tick of a plan."""
    paths = Paths.of(plan.paths)
    way = np.repeat(problem.start.astype(np.int64)[None], int(paths.leave.max(initial=0)) + 1, axis=0)
    moves = paths.edge >= 0
    heads = problem.roadmap.edges[paths.edge[moves], 1]
    for robot, leave, head in zip(
        paths.robot[moves].tolist(), paths.leave[moves].tolist(), heads.tolist(), strict=True
    ):
        way[leave:, robot] = head
    return way


def until_done(run: TaskSteps, ticks: int) -> float:
    """Let ticks pass until all tasks are done; return the simulated seconds, inf if they are not."""
    for _ in range(ticks):
        if run.tasks.ended:
            return run.tick * run.problem.roadmap.tick
        run.step()
    return math.inf
