"""Plans and results as values."""

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.checking.plan_result import result_fault
from mrpbench_core.model.planning.plan import Paths, Plan, PlanResult, PlanStatus, RobotPath, waits
from mrpbench_core.testing.strategies import plans


def test_results_without_a_bound_are_equal():
    assert PlanResult(status=PlanStatus.TIMEOUT) == PlanResult(status=PlanStatus.TIMEOUT, lower_bound=float("nan"))
    assert PlanResult(status=PlanStatus.TIMEOUT) != PlanResult(status=PlanStatus.TIMEOUT, lower_bound=3.0)


@given(plans(), st.data())
def test_flat_paths_are_those_of_the_robots(made, data):
    problem, plan = made
    paths = tuple(plan.paths)
    assert isinstance(plan.paths, Paths)
    assert Plan(paths=list(paths)) == plan
    assert plan.paths[-1] == paths[-1]
    assert plan.paths[1:] == paths[1:]
    cut = np.array([data.draw(st.integers(0, len(path) + 1)) for path in paths])
    begin, end = plan.paths.part(np.zeros_like(cut), cut), plan.paths.part(cut, plan.paths.size)
    assert [path.edge.tolist() for path in begin] == [
        path.edge[:at].tolist() for path, at in zip(paths, cut, strict=True)
    ]
    assert begin.then(end) == plan.paths
    vertices = [path.vertices(problem.roadmap, start) for path, start in zip(paths, problem.start, strict=True)]
    assert plan.paths.vertices(problem.roadmap, problem.start).tolist() == np.concatenate(vertices).tolist()


def test_robots_wait_until_a_tick_unless_it_has_passed():
    paused = waits(np.array([3, 5, 7]), 5)
    assert [(path.edge.tolist(), path.enter.tolist(), path.leave.tolist()) for path in paused] == [
        ([-1], [3], [5]),
        ([], [], []),
        ([], [], []),
    ]


@pytest.mark.parametrize(
    "columns", [{"first": [0, 2]}, {"first": [1, 1]}, {"first": [0, 2, 1]}, {"leave": [1, 2]}, {"first": []}]
)
def test_flat_arrays_that_do_not_fit_together_are_a_fault(columns):
    sound = Paths(first=np.array([0, 1]), edge=np.array([0]), enter=np.array([0]), leave=np.array([1]))
    result = PlanResult(status=PlanStatus.SOLVED, plan=Plan(paths=sound))
    assert result_fault(result) is None
    plan = Plan(paths=attrs.evolve(sound, **{name: np.array(values, int) for name, values in columns.items()}))
    assert result_fault(attrs.evolve(result, plan=plan)) == "returned a plan whose flat arrays do not fit together"


def test_paths_that_cannot_be_joined_stay_as_they_are():
    ragged = (RobotPath(edge=np.array([0, 1]), enter=np.array([0]), leave=np.array([1])),)
    assert Plan(paths=ragged).paths is ragged
