"""The metric `planning` on plans costed by hand."""

import math

import attrs
import numpy as np
import pytest
from mrpbench_metrics_standard import Planning

from mrpbench_core.model.planning.plan import PlanStatus, RobotPath

TO_THE_END = RobotPath(edge=[0, -1, 1], enter=[0, 2, 3], leave=[2, 3, 5])  # 0 -> 1, wait, 1 -> 2
AND_BACK = RobotPath(edge=[4, -1], enter=[0, 3], leave=[3, 20])  # 0 -> 3, then waits at its goal
AT_HOME = RobotPath(edge=[], enter=[], leave=[])


def test_costs_are_arrival_times(planned):
    values = Planning().measure(planned([TO_THE_END, AND_BACK, AT_HOME], [0, 0, 1]))
    assert values["solved"] is True
    assert (values["sum_of_costs_ticks"], values["makespan_ticks"]) == (5 + 3 + 0, 5)
    assert (values["sum_of_costs"], values["makespan"]) == (4.0, 2.5)
    assert values["moves"] == 3
    assert values["distance_m"] == pytest.approx(3 + 3 + 4)


def test_the_originals_costs_count_states(planned):
    values = Planning().measure(planned([TO_THE_END, AND_BACK, AT_HOME], [0, 0, 1]))
    assert (values["mrp_bench.cost"], values["mrp_bench.makespan"]) == (6 + 4 + 1, 6)


def test_counts_of_planner_and_validator_are_passed_on(planned):
    counted = {"expansions": 12.0, "generated": 40, "conflicts": 0.0}
    values = Planning().measure(planned([TO_THE_END], [0], lower_bound=4.0, statistics=counted))
    assert (values["expansions"], values["generated"], values["conflicts"]) == (12, 40, 0)
    assert values["low_level_expansions"] is None
    assert (values["lower_bound_ticks"], values["suboptimality"]) == (4, 1.25)


@pytest.mark.parametrize(
    ("bound", "path", "expected"),
    [
        (math.nan, TO_THE_END, None),
        (0.0, TO_THE_END, None),
        (0.0, AT_HOME, 1.0),
        (5.0, TO_THE_END, 1.0),
        (0.5, TO_THE_END, 10.0),
    ],
)
def test_suboptimality_is_never_nan_or_infinite(planned, bound, path, expected):
    assert Planning().measure(planned([path], [0], lower_bound=bound))["suboptimality"] == expected


def test_without_a_plan_only_solved_is_known(planned):
    values = Planning().measure(planned(None, [0, 1], status=PlanStatus.TIMEOUT, statistics={"expansions": 5.0}))
    assert values.pop("solved") is False
    assert set(values.values()) == {None}


def test_the_plan_before_tasks_come_has_no_costs(planned):
    run = attrs.evolve(planned([AT_HOME], [0], lower_bound=0.0), channels={"task_event": lambda: np.zeros(0, "U9")})
    values = Planning().measure(run)
    assert (values["solved"], values["lower_bound_ticks"]) == (True, 0)
    assert values["makespan"] is values["sum_of_costs"] is values["moves"] is values["suboptimality"] is None


def test_every_column_is_measured_and_no_other(planned):
    names = {column.name for column in Planning.columns}
    assert set(Planning().measure(planned([AT_HOME], [0]))) == names
    assert set(Planning().measure(planned(None, [0], status=PlanStatus.GAVE_UP))) == names
    assert len(names) == len(Planning.columns)
