"""Fixtures of executions."""

import attrs
import numpy as np
import pytest

from mrpbench_core.model.runs.routing import Router


@pytest.fixture
def context_of(run_context):
    """Make the context of a plan."""

    def make(problem, plan):
        robots = len(problem)
        router = Router(problem, np.full(robots, np.nan), np.full(len(problem.roadmap.edges), np.inf))
        start = np.column_stack([problem.roadmap.position[problem.start], np.zeros(robots)])
        scenario = attrs.evolve(run_context.scenario, start=start, start_level=np.zeros(robots))
        result = attrs.evolve(run_context.result, plan=plan)
        changes = {"problem": problem, "result": result, "scenario": scenario, "period": 0.25}
        return attrs.evolve(run_context, routes=router(plan), **changes)

    return make
