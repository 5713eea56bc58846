"""Checks that every dispatcher must pass, and what a dispatcher that keeps robots apart must keep."""

import contextlib
from typing import Any, ClassVar

import attrs
import numpy as np

from mrpbench_core.api.dispatcher import Dispatcher, DispatchError, DispatcherSession
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.execution.orders import BatchOrders, FleetView, Orders
from mrpbench_core.model.planning.plan import Plan, RobotPath
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Resource
from mrpbench_core.testing.drawing import path_through, problem
from mrpbench_core.testing.execution.delayed_executor import DelayedExecutor
from mrpbench_core.testing.execution.drain import MOST_STEPS, drain
from mrpbench_core.testing.execution.resource_manager import ResourceManager
from mrpbench_core.testing.faults import Fault, Skip, require
from mrpbench_core.testing.named_problems import BAY, CONVOY, CROSSING
from mrpbench_core.testing.suites.component import ComponentConformance

SEEDS = range(12)
EVERY = 6
"""Calls from one copy of a session to the next."""
DRAWN = {
    "a crossing": (CROSSING, ["dd", ".rr"]),
    "a corridor with a bay": (BAY, ["rrrr", "lu.dlll"]),
    "a convoy": (CONVOY, ["rrr", "rrr"]),
    "robots that stay": ("aA . bB", ["", "."]),
}
"""Plans without conflicts: a drawing, and the steps of each robot: right, left, up, down or . for a wait."""
CONFLICTING = {
    "a head-on swap": ("aB bA", ["r", "l"]),
    "two robots at one vertex": (CROSSING, ["dd", "rr"]),
    "a robot that drives into a parked one": ("a bB A", ["rr", ""]),
}
MOVES = {"r": (1, 0), "l": (-1, 0), "u": (0, 1), "d": (0, -1), ".": (0, 0)}


