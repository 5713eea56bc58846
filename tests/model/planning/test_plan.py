"""Plans and results as values."""

from mrpbench_core.model.planning.plan import PlanResult, PlanStatus


def test_results_without_a_bound_are_equal():
    assert PlanResult(status=PlanStatus.TIMEOUT) == PlanResult(status=PlanStatus.TIMEOUT, lower_bound=float("nan"))
    assert PlanResult(status=PlanStatus.TIMEOUT) != PlanResult(status=PlanStatus.TIMEOUT, lower_bound=3.0)
