"""Plans drain under random delays, without deadlock and without two robots in one place.

The floor below moves robots along what is released, each as slowly as chance will have it, and watches them by rules of
its own: who enters a vertex that another has not cleared must be part of a ring that starts together, robots come to
each vertex in the plan's order, and footprints never overlap.
"""

from collections import defaultdict
from importlib.metadata import entry_points
from itertools import combinations, pairwise

import attrs
import numpy as np
import pytest
from delayed_floor import Floor, draw_plan, draw_problem, draw_roadmap, wander
from hypothesis import event, given, settings
from hypothesis import strategies as st

from mrpbench_core.api import DispatchError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.engine.execution.commitments import commitments
from mrpbench_core.model.plan import Budget, Plan
from mrpbench_core.model.problem import Feature, Rules, features_of

SEEDS = st.integers(0, 2**32 - 1)


def drain(make, session, floor, replans=None):
    """Run until everybody has arrived; `replans` gives, by step, functions of what is released to problem and plan."""
    released = np.zeros(len(floor.reached), int)
    replans = dict(replans or {})
    revision = 0
    for now in range(20_000):
        orders = session.update(float(now), make.view(floor.reached, floor.cleared, revision))
        assert (orders.released >= released).all(), "took back what it had released"
        released = orders.released
        alive = floor.step(now, released)
        if now in replans:
            problem, plan = replans.pop(now)(released)
            if accepted(problem, plan, lambda *new: session.adopt(*new) or True):
                floor.adopt(problem, plan)
                revision += 1
        elif floor.done and not replans:
            return
        elif not alive and not replans:
            again = session.update(float(now), make.view(floor.reached, floor.cleared, revision)).released
            assert (again > released).any(), "deadlock"
    raise AssertionError("not done in 20,000 steps")


def accepted(problem, plan, take):
    """What `take` makes of a plan, or None where it refuses it for a cycle that is there indeed."""
    try:
        return take(problem, plan)
    except DispatchError as refusal:
        assert "wait for one another" in str(refusal) or "in a ring at once" in str(refusal), refusal  # noqa: PT017
        assert cycle_in(problem, plan)
        return None


def cycle_in(problem, plan):
    """Tell, by a search of its own, whether moves wait for one another: at each vertex, who comes for who went."""
    after = defaultdict(set)
    visits = defaultdict(list)  # of each vertex: (arrival, move in, move out)
    for robot, path in enumerate(plan.paths):
        moves = [(robot, segment) for segment in np.flatnonzero(path.edge >= 0).tolist()]
        arrivals = [-1, *(int(path.leave[segment]) for _, segment in moves)]
        vertices = [int(problem.start[robot]), *(int(problem.roadmap.edges[path.edge[at], 1]) for _, at in moves)]
        for vertex, *visit in zip(vertices, arrivals, [None, *moves], [*moves, None], strict=True):
            visits[vertex].append(visit)
        for one, other in pairwise(moves):
            after[one].add(other)
    for here in visits.values():
        for (_, _, out), (_, into, _) in combinations(sorted(here, key=lambda visit: visit[0]), 2):
            if out is not None and into is not None and out[0] != into[0]:
                after[out].add(into)
    nodes = set(after) | {node for those in after.values() for node in those}
    while free := nodes - {node for one in nodes for node in after[one]}:
        nodes -= free
    return bool(nodes)


@settings(deadline=None, max_examples=60)
@given(SEEDS)
def test_plans_of_chance_drain(make, seed):
    random = np.random.default_rng(seed)
    problem, plan = draw_plan(make, random)
    session = accepted(problem, plan, Adg().start)
    event(f"refused: {session is None}")
    if session is not None:
        floor = Floor(problem, plan, random)
        drain(make, session, floor)
        event(f"rings: {floor.rings > 0}")


@settings(deadline=None, max_examples=80)
@given(SEEDS)
def test_plans_that_change_on_the_way_drain(make, seed):
    random = np.random.default_rng(seed)
    problem, plan = draw_plan(make, random)

    def replan(released):
        now, due = floor.late, floor.late + int(random.integers(0, 40))
        floor.late = due
        ready = now + random.integers(0, 5, len(problem))
        prefixes = commitments(problem, session.plan, released, floor.reached, ready, due)
        committed = attrs.evolve(problem, commitments=prefixes)
        assert check_plan(committed, Plan(paths=prefixes)).valid, "what was released conflicts once it is retimed"
        return committed, wander(committed, random, list(prefixes), ticks=5)

    problem = attrs.evolve(problem, rules=attrs.evolve(problem.rules, at_goal="stay"))
    if check_plan(problem, plan).valid and (session := accepted(problem, plan, Adg().start)) is not None:
        floor = Floor(problem, plan, random)
        floor.late = int(random.integers(0, 40))
        drain(make, session, floor, {int(step): replan for step in random.integers(0, 60, 3)})


@settings(deadline=None, max_examples=40)
@given(SEEDS)
@pytest.mark.parametrize("name", ["example", "prioritized", "cbs"])
def test_plans_of_planners_drain(make, name, seed):
    found = {point.name: point for point in entry_points(group="mrpbench.planners")}
    if name not in found:
        pytest.skip(f"no planner {name} is installed")
    try:
        planner = found[name].load()()
    except ImportError as error:
        pytest.skip(f"planner {name} cannot be imported: {error}")
    random = np.random.default_rng(seed)
    problem = draw_problem(make, random, draw_roadmap(make, random))
    if name == "cbs" and len(problem) > 5:
        return
    goals = random.permutation(len(problem.roadmap.position))[: len(problem)]
    problem = attrs.evolve(problem, goals=tuple(((int(goal),),) for goal in goals), rules=Rules())
    for features in (features_of(problem), features_of(problem) | {Feature.FOOTPRINTS}):
        asked = attrs.evolve(problem, features=features)
        if planner.skip(asked) is None:
            result = planner.plan(asked, Budget(wall_s=0.2, memory_bytes=1 << 30))
            event(str(result.status))
            if result.plan is not None and (session := accepted(asked, result.plan, Adg().start)) is not None:
                drain(make, session, Floor(asked, result.plan, random))
