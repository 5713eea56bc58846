"""Topics over DDS, as ROS 2 nodes with `rmw_cyclonedds` see them: the type names and topics of ROS 2, in plain CDR."""

import time
from collections.abc import Callable
from typing import Any

from mrpbench_core.api import InputError
from mrpbench_live.rmf.messages import Messages

PROTOTYPE = "rmf_prototype_msgs"
DISCOVERY = "destination/discovery", "plan/discovery"
"""Topics on which participants are listed."""
TOPICS = {
    "odom": "nav_msgs/Odometry",
    "destination": f"{PROTOTYPE}/Destination",
    "destination/error": f"{PROTOTYPE}/DestinationError",
    "plan": f"{PROTOTYPE}/Plan",
    "plan/progress": f"{PROTOTYPE}/Progress",
    "plan/release": f"{PROTOTYPE}/PlanRelease",
    "plan/error": f"{PROTOTYPE}/PlanError",
} | dict.fromkeys(DISCOVERY, f"{PROTOTYPE}/ParticipantList")
"""The type of each topic; all but those of the discovery follow the name of a robot."""
LATCHED = ("destination", "plan", *DISCOVERY)
"""Topics whose last message is kept for who comes later (transient local)."""
DEPTH = 10
"""Messages that are kept for a reader on the other topics, as ROS 2 does by default."""
POLL_S, PAUSE = 0.01, 2.0
"""Seconds between looks at what has come while there is time, at least, and as a multiple of what a look takes."""
LEAST_S = 0.02
"""Seconds for which messages are taken in, or sent, where there is no time left."""


class Wire:
    """One participant of a DDS domain.

    Args:
        messages: the types.
        domain: its number, `ROS_DOMAIN_ID` of the nodes on the other side.

    Raises:
        InputError: there is no access to the domain.
    """

    def __init__(self, messages: Messages, domain: int) -> None:
        from cyclonedds.core import DDSException
        from cyclonedds.domain import DomainParticipant

        self.messages = messages
        self._takers: list[tuple[Any, Callable[[Any], None]]] = []
        """Each reader, and what is called with its messages."""
        self._next = 0
        """The index of the reader that is asked next."""
        self._writers: dict[str, Any] = {}
        self._topics: dict[str, Any] = {}
        self.sent = self.received = 0
        """Messages."""
        try:
            self._participant = DomainParticipant(domain)
        except DDSException as error:
            raise InputError(
                f"rmf: DDS domain {domain} cannot be joined: {error}", hint="see CYCLONEDDS_URI"
            ) from error

    def publish(self, topic: str, message: Any) -> None:
        """Send a message on a topic such as `robot_1/plan`."""
        if topic not in self._writers:
            self.advertise(topic)
        self._writers[topic].write(message)
        self.sent += 1

    def advertise(self, topic: str) -> None:
        """Let others find a topic on which messages will be sent."""
        from cyclonedds.pub import DataWriter, Publisher

        latched = _kind(topic) in LATCHED
        self._writers[topic] = DataWriter(Publisher(self._participant), self._topic(topic), qos=_qos(latched))

    def subscribe(self, topic: str, take: Callable[[Any], None]) -> None:
        """Call `take` with each message on a topic, within `serve`."""
        from cyclonedds.sub import DataReader, Subscriber

        latched = _kind(topic) in LATCHED and _kind(topic) != "destination"  # some senders of these keep nothing
        subscriber = Subscriber(self._participant)
        self._takers.append((DataReader(subscriber, self._topic(topic), qos=_qos(latched)), take))

    def serve(self, due: float) -> None:
        """Take in what has come, and what comes until it is time: `due` as of `time.monotonic`.

        What has not been taken in by then stays for the next call, which goes on with the next topic. A call that is
        late already takes in messages for a short while.
        """
        began = time.monotonic()
        until = max(due, began + LEAST_S)
        while True:
            for _ in range(len(self._takers)):
                reader, take = self._takers[self._next % len(self._takers)]
                self._next += 1
                for message in reader.take(N=DEPTH):
                    if message.sample_info.valid_data:  # not that a sender has left
                        self.received += 1
                        take(message)
                if time.monotonic() >= until:
                    return
            now = time.monotonic()
            if now >= due:
                return
            time.sleep(min(due - now, max(POLL_S, PAUSE * (now - began))))
            began = time.monotonic()

    def close(self) -> None:
        """Leave the domain."""
        self._takers.clear()
        self._writers.clear()
        self._topics.clear()
        del self._participant

    def _topic(self, topic: str) -> Any:
        from cyclonedds.topic import Topic

        if topic not in self._topics:
            kind = self.messages.type(TOPICS[_kind(topic)])
            self._topics[topic] = Topic(self._participant, f"rt/{topic}", kind)
        return self._topics[topic]


def _kind(topic: str) -> str:
    """The key of `TOPICS`: a topic without the name of its robot."""
    return topic if topic in DISCOVERY else topic.partition("/")[2]


def _qos(latched: bool) -> Any:
    from cyclonedds.qos import Policy, Qos
    from cyclonedds.util import duration

    return Qos(
        Policy.Reliability.Reliable(duration(milliseconds=100)),
        Policy.Durability.TransientLocal if latched else Policy.Durability.Volatile,
        Policy.History.KeepLast(1 if latched else DEPTH),
        Policy.DataRepresentation(use_cdrv0_representation=True),
    )
