"""A planner that asks a policy what each robot does in each step."""

import time
from functools import lru_cache
from pathlib import Path
from typing import ClassVar, Literal

import attrs
import numpy as np

from mrpbench_core.api import (
    Budget,
    Feature,
    Int,
    Plan,
    Planner,
    PlannerSession,
    PlanResult,
    PlanStatus,
    Problem,
    Promise,
    Roadmap,
    between,
    option,
)
from mrpbench_policies.acting import Acting, load
from mrpbench_policies.board import Board, board_of, paths_of
from mrpbench_policies.fleet_state import FleetState
from mrpbench_policies.observations import OBSERVATIONS, CostToGo, Observation
from mrpbench_policies.rollout import Rollout
from mrpbench_policies.shields import SHIELDS
from mrpbench_policies.timing import timed_paths

SHIPPED = Path(__file__).parent / "weights" / "imitation.onnx"
"""The policy that `scripts/train_policy.py` makes."""
TOLERANCE = 1e-9
"""metres."""


@attrs.frozen(kw_only=True)
class PolicyPlanner(Planner):
    """Rolls a learned policy out on the cells of a raster: one call for all robots in each step, until all are at their
    goals. The metric `policy` says how many actions the shield replaced.

    Where turns or moves take time or robots have footprints, the policy sees robots as points that move one cell in a
    step all the same. The plan keeps the order in which robots pass each cell, and takes the time that they need.
    """

    supports: ClassVar[frozenset[Feature]] = frozenset(
        {
            Feature.EDGE_DURATIONS,
            Feature.FOOTPRINTS,
            Feature.GOAL_SEQUENCES,
            Feature.GOAL_SETS,
            Feature.HEADINGS,
            Feature.HORIZON,
            Feature.SHARED_GOALS,
        }
    )
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.DETERMINISTIC})

    file: Path | None = option(
        None,
        help="the policy: an ONNX model, or a Python file with a class `Policy`; none: a small one that imitates "
        "LaCAM*, with the observation cost_to_go of radius 4",
    )
    python: Path | None = option(
        None,
        help="the interpreter of another environment, which runs a Python file; none: the file is run with the planner",
    )
    weights: Path | None = option(
        None,
        help="another file that the policy reads, which then identifies runs as `file` does: the external data of an "
        "ONNX model, or the third argument of the class `Policy`",
    )
    observation: Literal["pogema", "pogema_pomapf", "pogema_mapf", "mapf_gpt", "primal", "scrimp", "cost_to_go"] = (
        option("pogema", help="what the policy gets of each robot")
    )
    radius: int = option(5, help="cells to each side in the windows of an observation", validator=between(1, 64))
    shield: Literal["stop", "pibt"] = option(
        "stop",
        help="stop: robots stay whose actions are illegal or conflict; pibt: priority inheritance with the preferences "
        "of the policy",
    )
    sampling: bool = option(
        False, help="draw actions in proportion to the exponential of their scores instead of taking the best one"
    )
    steps: int = option(256, help="steps after which it gives up", validator=between(1, 1_000_000))

    @property
    def kept_promises(self) -> frozenset[Promise]:
        """Python files may do anything, so that nothing says that they repeat it."""
        python = self.file is not None and self.file.suffix == ".py"
        return self.promises - ({Promise.DETERMINISTIC} if python else set())

    def idle_options(self) -> dict[str, str]:
        """Return the options that the policy of this distribution makes idle."""
        if self.file is None:
            return dict.fromkeys(("observation", "radius", "python", "weights"), "`file` is not set")
        return {"python": "`file` is not a Python file"} if self.file.suffix != ".py" else {}

    def skip(self, problem: Problem) -> str | None:
        """Return why the policy cannot be asked.

        Raises:
            InputError: the file is no policy for the observation.
        """
        if reason := super().skip(problem):
            return reason
        board = board_of(problem.roadmap, self.build_observation().radius)
        if isinstance(board, str):
            return board
        cell = 0.0 if problem.roadmap.grid is None else problem.roadmap.grid.cell_size
        if Feature.FOOTPRINTS in problem.features and 2 * problem.radius.max() > cell + TOLERANCE:
            return f"needs robots that fit into a cell of {cell:g} m"
        self.load(board.maps.shape)
        return None

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Roll the policy out from its beginning."""
        return self.start().plan(problem, budget)

    def start(self) -> "PolicySession":
        """Begin an execution, during which the policy remembers."""
        return PolicySession(self)

    def build_observation(self) -> Observation:
        """Return what builds the observations."""
        return CostToGo(4) if self.file is None else OBSERVATIONS[self.observation](self.radius)

    def load(self, shape: tuple[int, int]) -> Acting:
        """Return the policy, for maps of a shape; the last ones are kept.

        Raises:
            InputError: the file is no policy for the observation.
        """
        file = self.file or SHIPPED
        changed = tuple(_stamp(it) for it in (file, self.weights) if it is not None)
        observation = self.build_observation()
        return _loaded(file, changed, type(observation), observation.radius, shape, self.python, self.weights)


def _stamp(file: Path) -> tuple[int, int]:
    """Time of the last change and size of a file; zeros without one."""
    stat = file.stat() if file.exists() else None
    return (stat.st_mtime_ns, stat.st_size) if stat else (0, 0)


@lru_cache(maxsize=4)
def _loaded(
    file: Path,
    _: tuple[tuple[int, int], ...],
    observation: type[Observation],
    radius: int,
    shape: tuple[int, int],
    python: Path | None,
    weights: Path | None,
) -> Acting:
    return load(file, observation(radius), shape, python, weights)


class PolicySession(PlannerSession):
    """Plans again and again; see `PolicyPlanner`.

    In a later call the policy goes on, for each robot, from the last step of the plan before in which that robot was
    where it is now; where there is none, it remembers nothing of that robot.
    """

    def __init__(self, planner: PolicyPlanner) -> None:
        self._planner = planner
        self._last: Rollout | None = None
        self._generator: np.random.Generator | None = None
        self._known: tuple[Roadmap, Board] | None = None

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Roll the policy out until all robots are at their goals, or until the horizon."""
        until = time.monotonic() + budget.wall_s
        planner = self._planner
        board = self._board_of(problem.roadmap)
        errands = _Errands(problem, board)
        state = FleetState.at(board.maps, board.place[problem.start][None], errands.goals()[None])
        acting = planner.load(board.maps.shape)
        acting.begin(len(problem), budget.seed)
        if self._generator is None and planner.sampling:
            self._generator = np.random.default_rng(budget.seed)
        rollout = Rollout(
            state=state,
            acting=acting,
            observation=planner.build_observation(),
            shield=SHIELDS[planner.shield],
            sampling=self._generator,
            priority=np.zeros(len(problem), np.int64),
        )
        timed = not board.is_unit or Feature.FOOTPRINTS in problem.features
        rollout.rings = not timed
        self._resume(rollout)
        steps = planner.steps if problem.horizon is None else _steps_until(problem.horizon, board, problem)
        done = rollout.run(steps, until, errands.update)
        self._last = rollout
        if done is None or (not done and problem.horizon is None):
            status = PlanStatus.TIMEOUT if done is None else PlanStatus.GAVE_UP
            return PlanResult(status=status, statistics=_statistics(rollout))
        trace = np.array(rollout.trace)
        paths = timed_paths(board, problem, trace, errands.stops(trace)) if timed else paths_of(board, trace)
        plan = Plan(paths=paths)
        return PlanResult(status=PlanStatus.SOLVED, plan=plan, statistics=_statistics(rollout))

    def _board_of(self, roadmap: Roadmap) -> Board:
        """The cells of a roadmap, with the distances that were needed on the last one if it is the same."""
        if self._known is None or self._known[0] is not roadmap:
            board = board_of(roadmap, self._planner.build_observation().radius)
            assert isinstance(board, Board), "`skip` refuses other roadmaps"
            self._known = roadmap, board
        return self._known[1]

    def _resume(self, rollout: Rollout) -> None:
        """Let the policy remember the last call."""
        last = self._last
        if last is None or last.state.place.shape != rollout.state.place.shape:
            return
        trace = np.array(last.trace)
        here = trace == rollout.state.place[0]
        known = here.any(axis=0)
        step = len(trace) - 1 - here[::-1].argmax(axis=0)
        memory = rollout.acting.memory
        for robot in np.flatnonzero(known).tolist():
            remembered, chosen = last.memories[step[robot]]
            rollout.state.chosen[0, robot] = chosen[robot]
            for name, array in memory.items():
                if name in remembered:
                    array[robot] = remembered[name][robot]
        rollout.acting.memory = memory
        rollout.state.start = last.state.start
        same = known & (last.state.goal == rollout.state.goal)[0]
        rollout.priority = np.where(same, last.priority, 0)


