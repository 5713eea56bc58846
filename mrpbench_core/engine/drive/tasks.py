"""Begins the stream of a run with tasks that come over time."""

import numpy as np

from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.contract_checks import check_places, check_returned
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.runs.instance import Instance


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
