"""Begins the stream of a run with tasks that come over time."""

import numpy as np

from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.contract_checks import check_places, check_returned
from mrpbench_core.engine.own import Handed
from mrpbench_core.engine.stages.prepare import RunInstance
from mrpbench_core.model.common.arrays import Int


def start_stream(config: RunConfig, instance: RunInstance) -> TaskStream | None:
    """Begin the stream; None if the configuration has no source of tasks."""
    if config.tasks is None:
        return None
    handed = Handed((instance.world, instance.roadmap, instance.fleet), "world, roadmap or fleet")
    stream = config.tasks.start(*handed.given, config.seed)
    check_returned(config.tasks, stream, TaskStream)
    handed.check(config.tasks)
    return stream


def places_of(stream: TaskStream, instance: RunInstance) -> Int | None:
    """The vertices at which the tasks of a stream may have errands, if it says so."""
    places = check_places(stream.places)
    if places is None:
        return None
    vertices = np.unique(instance.roadmap.locate(*places)).astype(np.int64)
    return vertices[vertices >= 0]
