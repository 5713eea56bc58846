"""Further draws are those of their numbers, however many go on at once, and also with faults."""

import numpy as np
import pytest
from mrpbench_tests.instances.random_plans import random_plan

from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.config.delays import Delays
from mrpbench_core.config.faults import Faults
from mrpbench_core.engine.execution import draws as module
from mrpbench_core.engine.execution.draws import DelayDraws
from mrpbench_core.engine.execution.faults import FaultEvent, FaultState
from mrpbench_core.engine.execution.schedule import Schedule
from mrpbench_core.engine.execution.schedule_loop import ScheduleLoop
from mrpbench_core.engine.execution.worst_case import Adversary
from mrpbench_core.engine.seeds import Seeds

SLOW = FaultEvent(kind="slow", begin=1.0, end=9.0, robot=0, speed=0.5)


@pytest.mark.parametrize("at_once", [1, 2, 3, 100])
@pytest.mark.parametrize("events", [(), (SLOW,)])
def test_draws_are_those_of_their_numbers(context_of, monkeypatch, at_once, events):
    delays = Delays(p_delay=0.1, max_delay=8, speed=0.2, worst_case=5, draws=8)
    problem, plan = random_plan(np.random.default_rng(3))
    robots = len(problem)
    monkeypatch.setattr(module, "_AT_ONCE", at_once * robots)
    schedule = Schedule(context_of(problem, plan), Adg(group_margin=0.0))
    drawn = DelayDraws(delays, robots, Seeds(5, 1), Adversary(problem, plan, 5.0))
    found = [np.concatenate(rows) for rows in zip(*drawn.execute(schedule, faults(events, robots), 999.0), strict=True)]
    for draw in range(1, 8):
        loop = ScheduleLoop(schedule, drawn.stream(draw), 999.0, faults=faults(events, robots))
        assert loop.run().succeeded
        np.testing.assert_array_equal(found[0][draw - 1], loop.arrival[0])
        np.testing.assert_array_equal(found[1][draw - 1], loop.waiting[0])
    assert len(np.unique(found[0], axis=0)) > 1


def faults(events, robots):
    return FaultState(Faults(), events, robots)
