import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_planners_rolling_horizon.rolling_horizon import RollingHorizon
from mrpbench_tests.instances.problems import grid_of, problem_on
from mrpbench_tests.instances.roadmaps import roadmap

from mrpbench_core.checking.plan import check_plan
from mrpbench_core.engine.execution.commitments import commitments
from mrpbench_core.model.planning.plan import Budget
from mrpbench_core.model.planning.problem import Feature, features_of
from mrpbench_core.model.planning.window import leads_to_goals

pytest.importorskip("mrpbench_planners_mapf")
from mrpbench_planners_mapf.lacam import Lacam
from mrpbench_planners_mapf.pbs import Pbs
from mrpbench_planners_mapf.pibt import Pibt
from mrpbench_planners_mapf.prioritized import Prioritized

BUDGET = Budget(wall_s=5.0, memory_bytes=2**30, iterations=5)
SHAPE = grid_of([".....", ".@.@.", "....."])


@settings(max_examples=60, deadline=None)
@given(
    st.sampled_from([Pibt(), Prioritized(), Pbs(), Lacam()]),
    st.integers(0, 12),
    st.sampled_from([None, 0.3]),
    st.data(),
)
def test_robots_may_stay_where_the_plan_of_a_window_ends(planner, horizon, radius, data):
    """There, each as late as it likes, they are given other goals, and plan for another window."""
    longest = data.draw(st.sampled_from([1, 4]))
    ticks = data.draw(st.lists(st.integers(1, longest), min_size=len(SHAPE.edges), max_size=len(SHAPE.edges)))
    vertices = st.permutations(range(len(SHAPE.position)))
    starts = data.draw(vertices)[:3]
    shared = st.lists(st.sampled_from(range(len(SHAPE.position))), min_size=3, max_size=3)
    places = shared if Feature.SHARED_GOALS in planner.supports else vertices
    goals, others = (data.draw(places)[:3] for _ in range(2))
    windowed = RollingHorizon(planner=planner)
    road = roadmap(SHAPE.position, SHAPE.edges, ticks)
    problem = problem_on(road, starts, goals, radius=radius, horizon=horizon)
    problem = attrs.evolve(problem, features=problem.features | {Feature.HORIZON, Feature.EDGE_DURATIONS})
    if planner.skip(attrs.evolve(problem, features=problem.features - {Feature.HORIZON})):
        return
    plan = windowed.plan(problem, BUDGET).plan
    if plan is None:
        return
    assert check_plan(problem, plan).valid
    assert all(path.leave[-1] <= horizon for path in plan.paths if len(path))
    ends = [path.end(road, start) for path, start in zip(plan.paths, starts, strict=True)]
    assert leads_to_goals(problem, plan).tolist() == [end == goal for end, goal in zip(ends, goals, strict=True)]
    late = np.array(data.draw(st.lists(st.integers(0, 3), min_size=3, max_size=3)), np.int64)
    released = np.array([len(path) for path in plan.paths], np.int32)
    prefix = commitments(problem, plan, released, released, late, due=horizon)
    end = max((int(path.leave[-1]) for path in prefix if len(path)), default=0)
    new = attrs.evolve(
        problem,
        commitments=prefix,
        goals=tuple(((goal,),) for goal in others),
        horizon=end + horizon,
        features=problem.features | {Feature.COMMITMENTS},
    )
    found = windowed.plan(new, BUDGET).plan
    assert found is None or check_plan(new, found).valid


@pytest.mark.parametrize("planner", [Pibt(), Prioritized(), Pbs()])
def test_of_robots_with_the_same_goal_one_comes_there_within_a_window_and_another_beside_it(planner):
    line = grid_of(["." * 7])
    problem = problem_on(line, [0, 1, 6], [4, 4, 4], horizon=20)
    assert Feature.SHARED_GOALS in features_of(problem)
    plan = RollingHorizon(planner=planner).plan(problem, BUDGET).plan
    assert check_plan(problem, plan).valid
    ends = {path.end(line, start) for path, start in zip(plan.paths, [0, 1, 6], strict=True)}
    assert 4 in ends
    assert ends & {3, 5}


@pytest.mark.parametrize("planner", [Prioritized(), Pbs(), Lacam()])
def test_a_window_that_is_long_enough_leads_to_the_goals(planner):
    problem = problem_on(SHAPE, [0, 4], [4, 0], horizon=100)
    plan = RollingHorizon(planner=planner).plan(problem, BUDGET).plan
    assert leads_to_goals(problem, plan).all()


@pytest.mark.parametrize("planner", [Prioritized(), Pbs()])
def test_conflicts_after_the_window_are_not_resolved(planner):
    """In a corridor nobody can pass; within the window, robots approach one another."""
    corridor = grid_of(["." * 9])
    problem = problem_on(corridor, [0, 8], [7, 1])
    assert RollingHorizon(planner=planner).plan(problem, BUDGET).plan is None
    plan = RollingHorizon(planner=planner).plan(attrs.evolve(problem, horizon=3), BUDGET).plan
    assert [path.end(corridor, start) for path, start in zip(plan.paths, [0, 8], strict=True)] == [3, 5]
