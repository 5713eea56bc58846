"""The suite of each kind."""

import importlib

from mrpbench_core.api.component import Component
from mrpbench_core.files.errors import InputError, one_line
from mrpbench_core.plugins.kinds import kind_of
from mrpbench_core.testing.suites.assigner import AssignerConformance
from mrpbench_core.testing.suites.component import ComponentConformance
from mrpbench_core.testing.suites.controller import ControllerConformance
from mrpbench_core.testing.suites.crowd import CrowdConformance
from mrpbench_core.testing.suites.dispatcher import DispatcherConformance
from mrpbench_core.testing.suites.executor import ExecutorConformance
from mrpbench_core.testing.suites.format import FormatConformance
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

SUITES: dict[str, type[ComponentConformance]] = {
    "world": WorldConformance,
    "roadmap": RoadmapConformance,
    "scenario": ScenarioConformance,
    "task_source": TaskSourceConformance,
    "assigner": AssignerConformance,
    "planner": PlannerConformance,
    "dispatcher": DispatcherConformance,
    "navigator": NavigatorConformance,
    "controller": ControllerConformance,
    "localizer": LocalizerConformance,
    "simulator": SimulatorConformance,
    "crowd": CrowdConformance,
    "metric": MetricConformance,
    "format": FormatConformance,
    "executor": ExecutorConformance,
    "recovery": RecoveryConformance,
    "predictor": PredictorConformance,
}


def suite_for(component: Component) -> ComponentConformance:
    """The suite for a component; see `Component.suite` for kinds that plugins define.

    Raises:
        InputError: the suite that a kind names cannot be imported.
    """

    class Suite(suite_class(component)):  # type: ignore[misc]
        def make(self) -> Component:
            return component

    return Suite()


def suite_class(component: Component) -> type[ComponentConformance]:
    """The class of the suite for a component; that of all components if its kind has none."""
    kind, named = kind_of(component.group), type(component).suite
    if named is None:
        return SUITES.get(kind, ComponentConformance)
    module, _, name = named.partition(":")
    try:
        value = getattr(importlib.import_module(module), name)
    except (Exception, SystemExit) as error:
        raise InputError(f"the suite {named} of the kind {kind} cannot be imported: {one_line(error)}") from error
    if not isinstance(value, type) or not issubclass(value, ComponentConformance):
        raise InputError(f"the suite {named} of the kind {kind} does not derive from ComponentConformance")
    return value
