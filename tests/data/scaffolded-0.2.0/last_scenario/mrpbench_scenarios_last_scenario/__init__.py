"""Scenario last_scenario for mrpbench."""

from mrpbench_scenarios_last_scenario.last_scenario import LastScenario

__all__ = ["LastScenario"]
