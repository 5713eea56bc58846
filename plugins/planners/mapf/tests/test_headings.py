"""Planners on roadmaps with headings: valid plans, and optimal ones as brute force finds them."""

import attrs
import numpy as np
import pytest
from mrpbench_planners_mapf.bounded import Ecbs, Eecbs
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_planners_mapf.lacam import Lacam
from mrpbench_planners_mapf.pbs import Pbs
from mrpbench_planners_mapf.pibt import Pibt
from mrpbench_planners_mapf.prioritized import Prioritized
from mrpbench_tests.oracles.optimum import least_sum_of_costs

from mrpbench_core.builtin.roadmaps.headings import with_headings
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.planning.plan import Budget, PlanStatus
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.testing.drawing import problem

BUDGET = Budget(wall_s=20, memory_bytes=2**30, iterations=100)
SLOW = RobotModel(name="slow", footprint=[[0.1, 0], [-0.1, 0.1], [-0.1, -0.1]], max_speed=0.5, max_turn_rate=3.0)
FAST = attrs.evolve(SLOW, name="fast", max_speed=1.0)
CROSSING = """
    .  a  .
    b  .  B
    .  A  .
"""


def headed(drawing, models=(SLOW,), tick=1.0):
    """The problem of a drawing with headings; robots use the models in turn and start with yaw 0."""
    drawn = problem(drawing)
    steps = [round(1 / model.max_speed / tick) for model in models]
    duration = np.repeat(np.array(steps)[:, None], len(drawn.roadmap.edges), axis=1)
    roadmap = with_headings(attrs.evolve(drawn.roadmap, tick=tick, duration=duration), models)
    return problem(
        drawing,
        roadmap=roadmap,
        start=roadmap.facing(drawn.start, np.zeros(len(drawn))),
        profile=np.arange(len(drawn)) % len(models),
        features={Feature.FOOTPRINTS},
    )


@pytest.mark.parametrize("planner", [Prioritized(), Pbs(), Cbs(), Ecbs(), Eecbs(), Lacam(), Pibt()])
def test_robots_of_different_speeds_cross_with_turns(planner):
    asked = headed(CROSSING, (SLOW, FAST), tick=0.25)
    assert {Feature.HEADINGS, Feature.PROFILES, Feature.EDGE_DURATIONS} <= asked.features
    assert planner.skip(asked) is None
    result = planner.plan(asked, BUDGET)
    assert result.status is PlanStatus.SOLVED
    assert check_plan(asked, result.plan).valid


@pytest.mark.parametrize("drawing", ["a . bB\n . A .", "a b\n B A", "a . b\n B . A"])
def test_cbs_finds_the_optimum_of_brute_force(drawing):
    asked = headed(drawing)
    result = Cbs().plan(asked, BUDGET)
    assert result.status is PlanStatus.SOLVED
    assert check_plan(asked, result.plan).valid
    assert result.plan.sum_of_costs == least_sum_of_costs(asked, most_states=200_000)
