"""The class of each kind."""

from mrpbench_core.api.assigner import Assigner
from mrpbench_core.api.component import Component
from mrpbench_core.api.controller import Controller
from mrpbench_core.api.crowd import Crowd
from mrpbench_core.api.dispatcher import Dispatcher
from mrpbench_core.api.executor import ExecutorSource
from mrpbench_core.api.format import Format
from mrpbench_core.api.localizer import Localizer
from mrpbench_core.api.metric import Metric
from mrpbench_core.api.navigator import Navigator
from mrpbench_core.api.planner import Planner
from mrpbench_core.api.roadmap import RoadmapBuilder
from mrpbench_core.api.scenario import ScenarioSource
from mrpbench_core.api.simulator import Simulator
from mrpbench_core.api.task_source import TaskSource
from mrpbench_core.api.world import WorldSource

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