class _Errands:
    """The goals of the robots: of a set the nearest that no robot before takes, of a sequence one after another."""

    def __init__(self, problem: Problem, board: Board) -> None:
        self._board, self._problem = board, problem
        self._number: Int = np.zeros(len(problem), np.int64)
        self._goal: list[int] = []
        self._visits: list[tuple[int, int, int]] = []
        self._step = 0
        for robot, start in enumerate(problem.start.tolist()):
            self._goal.append(self._choice(robot, start, self._goal))

    def goals(self) -> Int:
        """Return the places i8[n] of the goals now."""
        return self._board.place[self._goal]

    def stops(self, trace: Int) -> list[tuple[int, int, int]]:
        """Return step, robot and goal of each visit, also of those that last until the end."""
        ends = (trace[-1] == self.goals()).nonzero()[0].tolist()
        has_goal = [robot for robot in ends if self._problem.goals[robot]]
        return [*self._visits, *((len(trace) - 1, robot, self._goal[robot]) for robot in has_goal)]

    def update(self, state: FleetState) -> bool:
        """Give robots that have reached a goal the next one; tell whether all have reached their last ones."""
        place = state.place[0]
        for robot in np.flatnonzero(state.on_goal[0]).tolist():
            while (
                self._number[robot] < len(self._problem.goals[robot]) - 1
                and self._board.place[self._goal[robot]] == place[robot]
            ):
                self._visits.append((self._step, robot, self._goal[robot]))
                self._number[robot] += 1
                self._goal[robot] = self._choice(robot, self._goal[robot], [])
        self._step += 1
        state.goal[0] = self.goals()
        last = self._number >= np.array([len(goals) - 1 for goals in self._problem.goals])
        return self._problem.horizon is None and bool((state.on_goal[0] & last).all())

    def _choice(self, robot: int, at: int, taken: list[int]) -> int:
        """The vertex to go to from vertex `at`."""
        goals = self._problem.goals[robot]
        if not goals:
            return at
        options = goals[int(self._number[robot])]
        if len(options) == 1:
            return int(options[0])
        free = [vertex for vertex in options if vertex not in taken] or list(options)
        if at in free:
            return at
        maps, place = self._board.maps, self._board.place
        table = maps.distances(int(place[at]))
        return int(min(free, key=lambda vertex: (int(table[place[vertex]]), vertex)))


def _steps_until(horizon: int, board: Board, problem: Problem) -> int:
    """The steps that robots can make until a tick, if all moves take the time of the fastest one."""
    moves = np.unique(board.leads[board.leads >= 0])
    fastest = int(problem.roadmap.duration[:, moves].min(initial=horizon + 1))
    return -(-horizon // fastest)


def _statistics(rollout: Rollout) -> dict[str, float]:
    counts = rollout.counts
    return {
        "steps": float(len(rollout.trace) - 1),
        "illegal_actions": float(counts.illegal),
        "conflicting_actions": float(counts.conflicting),
    }
