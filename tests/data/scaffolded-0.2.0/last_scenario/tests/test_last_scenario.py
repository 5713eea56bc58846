"""The contract of every scenario; add tests for the behaviour of this one."""

from mrpbench_core.testing import ScenarioConformance

from mrpbench_scenarios_last_scenario import LastScenario


class TestLastScenario(ScenarioConformance):
    def make(self) -> LastScenario:
        return LastScenario(robots=3)
