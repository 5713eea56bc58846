"""Conformance kit for plugin authors: what every plugin of a kind must keep, as one suite for each kind.

In pytest, subclass the suite and return your component from `make`:

    from mrpbench_core.testing import PlannerConformance

    class TestMine(PlannerConformance):
        def make(self):
            return Mine()

`mrpbench check NAME` runs the same checks and needs no pytest. Hypothesis strategies for tests of your own are in
`mrpbench_core.testing.strategies`, problems drawn as text in `mrpbench_core.testing.drawing`.
"""

from mrpbench_core.testing.assigner import AssignerConformance
from mrpbench_core.testing.checks import Check, run_checks
from mrpbench_core.testing.component import ComponentConformance
from mrpbench_core.testing.controller import ControllerConformance
from mrpbench_core.testing.crowd import CrowdConformance
from mrpbench_core.testing.dispatcher import DispatcherConformance
from mrpbench_core.testing.executor import ExecutorConformance
from mrpbench_core.testing.exporter import ExporterConformance
from mrpbench_core.testing.importer import ImporterConformance
from mrpbench_core.testing.localizer import LocalizerConformance
from mrpbench_core.testing.metric import MetricConformance
from mrpbench_core.testing.navigator import NavigatorConformance
from mrpbench_core.testing.outcome import Fault, Skip, require
from mrpbench_core.testing.plan_filter import PlanFilterConformance
from mrpbench_core.testing.planner import PlannerConformance
from mrpbench_core.testing.roadmap import RoadmapConformance
from mrpbench_core.testing.scenario import ScenarioConformance
from mrpbench_core.testing.simulator import SimulatorConformance
from mrpbench_core.testing.suites import SUITES, suite_for
from mrpbench_core.testing.world import WorldConformance

__all__ = [
    "SUITES",
    "AssignerConformance",
    "Check",
    "ComponentConformance",
    "ControllerConformance",
    "CrowdConformance",
    "DispatcherConformance",
    "ExecutorConformance",
    "ExporterConformance",
    "Fault",
    "ImporterConformance",
    "LocalizerConformance",
    "MetricConformance",
    "NavigatorConformance",
    "PlanFilterConformance",
    "PlannerConformance",
    "RoadmapConformance",
    "ScenarioConformance",
    "SimulatorConformance",
    "Skip",
    "WorldConformance",
    "require",
    "run_checks",
    "suite_for",
]
