"""Plan filter last_plan_filter for mrpbench."""

from mrpbench_plan_filters_last_plan_filter.last_plan_filter import LastPlanFilter

__all__ = ["LastPlanFilter"]
