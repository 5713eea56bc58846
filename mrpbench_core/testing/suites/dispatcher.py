"""What every dispatcher must keep, and what those must that keep robots apart."""

from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api.dispatcher import Dispatcher, DispatchError, DispatcherSession
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.execution import Orders
from mrpbench_core.model.plan import Path, Plan
from mrpbench_core.model.problem import Problem
from mrpbench_core.testing.drawing import problem, unit_path
from mrpbench_core.testing.execution.floor import Floor, requires_released
from mrpbench_core.testing.faults import Fault, Skip, require
from mrpbench_core.testing.instances.named import BAY, CONVOY, CROSSING
from mrpbench_core.testing.suites.component import ComponentConformance

SEEDS = range(12)
MOST_STEPS = 5000
DRAWN = {
    "a crossing": (CROSSING, ["dd", ".rr"]),
    "a corridor with a bay": (BAY, ["rrrr", "lu.dlll"]),
    "a convoy": (CONVOY, ["rrr", "rrr"]),
    "robots that stay": ("aA . bB", ["", "."]),
}
"""Plans without conflicts: a drawing, and the steps of each robot, right, left, up, down or wait."""


class DispatcherConformance(ComponentConformance):
    """Checks of dispatchers: `class TestMine(DispatcherConformance)`.

    A dispatcher that refuses a plan in which two robots collide, with a `DispatchError`, is taken to keep robots apart,
    and held to that under delays; one that accepts it is not. Set `keeps_apart` to say which it is instead.
    """

    keeps_apart: ClassVar[bool | None] = None

    def make(self) -> Dispatcher:
        """Return the dispatcher to check."""
        raise NotImplementedError("define make(self) and return the dispatcher to check")

    def test_releases_ever_more_of_each_path(self) -> None:
        for name, (asked, plan) in plans().items():
            run(name, self.make().start(asked, plan), Floor(asked, plan, 0, delays=False), plan, asked)

    def test_plans_drain_under_delays(self) -> None:
        for name, (asked, plan) in plans().items():
            for seed in SEEDS:
                run(name, self.make().start(asked, plan), Floor(asked, plan, seed, delays=True), plan, asked)

    def test_delays_do_not_make_robots_meet(self) -> None:
        self.claims_safety()
        for name, (asked, plan) in plans().items():
            for seed in SEEDS:
                floor = Floor(asked, plan, seed, delays=True)
                run(name, self.make().start(asked, plan), floor, plan, asked)
                require(floor.met is None, f"{name}: robots {floor.met} came to one vertex when they were late")

    def test_refuses_or_survives_plans_with_conflicts(self) -> None:
        self.claims_safety()
        for name, (asked, plan) in conflicting().items():
            try:
                session = self.make().start(asked, plan)
            except DispatchError as refusal:
                require(str(refusal), f"refuses {name} without saying why")
                continue
            floor = Floor(asked, plan, 0, delays=False)
            run(name, session, floor, plan, asked, must_arrive=False)
            require(floor.met is None, f"releases {name}, and robots {floor.met} collide")

    def test_goes_on_with_a_new_plan(self) -> None:
        for name, (asked, plan) in plans().items():
            session = self.make().start(asked, plan)
            floor = Floor(asked, plan, 0, delays=False)
            released = session.update(0.0, floor.view()).released
            floor.step(released)
            released = session.update(asked.roadmap.tick, floor.view()).released
            prefixes = tuple(
                Path(edge=path.edge[:count], enter=path.enter[:count], leave=path.leave[:count])
                for path, count in zip(plan.paths, released.tolist(), strict=True)
            )
            again = attrs.evolve(asked, commitments=prefixes)
            session.adopt(again, plan)
            run(f"{name}, adopted on the way", session, floor, plan, again, released, revision=1)

    def test_sessions_do_not_disturb_one_another(self) -> None:
        asked, plan = plans()["a crossing"]
        dispatcher = self.make()
        one, other = dispatcher.start(asked, plan), dispatcher.start(asked, plan)
        idle = Floor(asked, plan, 0, delays=False)
        before = other.update(0.0, idle.view()).released.copy()
        run("a crossing", one, Floor(asked, plan, 0, delays=False), plan, asked)
        after = other.update(0.0, idle.view()).released
        require(np.array_equal(before, after), "one session releases more because another has gone on")

    def claims_safety(self) -> None:
        """Skip unless the dispatcher keeps robots apart."""
        claims = self.keeps_apart
        if claims is None:
            asked, plan = conflicting()["a head-on swap"]
            try:
                self.make().start(asked, plan)
            except DispatchError:
                claims = True
        if not claims:
            raise Skip("it accepts plans in which robots collide, so it does not claim to keep them apart")


def run(
    name: str,
    session: DispatcherSession,
    floor: Floor,
    plan: Plan,
    asked: Problem,
    released: np.ndarray | None = None,
    revision: int = 0,
    must_arrive: bool = True,
) -> None:
    """Let robots do what is released until all have arrived.

    Raises:
        Fault: an order breaks the contract, or nothing happens any more.
    """
    before = np.zeros(len(asked), int) if released is None else released
    end = max((int(path.leave[-1]) for path in plan.paths if len(path)), default=0)
    for step in range(MOST_STEPS):
        now = step * asked.roadmap.tick
        orders = session.update(now, attrs.evolve(floor.view(), revision=revision))
        require(isinstance(orders, Orders), f"returns {type(orders).__name__} instead of Orders")
        requires_released(orders.released, before, plan)
        before = orders.released
        alive = floor.step(before)
        if floor.done:
            return
        if not alive and step > 2 * end + 100:  # a dispatcher may wait for the clock
            break
    if must_arrive:
        waits = [robot for robot, edges in enumerate(floor.edges) if floor.reached[robot] < len(edges)]
        raise Fault(f"{name}: robots {waits} wait for ever, though the plan has no conflict")


def plans() -> dict[str, tuple[Problem, Plan]]:
    """Plans without conflicts, by name."""
    found = {}
    for name, (drawing, steps) in DRAWN.items():
        asked = problem(drawing)
        plan = Plan(paths=tuple(stepped(asked, robot, letters) for robot, letters in enumerate(steps)))
        report = check_plan(asked, plan)
        assert report.valid, report
        found[name] = asked, plan
    return found


def conflicting() -> dict[str, tuple[Problem, Plan]]:
    """Plans in which robots collide, by name."""
    drawn = {
        "a head-on swap": ("aB bA", ["r", "l"]),
        "two robots at one vertex": (CROSSING, ["dd", "rr"]),
        "a robot that drives into a parked one": ("a bB A", ["rr", ""]),
    }
    return {
        name: (asked, Plan(paths=tuple(stepped(asked, robot, letters) for robot, letters in enumerate(steps))))
        for name, (drawing, steps) in drawn.items()
        for asked in [problem(drawing)]
    }


def stepped(asked: Problem, robot: int, letters: str) -> Path:
    """One tick for each letter: right, left, up, down or `.` for a wait."""
    moves = {"r": (1, 0), "l": (-1, 0), "u": (0, 1), "d": (0, -1)}
    roadmap = asked.roadmap
    at = int(asked.start[robot])
    edges = []
    for letter in letters:
        if letter == ".":
            edges.append(-1)
            continue
        head = roadmap.nearest(*(roadmap.position[at] + moves[letter]))[0]
        edges.append(int(np.flatnonzero((roadmap.edges == (at, head)).all(axis=1))[0]))
        at = head
    return unit_path(edges)
