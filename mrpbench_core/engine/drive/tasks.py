"""Begins the stream of a run with tasks that come over time, and what has them assigned and done."""

import numpy as np

from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.contract_checks import check_places, check_returned
from mrpbench_core.engine.execution.destinations import Places
from mrpbench_core.engine.execution.queue_costs import QueueCosts
from mrpbench_core.engine.execution.recorder import Recorder
from mrpbench_core.engine.execution.task_manager import TaskManager
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.model.runs.instance import Instance
from mrpbench_core.model.runs.run import RunContext


def start_stream(config: RunConfig, instance: Instance) -> TaskStream | None:
    """Begin the stream; None if the configuration has no source of tasks."""
    if config.tasks is None:
        return None
    stream = config.tasks.start(instance.world, instance.roadmap, instance.fleet, config.seed)
    return check_returned(config.tasks, stream, TaskStream)


def places_of(stream: TaskStream, instance: Instance) -> Int | None:
    """The vertices at which the tasks of a stream may have errands, if it says so."""
    places = check_places(stream.places)
    if places is None:
        return None
    vertices = np.unique(instance.roadmap.locate(*places)).astype(np.int64)
    return vertices[vertices >= 0]


def tasks_of(config: RunConfig, context: RunContext, stream: TaskStream, recorder: Recorder) -> TaskManager:
    """The tasks of an execution."""
    costs = QueueCosts(config.assigner.cost, context.problem.roadmap, context.fleet)
    supports, windowed = config.planner.supports, config.replanning.window is not None
    sets, shared = Feature.GOAL_SETS in supports, windowed and Feature.SHARED_GOALS in supports
    rest, parking = not config.planner.chooses_goals, config.replanning.parking
    places = Places(context.problem, costs.labels, parking, sets, shared, rest)
    sequences = Feature.GOAL_SEQUENCES in supports
    return TaskManager(
        stream, config.assigner, costs, places, context.problem, recorder, config.replanning.interval, sequences
    )
