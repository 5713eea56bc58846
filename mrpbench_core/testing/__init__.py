"""Conformance kit for plugin authors: for each kind of plugin, a suite of checks that every plugin must pass.

In pytest, subclass the suite and return your component from `make`:

    from mrpbench_core.testing import PlannerConformance

    class TestMine(PlannerConformance):
        def make(self):
            return Mine()

`mrpbench check NAME` runs the same checks without pytest. For tests of your own:

- `strategies`: Hypothesis strategies for roadmaps, problems, plans, fleets and scenarios;
- `drawing`: problems drawn as text.

The other folders are what the suites are made of.
"""

from mrpbench_core.testing.checks import Check, failed_checks, run_check, run_checks
from mrpbench_core.testing.faults import Fault, Skip, require
from mrpbench_core.testing.suites import SUITES, suite_for
from mrpbench_core.testing.suites.assigner import AssignerConformance
from mrpbench_core.testing.suites.component import ComponentConformance
from mrpbench_core.testing.suites.controller import ControllerConformance
from mrpbench_core.testing.suites.crowd import CrowdConformance
from mrpbench_core.testing.suites.discrete import DiscreteSimulatorConformance
from mrpbench_core.testing.suites.dispatcher import DispatcherConformance
from mrpbench_core.testing.suites.executor import ExecutorConformance
from mrpbench_core.testing.suites.format import FormatConformance
from mrpbench_core.testing.suites.hook import HookConformance
from mrpbench_core.testing.suites.localizer import LocalizerConformance
from mrpbench_core.testing.suites.metric import MetricConformance
from mrpbench_core.testing.suites.navigator import NavigatorConformance
from mrpbench_core.testing.suites.planner import PlannerConformance
from mrpbench_core.testing.suites.predictor import PredictorConformance
from mrpbench_core.testing.suites.recovery import RecoveryConformance
from mrpbench_core.testing.suites.roadmap import RoadmapConformance
from mrpbench_core.testing.suites.scenario import ScenarioConformance
from mrpbench_core.testing.suites.simulator import SimulatorConformance
from mrpbench_core.testing.suites.task_source import TaskSourceConformance
from mrpbench_core.testing.suites.world import WorldConformance

ExporterConformance = ImporterConformance = FormatConformance
"""The names of release 0.2, until the next release."""

__all__ = [
    "SUITES",
    "AssignerConformance",
    "Check",
    "ComponentConformance",
    "ControllerConformance",
    "CrowdConformance",
    "DiscreteSimulatorConformance",
    "DispatcherConformance",
    "ExecutorConformance",
    "ExporterConformance",
    "Fault",
    "FormatConformance",
    "HookConformance",
    "ImporterConformance",
    "LocalizerConformance",
    "MetricConformance",
    "NavigatorConformance",
    "PlannerConformance",
    "PredictorConformance",
    "RecoveryConformance",
    "RoadmapConformance",
    "ScenarioConformance",
    "SimulatorConformance",
    "Skip",
    "TaskSourceConformance",
    "WorldConformance",
    "failed_checks",
    "require",
    "run_check",
    "run_checks",
    "suite_for",
]
