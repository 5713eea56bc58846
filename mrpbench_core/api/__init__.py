"""The contracts for plugin authors: one short file per kind of component."""

from mrpbench_core.api.assigner import Assigner, AssignmentError
from mrpbench_core.api.component import Component, between, option
from mrpbench_core.api.controller import Controller, ControllerSession, FleetControllerSession, FleetOfOne
from mrpbench_core.api.crowd import Crowd, CrowdSession, CrowdView, Mover, Movers
from mrpbench_core.api.discrete import DiscreteResult, DiscreteRun, DiscreteSimulator
from mrpbench_core.api.dispatcher import Dispatcher, DispatchError, DispatcherSession, RepeatedSession
from mrpbench_core.api.executor import ExecutorSource
from mrpbench_core.api.exporter import Exporter, ExporterSession
from mrpbench_core.api.format import Format, FormatWriter, Observed, ReadableFormat, Signal, Track, WritableFormat
from mrpbench_core.api.hooks import hookimpl
from mrpbench_core.api.importer import Importer
from mrpbench_core.api.localizer import Localizer, LocalizerSession
from mrpbench_core.api.metric import Column, Metric, Value
from mrpbench_core.api.navigator import Navigator, NavigatorSession
from mrpbench_core.api.planner import Planner, PlannerSession, Promise
from mrpbench_core.api.recovery import Recovery, RecoverySession, Surroundings
from mrpbench_core.api.roadmap import RoadmapBuilder
from mrpbench_core.api.scenario import ScenarioSource
from mrpbench_core.api.simulator import Simulation, Simulator
from mrpbench_core.api.task_source import TaskSource, TaskStream
from mrpbench_core.api.world import WorldSource
from mrpbench_core.model.execution.evaluation import Evaluation

KINDS: dict[str, type[Component]] = {
    "world": WorldSource,
    "roadmap": RoadmapBuilder,
    "scenario": ScenarioSource,
    "task_source": TaskSource,
    "assigner": Assigner,
    "planner": Planner,
    "dispatcher": Dispatcher,
    "navigator": Navigator,
    "controller": Controller,
    "localizer": Localizer,
    "simulator": Simulator,
    "crowd": Crowd,
    "metric": Metric,
    "format": Format,
    "executor": ExecutorSource,
}
"""The class of each kind, by the word for the kind; `group` of the class is its entry-point group."""

__all__ = [
    "KINDS",
    "Assigner",
    "AssignmentError",
    "Column",
    "Component",
    "Controller",
    "ControllerSession",
    "Crowd",
    "CrowdSession",
    "CrowdView",
    "DiscreteResult",
    "DiscreteRun",
    "DiscreteSimulator",
    "DispatchError",
    "Dispatcher",
    "DispatcherSession",
    "Evaluation",
    "ExecutorSource",
    "Exporter",
    "ExporterSession",
    "FleetControllerSession",
    "FleetOfOne",
    "Format",
    "FormatWriter",
    "Importer",
    "Localizer",
    "LocalizerSession",
    "Metric",
    "Mover",
    "Movers",
    "Navigator",
    "NavigatorSession",
    "Observed",
    "Planner",
    "PlannerSession",
    "Promise",
    "ReadableFormat",
    "Recovery",
    "RecoverySession",
    "RepeatedSession",
    "RoadmapBuilder",
    "ScenarioSource",
    "Signal",
    "Simulation",
    "Simulator",
    "Surroundings",
    "TaskSource",
    "TaskStream",
    "Track",
    "Value",
    "WorldSource",
    "WritableFormat",
    "between",
    "hookimpl",
    "option",
]
