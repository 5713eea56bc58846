"""Robots of many executions: what they use is judged as the validator judges plans, and sessions may be shared."""

import numpy as np
from hypothesis import event, given, settings
from hypothesis import strategies as st
from mrpbench_tests.execution.batch_executor import BatchExecutor
from mrpbench_tests.execution.meetings import meetings
from mrpbench_tests.instances.random_plans import random_plan, random_plan_with_resources

from mrpbench_core.api import DispatchError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.checking.conflicts import find_conflicts
from mrpbench_core.config.delays import Delays
from mrpbench_core.engine.execution.delays import DrawnDelays
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.model.planning.plan import Plan, RobotPath

SEEDS = st.integers(0, 2**32 - 1)
DELAYS = Delays(p_delay=0.1, max_delay=6, speed=0.3)
EXECUTIONS = 6
NONE = np.empty((0, 4), np.int64)


def executed(executor, execution):
    """The plan that the robots of one execution have followed, in steps."""
    paths = []
    for robot in range(len(executor.problem)):
        edge, enter, leave, last = [], [], [], 0
        for segment in np.flatnonzero(executor.edge[robot] >= 0).tolist():
            begun, ended = (int(it[execution, robot, segment]) for it in (executor.begun, executor.ended))
            if begun > last:
                edge, enter, leave = [*edge, -1], [*enter, last], [*leave, begun]
            edge, enter, leave = [*edge, int(executor.edge[robot, segment])], [*enter, begun], [*leave, ended]
            last = ended
        paths.append(RobotPath(edge=edge, enter=enter, leave=leave))
    return Plan(paths=tuple(paths))


@settings(deadline=None, max_examples=40)
@given(SEEDS, st.booleans())
def test_executions_in_which_robots_break_rules_are_those_whose_plans_the_validator_refuses(seed, resources):
    random = np.random.default_rng(seed)
    problem, plan = (random_plan_with_resources if resources else random_plan)(random)
    for resource in problem.roadmap.resources:
        object.__setattr__(resource, "setup_ticks", 0)  # executions do not know these
    executor = BatchExecutor(problem, plan, 0.5, random)
    executor.times(EXECUTIONS)
    delays = DrawnDelays(DELAYS, len(problem), Seeds(seed), range(EXECUTIONS))
    free, all_of = np.full(executor.reached.shape, np.inf), np.tile(executor.length, (EXECUTIONS, 1))
    while not executor.drained.all():
        executor.step(all_of, NONE, free, delays, ())
    refused = [it for it in range(EXECUTIONS) if find_conflicts(problem, executed(executor, it), limit=1)]
    event(f"refused: {bool(refused)}")
    assert [execution for execution, _ in meetings(executor)] == refused


@settings(deadline=None, max_examples=30)
@given(SEEDS)
def test_one_session_for_all_executions_releases_what_a_session_for_each_does_from_any_time_on(seed):
    random = np.random.default_rng(seed)
    problem, plan = random_plan(random)
    try:
        session = Adg(lookahead=int(random.integers(1, 4))).start(problem, plan)
    except DispatchError:
        return
    begun = []
    until, late = int(random.integers(0, 12)), int(random.integers(2**31))
    alone = BatchExecutor(problem, plan, 0.5, np.random.default_rng(late))
    proceed([session], alone, until, 0)
    for at_once in (False, True):
        executor = BatchExecutor(problem, plan, 0.5, np.random.default_rng(late))
        proceed([Adg(lookahead=session.options.lookahead).start(problem, plan)], executor, until, 0)
        executor.times(EXECUTIONS)
        sessions = session.batch(EXECUTIONS) if at_once else [session.copied() for _ in range(EXECUTIONS)]
        proceed(sessions, executor, 5000, 1)
        assert executor.drained.all()
        assert not meetings(executor)
        begun.append(executor.begun)
    assert np.array_equal(*begun)


def proceed(sessions, executor, until, repeat):
    """Go on until all robots have arrived, or until a step."""
    executions = len(executor.reached)
    delays = DrawnDelays(DELAYS, len(executor.problem), Seeds(5, repeat), range(executions))
    free = np.full(executor.reached.shape, np.inf)
    while executor.now < until and not executor.drained.all():
        now = executor.now * executor.period
        if isinstance(sessions, list):
            orders = [session.update(now, executor.view(it, 0, ())) for it, session in enumerate(sessions)]
            released = np.stack([order.released for order in orders])
            groups = [(it, group) for it, order in enumerate(orders) for group in order.in_step]
            rows = [(k, it, *member) for k, (it, group) in enumerate(groups) for member in group]
            in_step = np.array(rows, np.int64).reshape(-1, 4)
        else:
            orders = sessions.update(now, np.stack([executor.reached, executor.cleared]))
            released, in_step = orders.released, orders.in_step
        executor.step(released, in_step, free, delays, ())
