"""Executions of one plan do not disturb one another, whether or not they share what their dispatcher has computed."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mrpbench_tests.instances.random_plans import random_plan, random_plan_with_resources

from mrpbench_core.api import DispatchError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.builtin.dispatchers.timed import Timed
from mrpbench_core.config.delays import Delays
from mrpbench_core.engine.execution.delays import DelayStream
from mrpbench_core.engine.execution.schedule import Schedule
from mrpbench_core.engine.execution.schedule_loop import ScheduleLoop
from mrpbench_core.engine.seeds import Seeds

LATE = Delays(p_delay=0.05, max_delay=8, speed=0.2)


def dispatchers():
    """Dispatchers whose sessions can be copied, and one whose sessions cannot."""
    reordering = pytest.importorskip("mrpbench_dispatchers_reordering")
    return [Adg(), Adg(speed_profiles=True), reordering.Btpg(), reordering.Gses(lookahead=1), Timed()]


@settings(deadline=None, max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.integers(0, 2**32 - 1), st.booleans())
def test_every_execution_is_as_if_it_were_the_only_one(context_of, seed, resources):
    problem, plan = (random_plan_with_resources if resources else random_plan)(np.random.default_rng(seed))
    context = context_of(problem, plan)
    for dispatcher in dispatchers():
        try:
            shared = Schedule(context, dispatcher)
        except DispatchError:
            continue
        for draw in range(3):
            loops = []
            for schedule in (shared, Schedule(context, dispatcher)):
                loops.append(ScheduleLoop(schedule, DelayStream(LATE, len(problem), Seeds(seed), (draw,)), 3000.0))
                assert loops[-1].run().succeeded
            np.testing.assert_array_equal(loops[0].arrival, loops[1].arrival)
            np.testing.assert_array_equal(loops[0].waiting, loops[1].waiting)
