"""The task source `vda5050`: transports that a host publishes on the broker, such as `mrpbench load`."""

import sys
import time
import uuid
from collections.abc import Sequence
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Fleet, Roadmap, Task, TaskSource, TaskStream, World, option
from mrpbench_live.fleet.site import level_names
from mrpbench_live.vda5050.transports import TRANSPORTS, read_errands
from mrpbench_live.vda5050.wire import Broker, Client, Wire

CONNECTING_S = 10.0


@attrs.frozen(kw_only=True)
class Vda5050Transports(TaskSource):
    """Tasks that come over a broker of MQTT, on the topic `mrpbench/transports`."""

    live: ClassVar[bool] = True

    url: str = option(
        "mqtt://127.0.0.1:1883", help="the broker; a user before the host, its password in the environment"
    )

    def start(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> TaskStream:
        """Listen.

        Raises:
            InputError: there is no broker, or a library is missing.
        """
        del roadmap, fleet, seed
        return _Heard(self.url, {name: index for index, name in enumerate(level_names(world))})


class _Heard(TaskStream):
    def __init__(self, url: str, level_of: dict[str, int]) -> None:
        self._level_of, self._count = level_of, 0
        self._waiting: list[bytes] = []
        self._wire = Wire(Broker.of(url))
        name = f"mrpbench-transports-{uuid.uuid4().hex[:8]}"
        client = Client(self._wire, name, None, (TRANSPORTS,), lambda: None, self._take)
        self._wire.add(client)
        self._wire.meet(CONNECTING_S)

    def _take(self, topic: str, payload: bytes) -> None:
        del topic
        self._waiting.append(payload)

    def released(self, now: float, finished: int) -> Sequence[Task]:  # noqa: ARG002 - they come whatever is done
        """Return what has come."""
        self._wire.serve(time.monotonic())
        found = []
        for payload in self._waiting:
            try:
                found.append(self._task(payload, now))
            except (ValueError, KeyError, TypeError) as error:
                sys.stderr.write(f"at {now:.1f} s: a transport cannot be read: {error!r:.200}\n")
        self._waiting.clear()
        return found

    def _task(self, payload: bytes, now: float) -> Task:
        name, errands = read_errands(payload, self._level_of)
        places = [(number, place) for number, (some, _) in enumerate(errands) for place in some]
        self._count += 1
        return Task(
            goals=np.array([(x, y, np.nan) for _, (x, y, _) in places]),
            errand=np.array([number for number, _ in places], np.int32),
            levels=np.array([level for _, (*_, level) in places], np.int16),
            name=name,
            release=now,
            service=np.array([seconds for _, seconds in errands]),
            index=self._count - 1,
        )
