"""Periodic messages of a topic: a template and the channels that fill it."""

import math
from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache
from itertools import pairwise
from typing import Any, Protocol

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_exporters_rosbag2.messages import Topic, nanoseconds
from mrpbench_exporters_rosbag2.template import Template, hole

Rows = tuple[Float, Mapping[str, NDArray[Any]]]
"""Times f8[k] in simulated seconds and the values of each hole at them."""

POSE, TWIST, COVARIANCE = hole(7), hole(6), hole(36)
"""Holes of templates for poses (see `messages.spatial`), twists and covariances."""


class Throttle:
    """Chooses samples that are an interval apart, at least."""

    def __init__(self, interval: float) -> None:
        """`interval` in seconds."""
        self._interval = interval
        self._next = -math.inf

    def due(self, times: Float) -> list[int]:
        """Return the indices of those of `times` f8[k], the next of a run, that are chosen."""
        chosen = []
        for index, now in enumerate(times.tolist()):
            if now >= self._next:
                chosen.append(index)
                self._next = now + self._interval - 1e-9
        return chosen


class Templates(Protocol):
    """Makes messages like a template, where strings vary."""

    def fill(self, stamps: Int, **values: NDArray[Any]) -> list[bytes]:
        """One message for each of `stamps`."""


class Varying:
    """Makes a template for every state of what is more than numbers in a message, such as names of levels."""

    def __init__(self, state: str, template: Callable[[tuple[Any, ...]], Templates]) -> None:
        """`state` names the rows [k,n] of the states that `template` gets."""
        self._state = state
        self._of = lru_cache(4)(template)

    def fill(self, stamps: Int, **values: NDArray[Any]) -> list[bytes]:
        """One message for each of `stamps`."""
        state = values.pop(self._state)
        changes = np.flatnonzero((state[1:] != state[:-1]).any(axis=1)) + 1
        messages = []
        for begin, end in pairwise([0, *changes.tolist(), len(stamps)]):
            part = {name: rows[begin:end] for name, rows in values.items()}
            messages += self._of(tuple(state[begin].tolist())).fill(stamps[begin:end], **part)
        return messages


@attrs.frozen
class TopicSource:
    """Makes the messages of one topic."""

    topic: Topic
    template: Template | Templates
    rows: Callable[[Chunk], Rows | None]
    """None where a block lacks the channels."""

    def messages(self, block: Chunk, start: int) -> Iterator[tuple[int, bytes]]:
        """Stamp (nanoseconds) and bytes of each message of a block, in order of time."""
        rows = self.rows(block)
        if rows is None or not len(rows[0]):
            return
        stamps = nanoseconds(rows[0]) + start
        yield from zip(stamps.tolist(), self.template.fill(stamps, **rows[1]), strict=True)
