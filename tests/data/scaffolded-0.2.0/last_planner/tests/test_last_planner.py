"""The contract of every planner; add tests for the behaviour of this one."""

from mrpbench_core.testing import PlannerConformance

from mrpbench_planners_last_planner import LastPlanner


class TestLastPlanner(PlannerConformance):
    def make(self) -> LastPlanner:
        return LastPlanner()
