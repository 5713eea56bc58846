"""The contract of every plan filter; add tests for the behaviour of this one."""

from mrpbench_core.testing import PlanFilterConformance

from mrpbench_plan_filters_last_plan_filter import LastPlanFilter


class TestLastPlanFilter(PlanFilterConformance):
    def make(self) -> LastPlanFilter:
        return LastPlanFilter()