class DispatcherConformance(ComponentConformance):
    """Checks of dispatchers: `class TestMine(DispatcherConformance)`.

    A dispatcher that refuses a plan in which two robots collide, with a `DispatchError`, claims to keep robots apart
    and is checked for that under delays; one that accepts such a plan is not. Set `keeps_apart` to override this.
    """

    keeps_apart: ClassVar[bool | None] = None

    def make(self) -> Dispatcher:
        """Return the dispatcher to check."""
        raise NotImplementedError("define make(self) and return the dispatcher to check")

    def test_releases_ever_more_of_each_path(self) -> None:
        for name, (asked, plan) in plans().items():
            run(name, self.make().start(asked, plan), DelayedExecutor(asked, plan))

    def test_plans_drain_under_delays_and_robots_do_not_meet(self) -> None:
        apart = self.claims_to_keep_robots_apart()
        for name, (asked, plan) in plans().items():
            for seed in SEEDS:
                executor = delayed(asked, plan, seed)
                run(name, self.make().start(asked, plan), executor)
                met = executor.fault if apart else None
                require(met is None, f"{name}, robots being late: {met}")

    def test_refuses_or_survives_plans_with_conflicts(self) -> None:
        self.claims_safety()
        for name, (asked, plan) in conflicting().items():
            try:
                session = self.make().start(asked, plan)
            except DispatchError as refusal:
                require(str(refusal), f"refuses {name} without a reason: give `DispatchError` a message")
                continue
            executor = DelayedExecutor(asked, plan)
            with contextlib.suppress(Fault):  # to wait forever is safe
                run(name, session, executor)
            require(executor.fault is None, f"releases {name}: {executor.fault}")

    def test_refuses_plans_through_doors_or_requests_the_doors(self) -> None:
        self.check_resource("door")

    def test_requests_mutexes(self) -> None:
        self.claims_safety()  # a mutex only keeps robots apart
        self.check_resource("mutex")

    def test_goes_on_with_a_new_plan(self) -> None:
        for name, (asked, plan) in plans().items():
            session = self.make().start(asked, plan)
            executor = DelayedExecutor(asked, plan)
            executor.step(0, session.update(0.0, executor.view()).released)
            released = session.update(asked.roadmap.tick, executor.view()).released
            prefixes = tuple(
                RobotPath(edge=path.edge[:count], enter=path.enter[:count], leave=path.leave[:count])
                for path, count in zip(plan.paths, released.tolist(), strict=True)
            )
            again = attrs.evolve(asked, commitments=prefixes)
            session.adopt(again, plan, np.zeros(len(asked), np.int32))
            executor.adopt(again, plan)
            try:
                drain(session, executor, revision=1, released=released)
            except Fault as fault:
                raise Fault(f"{name}, after a new plan: {fault}") from None

    def test_sessions_do_not_disturb_one_another(self) -> None:
        asked, plan = plans()["a crossing"]
        dispatcher = self.make()
        one, other = dispatcher.start(asked, plan), dispatcher.start(asked, plan)
        idle = DelayedExecutor(asked, plan)
        before = other.update(0.0, idle.view()).released.copy()
        run("a crossing", one, DelayedExecutor(asked, plan))
        after = other.update(0.0, idle.view()).released
        require(np.array_equal(before, after), "a session releases more because another session has gone on")

    def test_robots_wait_for_others_that_exist(self) -> None:
        for name, (asked, plan) in plans().items():
            session, executor = self.make().start(asked, plan), delayed(asked, plan, 0)
            for step in range(2 * EVERY):
                executor.step(step, session.update(step * asked.roadmap.tick, executor.view()).released)
                for robot in range(len(asked)):
                    blockers = session.waits_for(robot)
                    others = set(range(len(asked))) - {robot}
                    require(
                        blockers is None or others.issuperset(blockers), f"{name}: robot {robot} waits for {blockers}"
                    )

    def test_copies_go_on_as_their_sessions_do(self) -> None:
        for name, (asked, plan) in plans().items():
            watched = Watched(self.make().start(asked, plan))
            run(name, watched, delayed(asked, plan, 0))
            for number, copied in watched.copies.items():
                for now, view, orders in watched.calls[number:]:
                    same = copied.update(now, view) == orders
                    require(same, f"{name}: a copy returns other orders than the session at {now} s")

    def test_many_executions_at_once_are_those_of_each_session(self) -> None:
        for name, (asked, plan) in plans().items():
            executors = [delayed(asked, plan, seed) for seed in SEEDS]
            together = self.make().start(asked, plan).batch(len(executors))
            if together is None:
                continue
            sessions = [self.make().start(asked, plan) for _ in executors]
            for step in range(MOST_STEPS):
                now, views = step * asked.roadmap.tick, [executor.view() for executor in executors]
                progress = np.array([[view.reached for view in views], [view.cleared for view in views]], np.int64)
                orders = together.update(now, progress)
                for execution, (session, executor) in enumerate(zip(sessions, executors, strict=True)):
                    alone = session.update(now, views[execution])
                    require(np.array_equal(orders.released[execution], alone.released), f"{name}: releases other moves")
                    require(
                        in_step(orders, execution) == set(map(frozenset, alone.in_step)),
                        f"{name}: keeps others in step",
                    )
                    executor.step(step, alone.released)
                if all(executor.done for executor in executors):
                    break

    def check_resource(self, kind: str) -> None:
        """Release plans through a resource under delays, unless the dispatcher refuses them."""
        asked, plan = through_resource(kind)
        for seed in SEEDS:
            try:
                session = self.make().start(asked, plan)
            except DispatchError as refusal:
                raise Skip(f"it refuses plans through a {kind}: {refusal}") from None
            manager = ResourceManager(asked, np.random.default_rng(seed))
            run(f"a crossing with a {kind}", session, delayed(asked, plan, seed), manager)
            require(manager.fault is None, f"a crossing with a {kind}: {manager.fault}")

    def claims_safety(self) -> None:
        """Skip unless the dispatcher keeps robots apart."""
        if not self.claims_to_keep_robots_apart():
            raise Skip("it does not claim to keep robots apart: it accepts plans with conflicts")

    def claims_to_keep_robots_apart(self) -> bool:
        """Tell whether the dispatcher refuses a plan in which two robots collide."""
        if self.keeps_apart is None:
            asked, plan = conflicting()["a head-on swap"]
            try:
                self.make().start(asked, plan)
            except DispatchError:
                return True
        return bool(self.keeps_apart)


