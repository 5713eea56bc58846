"""A rosbag2 folder that appears under its name only when it is complete."""

import shutil
from pathlib import Path
from typing import Literal

from rosbags.interfaces import (
    Connection,
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin

from mrpbench_core.files.errors import InputError
from mrpbench_exporters_rosbag2.messages import Topic, full_name
from mrpbench_exporters_rosbag2.writer import QuickWriter

Storage = Literal["mcap", "sqlite3"]
Version = Literal[8, 9]
FOREVER = QosTime(sec=9223372036, nsec=854775807)


class Bag:
    """Writes to `.<name>.partial` next to the destination; `close` renames the finished bag."""

    def __init__(self, destination: Path, storage: Storage, version: Version) -> None:
        """Begin a bag.

        Raises:
            InputError: the destination's folder is missing, or something that is not a bag stands in its place.
        """
        if not destination.parent.is_dir():
            raise InputError("the folder to write the bag to does not exist", file=destination.parent)
        if destination.exists() and not _is_bag(destination):
            raise InputError(
                "is not a rosbag2, so it is not replaced", file=destination, hint="move it away or choose another name"
            )
        self.destination = destination
        self.workshop = destination.with_name(f".{destination.name}.partial")
        if self.workshop.exists():  # what a crash left behind
            shutil.rmtree(self.workshop)
        self.writer = QuickWriter(
            self.workshop / destination.name, version=version, storage_plugin=StoragePlugin[storage.upper()]
        )
        if storage == "mcap":
            self.writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        self.writer.open()
        self.connections: dict[str, Connection] = {}
        self.latest = 0

    def describe(self, key: str, value: str) -> None:
        """Note something in `metadata.yaml` under `custom_data`."""
        self.writer.set_custom_data(key, value)

    def write(self, topic: Topic, stamp: int, data: bytes) -> None:
        """Append a message; its log time is its stamp (nanoseconds), and never before that of the message before."""
        connection = self.connections.get(topic.name)
        if connection is None:
            connection = self.connections[topic.name] = self.writer.add_topic(
                topic.name, full_name(topic.type), topic.types, LATCHED if topic.latched else LIVE
            )
        self.latest = max(self.latest, stamp)
        self.writer.write(connection, self.latest, data)

    def abandon(self) -> None:
        """Remove the unfinished bag."""
        self.writer.abort()
        shutil.rmtree(self.workshop)

    def close(self) -> None:
        """Finish the bag and replace what stands at the destination."""
        self.writer.close()
        if self.destination.exists():
            self.destination.rename(self.workshop / "replaced")
        self.writer.path.rename(self.destination)
        shutil.rmtree(self.workshop)


def _is_bag(path: Path) -> bool:
    """A folder that holds a bag's metadata, or nothing at all."""
    return path.is_dir() and ((path / "metadata.yaml").is_file() or not any(path.iterdir()))


def _quality(latched: bool) -> Qos:
    """Quality of service: reliable; latched topics keep their last message for late subscribers."""
    return Qos(
        history=QosHistory.KEEP_LAST,
        depth=1 if latched else 10,
        reliability=QosReliability.RELIABLE,
        durability=QosDurability.TRANSIENT_LOCAL if latched else QosDurability.VOLATILE,
        deadline=FOREVER,
        lifespan=FOREVER,
        liveliness=QosLiveliness.AUTOMATIC,
        liveliness_lease_duration=FOREVER,
        avoid_ros_namespace_conventions=False,
    )


LIVE, LATCHED = _quality(latched=False), _quality(latched=True)
