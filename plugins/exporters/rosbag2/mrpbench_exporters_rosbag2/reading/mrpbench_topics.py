"""Reads bags that mrpbench wrote: context, progress, contacts, events and channels of the recording."""

from collections import defaultdict
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.checking.context import check_rows
from mrpbench_core.checking.recording import axis_of, check_names
from mrpbench_core.files.errors import one_line
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.run import RunContext
from mrpbench_exporters_rosbag2 import advance, people, routes, whole
from mrpbench_exporters_rosbag2.doors_and_lifts import NUMBERS
from mrpbench_exporters_rosbag2.events import CONTACTS, EVENTS
from mrpbench_exporters_rosbag2.messages import SECOND, full_name
from mrpbench_exporters_rosbag2.reading.collected import TRANSFORMS, Take, nanoseconds
from mrpbench_exporters_rosbag2.reading.signals import Said, Signals, table, turn
from mrpbench_exporters_rosbag2.reading.transforms import compose

TOPICS = (whole.TOPIC, advance.TOPIC, CONTACTS, EVENTS, NUMBERS, people.NUMBERS, routes.TOPIC)
TF = "/tf"
KINDS = {"released": "i4", "reached": "i4", "cleared": "i4", "mode": "u1", "level": "i2"}


class MrpbenchTopics:
    """Collects the messages of the topics that only mrpbench writes."""

    def __init__(self, topics: dict[str, str], signals: Signals) -> None:
        """`topics` give types by name; `signals` are those of the same pass."""
        self.context: RunContext | None = None
        self.notes: list[str] = []
        self._rows: dict[str, list[Any]] = defaultdict(list)
        self._topics = {topic.name for topic in TOPICS if topics.get(topic.name) == full_name(topic.type)}
        self._types = topics
        self._signals = signals
        self._estimates: dict[str, Said] = {}
        self._damaged: str | None = None

    def takers(self) -> dict[str, Take]:
        """Return the handler of each topic, if mrpbench wrote the bag."""
        if whole.TOPIC.name not in self._topics:
            return {}
        takes: dict[str, Take] = {
            whole.TOPIC.name: self._whole,
            advance.TOPIC.name: self._progress,
            CONTACTS.name: self._contact,
            EVENTS.name: self._event,
            NUMBERS.name: partial(self._numbers, "facility"),
            people.NUMBERS.name: partial(self._numbers, "mover"),
            routes.TOPIC.name: self._routes,
        }
        return {topic: takes[topic] for topic in self._topics} | (
            {TF: self._transforms} if self._types.get(TF) == TRANSFORMS else {}
        )

    @property
    def begin(self) -> int | None:
        """Stamp of the recording's first sample, nanoseconds; None if the recording is not complete."""
        return int(self._rows["time"][0]) if self.context and self._rows["time"] else None

    def channels(self) -> Chunk:
        """Channels with times in seconds since `begin`; none if something in them is damaged."""
        if self.begin is None or self.context is None:
            return {}
        try:
            chunk = self._channels(self.begin, self.context)
            faults = [check_rows(name, rows, chunk[axis_of(name)], self.context) for name, rows in chunk.items()]
            fault = next(filter(None, [self._damaged, *check_names(chunk), *faults]), None)
        except (ValueError, TypeError, LookupError, OverflowError) as error:  # messages do not fit one another
            fault = one_line(error)
        if fault is not None:
            self.notes.append(f"the progress of the run is damaged ({fault}): read like a bag of any other fleet")
            return {}
        return chunk

    def _channels(self, begin: int, context: RunContext) -> Chunk:
        numbers = {name: index for index, name in enumerate((*context.fleet.names, *context.mover_names))}

        def times(name: str) -> NDArray[Any]:
            return (np.array(self._rows[name], np.int64) - begin) / SECOND

        table = np.array(self._rows["progress"]).reshape(len(self._rows["time"]), -1, len(advance.CHANNELS))
        chunk: dict[str, NDArray[Any]] = {"time": times("time")}
        chunk |= {name: table[..., column].astype(KINDS[name]) for column, name in enumerate(advance.CHANNELS)}
        pairs = [[numbers.get(name, -1) for name in pair] for pair in self._rows["contact"]]
        new: list[Chunk] = self._rows["routes"]
        chunk |= {name: np.concatenate([rows[name] for rows in new]) for name in (new[0] if new else ())}
        return {
            **chunk,
            **self._sampled(),
            **self._scans(begin),
            **self._facilities(),
            **self._movers(),
            "contact_time": times("contact_time"),
            "contact": np.array(pairs, "i4").reshape(-1, 2),
            "contact_force": np.array(self._rows["contact_force"], float),
            "event_time": times("event_time"),
            "event_kind": np.array(self._rows["event_kind"], "U"),
            "event_robot": np.array([numbers.get(name, -1) for name in self._rows["event_robot"]], "i4"),
            "event_detail": np.array(self._rows["event_detail"], "U"),
        }

    def _sampled(self) -> Chunk:
        """Periodic channels of which every robot has a message at every sample."""
        assert self.context is not None
        said = self._signals.said | {(robot, "estimate"): rows for robot, rows in self._estimates.items()}
        chunk: dict[str, NDArray[Any]] = {}
        for channel in ("truth", "odometry", "command", "estimate"):
            every = [said.get((name, channel)) for name in self.context.fleet.names]
            rows = [one.rows for one in every if one is not None and one.logged == self._rows["time"]]
            if len(rows) == len(every):
                chunk[channel] = np.swapaxes(np.array(rows, float), 0, 1)
            elif any(every):
                self.notes.append(f"not every robot has every sample of {channel}: it was not read")
        for channel in ("truth", "odometry", "estimate"):
            if channel in chunk:  # a quaternion tells turns from turns and a half, not from double ones
                chunk[channel][..., 2] = np.unwrap(chunk[channel][..., 2], period=4 * np.pi, axis=0)
        if "truth" in chunk:
            chunk["truth_twist"], chunk["truth"] = chunk["truth"][..., 3:], chunk["truth"][..., :3]
        return chunk

    def _scans(self, begin: int) -> Chunk:
        assert self.context is not None
        said = [self._signals.said.get((name, "scan_ranges")) for name in self.context.fleet.names]
        stamps = np.array([stamp for one in said if one for stamp in one.logged], np.int64)
        if not len(stamps):
            return {}
        robot = np.repeat(np.arange(len(said), dtype="i4"), [len(one.rows) if one else 0 for one in said])
        ranges = table([row for one in said if one for row in one.rows])
        order = np.argsort(stamps, kind="stable")
        return {
            "scan_time": (stamps[order] - begin) / SECOND,
            "scan_robot": robot[order],
            "scan_ranges": ranges[order],
        }

    def _facilities(self) -> Chunk:
        states = self._at_samples("facility", NUMBERS.name, "the states of doors and lifts")
        return {} if states is None else {"facility": states}

    def _movers(self) -> Chunk:
        rows = self._at_samples("mover", people.NUMBERS.name, "people and other movers")
        if rows is None:
            return {}
        table = rows.reshape(len(rows), -1, len(people.COLUMNS))
        level, arrivals = table[..., 5].astype("i2"), table[..., 6].astype("i4")
        return {"mover": table[..., :5], "mover_level": level, "mover_arrivals": arrivals}

    def _at_samples(self, name: str, topic: str, what: str) -> Float | None:
        """Rows of a topic, if there is one at every sample."""
        if not self._rows[name]:
            return None
        if self._rows[f"{name}_time"] != self._rows["time"]:
            self.notes.append(f"not every sample is on {topic}: {what} were not read")
            return None
        return np.array(self._rows[name], float)

    def _numbers(self, name: str, logged: int, message: Any) -> None:
        self._rows[f"{name}_time"].append(logged)
        self._rows[name].append(message.data)

    def _transforms(self, logged: int, message: Any) -> None:
        """Estimates, which are what a robot's two transforms make together; see `frames`."""
        rows = {said.child_frame_id: _planar(said.transform) for said in message.transforms}
        for said in message.transforms:
            robot, _, frame = said.child_frame_id.rpartition("/")
            if frame == "base_footprint" and (driven := rows.get(f"{robot}/odom")) is not None:
                into = self._estimates.setdefault(robot, Said(TF))
                into.logged.append(logged)
                into.rows.append(compose(driven, rows[said.child_frame_id])[0, :3])

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
        values = {entry.key: entry.value for entry in status.values}
        self._rows["contact"].append((status.name, values["other"]))
        self._rows["contact_force"].append(float(values.get("force", "nan")))

    def _event(self, _logged: int, message: Any) -> None:
        (status,) = message.status
        self._rows["event_time"].append(nanoseconds(message.header.stamp))
        self._rows["event_kind"].append(status.message)
        self._rows["event_robot"].append(status.name)
        self._rows["event_detail"].append(status.values[0].value)

    def _routes(self, _logged: int, message: Any) -> None:
        try:
            arrays = whole.unpacked(message.data)
        except ValueError as error:
            self._damaged = f"{routes.TOPIC.name} is {error}"
        else:
            self._rows["routes"].append({name: arrays[name] for name in routes.CHANNELS if name in arrays})


def _planar(transform: Any) -> NDArray[Any]:
    """x, y, yaw and z f8[1,4]."""
    place = transform.translation
    return np.array([[place.x, place.y, turn(transform.rotation), place.z]])
