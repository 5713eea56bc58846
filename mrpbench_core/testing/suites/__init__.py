"""The suite of each kind."""

from mrpbench_core.api.component import Component
from mrpbench_core.plugins.kinds import kind_of
from mrpbench_core.testing.suites.assigner import AssignerConformance
from mrpbench_core.testing.suites.component import ComponentConformance
from mrpbench_core.testing.suites.controller import ControllerConformance
from mrpbench_core.testing.suites.crowd import CrowdConformance
from mrpbench_core.testing.suites.dispatcher import DispatcherConformance
from mrpbench_core.testing.suites.executor import ExecutorConformance
from mrpbench_core.testing.suites.exporter import ExporterConformance
from mrpbench_core.testing.suites.importer import ImporterConformance
from mrpbench_core.testing.suites.localizer import LocalizerConformance
from mrpbench_core.testing.suites.metric import MetricConformance
from mrpbench_core.testing.suites.navigator import NavigatorConformance
from mrpbench_core.testing.suites.plan_filter import PlanFilterConformance
from mrpbench_core.testing.suites.planner import PlannerConformance
from mrpbench_core.testing.suites.roadmap import RoadmapConformance
from mrpbench_core.testing.suites.scenario import ScenarioConformance
from mrpbench_core.testing.suites.simulator import SimulatorConformance
from mrpbench_core.testing.suites.world import WorldConformance

SUITES: dict[str, type[ComponentConformance]] = {
    "world": WorldConformance,
    "roadmap": RoadmapConformance,
    "scenario": ScenarioConformance,
    "assigner": AssignerConformance,
    "planner": PlannerConformance,
    "plan_filter": PlanFilterConformance,
    "dispatcher": DispatcherConformance,
    "navigator": NavigatorConformance,
    "controller": ControllerConformance,
    "localizer": LocalizerConformance,
    "simulator": SimulatorConformance,
    "crowd": CrowdConformance,
    "metric": MetricConformance,
    "exporter": ExporterConformance,
    "importer": ImporterConformance,
    "executor": ExecutorConformance,
}


def suite_for(component: Component) -> ComponentConformance:
    """The suite for a component; one of a kind that a plugin defines gets the checks of every component."""

    class Suite(SUITES.get(kind_of(component.group), ComponentConformance)):  # type: ignore[misc]
        def make(self) -> Component:
            return component

    return Suite()
