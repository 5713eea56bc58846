"""What only bags that mrpbench wrote say: the context, progress, contacts and events."""

from collections import defaultdict
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.model.recording import Chunk
from mrpbench_core.model.run import RunContext
from mrpbench_exporters_rosbag2 import advance, routes, whole
from mrpbench_exporters_rosbag2.events import CONTACTS, EVENTS
from mrpbench_exporters_rosbag2.messages import SECOND, full_name
from mrpbench_exporters_rosbag2.reading.collected import Take, nanoseconds

TOPICS = (whole.TOPIC, advance.TOPIC, CONTACTS, EVENTS, routes.TOPIC)
KINDS = {"released": "i4", "reached": "i4", "cleared": "i4", "mode": "u1", "level": "i2"}


class Own:
    """Collects them."""

    def __init__(self, topics: dict[str, str]) -> None:
        """`topics` give types by name."""
        self.context: RunContext | None = None
        self.notes: list[str] = []
        self._rows: dict[str, list[Any]] = defaultdict(list)
        self._topics = {topic.name for topic in TOPICS if topics.get(topic.name) == full_name(topic.type)}

    def takers(self) -> dict[str, Take]:
        """Who takes in the messages of each topic, if the bag is one of mrpbench's."""
        if whole.TOPIC.name not in self._topics:
            return {}
        takes = {
            whole.TOPIC.name: self._whole,
            advance.TOPIC.name: self._progress,
            CONTACTS.name: self._contact,
            EVENTS.name: self._event,
            routes.TOPIC.name: self._routes,
        }
        return {topic: takes[topic] for topic in self._topics}

    @property
    def begin(self) -> int | None:
        """Stamp of the recording's first sample, nanoseconds; None = it is no whole recording."""
        return int(self._rows["time"][0]) if self.context and self._rows["time"] else None

    def channels(self) -> Chunk:
        """Channels with times in seconds since `begin`."""
        begin = self.begin
        if begin is None or self.context is None:
            return {}
        numbers = {name: index for index, name in enumerate(self.context.fleet.names)}

        def times(name: str) -> NDArray[Any]:
            return (np.array(self._rows[name], np.int64) - begin) / SECOND

        table = np.array(self._rows["progress"]).reshape(len(self._rows["time"]), -1, len(advance.CHANNELS))
        found: dict[str, NDArray[Any]] = {"time": times("time")}
        found |= {name: table[..., column].astype(KINDS[name]) for column, name in enumerate(advance.CHANNELS)}
        pairs = [[numbers.get(name, -1) for name in pair] for pair in self._rows["contact"]]
        new: list[Chunk] = self._rows["routes"]
        found |= {name: np.concatenate([rows[name] for rows in new]) for name in routes.CHANNELS if new}
        return found | {
            "contact_time": times("contact_time"),
            "contact": np.array(pairs, "i4").reshape(-1, 2),
            "event_time": times("event_time"),
            "event_kind": np.array(self._rows["event_kind"], "U"),
            "event_robot": np.array([numbers.get(name, -1) for name in self._rows["event_robot"]], "i4"),
            "event_detail": np.array(self._rows["event_detail"], "U"),
        }

    def _whole(self, _logged: int, message: Any) -> None:
        try:
            self.context = whole.unpack(message.data)
        except ValueError as error:
            self.notes.append(f"{whole.TOPIC.name} is {error}: read like a bag of any other fleet")

    def _progress(self, logged: int, message: Any) -> None:
        self._rows["time"].append(logged)
        self._rows["progress"].append(message.data)

    def _contact(self, _logged: int, message: Any) -> None:
        (status,) = message.status
        self._rows["contact_time"].append(nanoseconds(message.header.stamp))
        self._rows["contact"].append((status.name, status.values[0].value))

    def _event(self, _logged: int, message: Any) -> None:
        (status,) = message.status
        self._rows["event_time"].append(nanoseconds(message.header.stamp))
        self._rows["event_kind"].append(status.message)
        self._rows["event_robot"].append(status.name)
        self._rows["event_detail"].append(status.values[0].value)

    def _routes(self, _logged: int, message: Any) -> None:
        with np.load(BytesIO(message.data.tobytes()), allow_pickle=False) as file:
            self._rows["routes"].append({name: file[name] for name in routes.CHANNELS})
