import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_planners_rolling_horizon.rolling_horizon import RollingHorizon, from_rest
from mrpbench_tests.instances.problems import grid_of, problem_on

from mrpbench_core.checking.plan import check_plan
from mrpbench_core.engine.execution.commitments import commitments, remaining
from mrpbench_core.model.planning.plan import Budget, Plan
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.testing import PlannerConformance

mapf = pytest.importorskip("mrpbench_planners_mapf.lacam")
BUDGET = Budget(wall_s=5.0, memory_bytes=2**30, iterations=10)


class TestRollingHorizon(PlannerConformance):
    def make(self):
        return RollingHorizon(planner=pytest.importorskip("mrpbench_planners_mapf.pibt").Pibt())


def test_a_planner_without_commitments_gets_them():
    assert Feature.COMMITMENTS not in mapf.Lacam().supports
    assert Feature.COMMITMENTS in RollingHorizon(planner=mapf.Lacam()).supports


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 4), st.data())
def test_new_plans_begin_with_what_was_released_and_have_no_conflicts(cut, data):
    """A plan is cut after `cut` segments of each robot, which are late; then robots get other goals."""
    planner = RollingHorizon(planner=mapf.Lacam())
    roadmap = grid_of([".....", ".@.@.", "....."])
    vertices = st.permutations(range(len(roadmap.position)))
    starts, goals, others = (data.draw(vertices)[:4] for _ in range(3))
    problem = problem_on(roadmap, starts, goals)
    plan = planner.plan(problem, BUDGET).plan
    released = np.array([int(np.searchsorted(path.leave, cut, side="right")) for path in plan.paths], np.int32)
    late = np.array(data.draw(st.lists(st.integers(0, 3), min_size=4, max_size=4)), np.int64)
    prefix = commitments(problem, plan, released, released, late, due=cut)
    new = attrs.evolve(
        problem,
        commitments=prefix,
        goals=tuple(((goal,),) for goal in others),
        features=problem.features | {Feature.COMMITMENTS},
    )
    found = planner.plan(new, BUDGET)
    assert found.plan is not None
    assert not check_plan(new, found.plan).faults
    assert not check_plan(new, found.plan).conflicts

    rest = remaining(plan, released, attrs.evolve(problem, commitments=prefix))
    goes_on = attrs.evolve(new, goals=problem.goals, remaining=rest)
    for asked, paths in ((goes_on, prefix.then(rest)), (given := from_rest(goes_on), given.remaining)):
        report = check_plan(asked, Plan(paths=paths))
        assert not report.faults
        assert not report.conflicts