class Watched(DispatcherSession):
    """A session that keeps what it is asked and answers, and copies of itself if it can make them."""

    def __init__(self, session: DispatcherSession) -> None:
        self._session = session
        self.calls: list[tuple[float, FleetView, Orders]] = []
        self.copies: dict[int, DispatcherSession] = {}
        """As they were before the call of that number."""

    def update(self, now: float, view: FleetView) -> Orders:
        """Ask the session."""
        number = len(self.calls)
        if number % EVERY == 0 and (copied := self._session.copied()) is not None:
            self.copies[number] = copied
        self.calls.append((now, view, self._session.update(now, view)))
        return self.calls[-1][2]

    def adopt(self, problem: Problem, plan: Plan, cut: Int32 | None = None) -> None:
        """Ask the session."""
        self._session.adopt(problem, plan, cut)


def run(
    name: str, session: DispatcherSession, executor: DelayedExecutor, manager: ResourceManager | None = None
) -> None:
    """Drain a plan; a fault begins with the name of the plan."""
    try:
        drain(session, executor, manager)
    except Fault as fault:
        raise Fault(f"{name}: {fault}") from None


def in_step(orders: BatchOrders, execution: int) -> set[frozenset[tuple[int, int]]]:
    """The groups that rotate in one execution, as in `Orders`."""
    rows = orders.in_step[orders.in_step[:, 1] == execution].tolist()
    groups = {row[0] for row in rows}
    return {frozenset((robot, segment) for group, _, robot, segment in rows if group == each) for each in groups}


def delayed(asked: Problem, plan: Plan, seed: int) -> DelayedExecutor:
    """Robots at their starts that will be late."""
    return DelayedExecutor(asked, plan, np.random.default_rng(seed))


def plans() -> dict[str, tuple[Problem, Plan]]:
    """Plans without conflicts, by name."""
    plans = {name: drawn(*entry) for name, entry in DRAWN.items()}
    assert all(check_plan(asked, plan).valid for asked, plan in plans.values())
    return plans


def conflicting() -> dict[str, tuple[Problem, Plan]]:
    """Plans in which robots collide, by name."""
    return {name: drawn(*entry) for name, entry in CONFLICTING.items()}


def through_resource(kind: str) -> tuple[Problem, Plan]:
    """A crossing whose middle, with the edges that lead there, admits one robot at a time.

    The second robot waits for longer than any number of moves before the resource at which it is requested.
    """
    _, plan = drawn(CROSSING, ["dd", "...rr"])
    asked = problem(CROSSING)
    middle = asked.roadmap.nearest(1.5, 1.5)[0]
    edges = tuple(np.flatnonzero((asked.roadmap.edges == middle).any(axis=1)).tolist())
    resource = Resource(name="middle", kind=kind, vertices=(middle,), edges=edges)
    asked = problem(CROSSING, roadmap=attrs.evolve(asked.roadmap, resources=(resource,)))
    assert check_plan(asked, plan).valid
    return asked, plan


def drawn(drawing: str, steps: list[str], **fields: Any) -> tuple[Problem, Plan]:
    """The problem of a drawing, and the plan of the steps of each robot."""
    asked = problem(drawing, **fields)
    roadmap = asked.roadmap
    paths = []
    for start, letters in zip(asked.start.tolist(), steps, strict=True):
        vertices = [start]
        for letter in letters:
            vertices.append(roadmap.nearest(*(roadmap.position[vertices[-1]] + MOVES[letter]))[0])
        paths.append(path_through(roadmap, vertices))
    return asked, Plan(paths=tuple(paths))
