"""Invalid results of planners are found."""

import numpy as np
import pytest

from mrpbench_core.checking.plan_result import result_fault
from mrpbench_core.model.planning.plan import AnytimePoint, Plan, PlanResult, PlanStatus, RobotPath

EMPTY = RobotPath(edge=[], enter=[], leave=[])
FLAT = RobotPath(edge=np.zeros((1, 1)), enter=np.zeros((1, 1)), leave=np.ones((1, 1)))


def solved(**values):
    return PlanResult(**{"status": PlanStatus.SOLVED, "plan": Plan(paths=(EMPTY,)), **values})


@pytest.mark.parametrize(
    ("returned", "said"),
    [
        (None, "None instead of a PlanResult"),
        ({"status": "solved"}, "type dict instead of a PlanResult"),
        (PlanResult, "the class PlanResult instead of a PlanResult"),
        (solved(status="done"), "status 'done'"),
        (solved(status=PlanStatus.UNKNOWN), "status 'unknown'"),
        (solved(status=[]), "status '[]'"),
        (solved(plan=[EMPTY]), "type list instead of a Plan"),
        (solved(plan=Plan(paths=None)), "None instead of a tuple of paths"),
        (solved(plan=Plan(paths=(EMPTY, None))), "robot 1: None instead of a RobotPath"),
        (solved(plan=Plan(paths=(FLAT,))), "robot 0: edge, enter and leave are not all one-dimensional"),
        (solved(lower_bound="low"), "type str as lower bound"),
        (solved(statistics=[1]), "type list instead of a mapping"),
        (solved(statistics={"nodes": None}), "the statistic nodes, None, which is not"),
        (solved(statistics={5: 1.0}), "the statistic 5, a value of type float, which is not"),
        (solved(statistics={"nodes": 2**63}), "the statistic nodes, a value of type int, which is not"),
        (solved(clock_bound=np.zeros(2)), "type ndarray instead of whether the clock decided"),
        (solved(history=[(0.1, 3.0)]), "a history that is not a tuple of AnytimePoint"),
        (solved(status=PlanStatus.UNSOLVABLE), "a plan with the status unsolvable"),
    ],
)
def test_the_first_thing_of_a_wrong_type_is_named(returned, said):
    fault = result_fault(returned)
    assert fault is not None
    assert said in fault


@pytest.mark.parametrize(
    "returned",
    [
        solved(),
        solved(plan=None),
        solved(statistics={"nodes": np.int64(3), "bound": np.inf}, clock_bound=np.bool_(False)),
        solved(history=(AnytimePoint(seconds=0.1, cost=3.0),)),
        solved(status=PlanStatus.TIMEOUT),
        PlanResult(status=PlanStatus.GAVE_UP, lower_bound=np.float64(np.inf)),
    ],
)
def test_a_result_is_a_result(returned):
    assert result_fault(returned) is None
