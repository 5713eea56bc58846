"""The writer of `rosbags`, without the parts that are slow with the thousands of topics of a thousand robots."""

from functools import cache
from pathlib import Path
from typing import Any, Literal

from rosbags.interfaces import Connection, ConnectionExtRosbag2, MessageDefinition, MessageDefinitionFormat, Qos
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.rosbag2.metadata import dump_qos_v8, dump_qos_v9
from rosbags.typesys.store import Typestore

from mrpbench_exporters_rosbag2.block_yaml import block_yaml


class QuickWriter(Writer):
    """Writes messages uncompressed; the storage may compress. Every topic is added once; time does not run backwards.

    `rosbags` looks through all topics at every message, describes type and quality of service of every topic anew, and
    has a library of YAML write the metadata, twice.
    """

    def __init__(self, path: Path, *, version: Literal[8, 9], storage_plugin: StoragePlugin) -> None:
        super().__init__(path, version=version, storage_plugin=storage_plugin)
        self._definitions: dict[str, tuple[MessageDefinition, str]] = {}

    def add_topic(self, topic: str, msgtype: str, types: Typestore, quality: Qos) -> Connection:
        """Add a topic with the definition of its messages in `types`."""
        assert self.storage is not None
        if msgtype not in self._definitions:
            text, _ = types.generate_msgdef(msgtype, ros_version=2)
            definition = MessageDefinition(MessageDefinitionFormat.MSG, text)
            self._definitions[msgtype] = definition, types.hash_rihs01(msgtype)
        definition, digest = self._definitions[msgtype]
        connection = Connection(
            id=len(self.connections) + 1,
            topic=topic,
            msgtype=msgtype,
            msgdef=definition,
            digest=digest,
            msgcount=0,
            ext=ConnectionExtRosbag2(serialization_format="cdr", offered_qos_profiles=[quality]),
            owner=self,
        )
        if msgtype not in self.added_types:
            self.storage.add_msgtype(connection)
            self.added_types.add(msgtype)
        profiles = self._profiles(connection)
        self.storage.add_connection(connection, profiles if isinstance(profiles, str) else block_yaml(profiles).strip())
        self.connections.append(connection)
        self.counts[connection.id] = 0
        return connection

    def write(self, connection: Connection, timestamp: int, data: bytes | memoryview) -> None:
        """Append a message of a topic of this writer."""
        assert self.storage is not None
        self.storage.write(connection, timestamp, data)
        self.counts[connection.id] += 1
        self.min_timestamp = min(self.min_timestamp, timestamp)
        self.max_timestamp = timestamp

    def close(self) -> None:
        """Finish the storage and write `metadata.yaml`, last and at once."""
        assert self.storage is not None
        facts = self._facts(self.storage.path.name)
        self.storage.close(self.version, block_yaml(facts).strip())
        self.storage = None
        unfinished = self.metapath.with_suffix(".yaml.tmp")
        unfinished.write_text(block_yaml({"rosbag2_bagfile_information": facts}), "utf8")
        unfinished.replace(self.metapath)

    def _facts(self, file: str) -> dict[str, Any]:
        """The metadata: https://github.com/ros2/rosbag2, `rosbag2_storage/metadata`, versions 8 and 9."""
        start = {"nanoseconds_since_epoch": self.min_timestamp}
        duration = {"nanoseconds": max(0, self.max_timestamp - self.min_timestamp)}
        count = sum(self.counts.values())
        return {
            "version": self.version,
            "storage_identifier": self.storage_plugin.name.lower(),
            "duration": duration,
            "starting_time": start,
            "message_count": count,
            "topics_with_message_count": [
                {
                    "topic_metadata": {
                        "name": known.topic,
                        "type": known.msgtype,
                        "serialization_format": "cdr",
                        "offered_qos_profiles": self._profiles(known),
                        "type_description_hash": known.digest,
                    },
                    "message_count": self.counts[known.id],
                }
                for known in self.connections
            ],
            "compression_format": "",
            "compression_mode": "",
            "relative_file_paths": [file],
            "files": [{"path": file, "starting_time": start, "duration": duration, "message_count": count}],
            "custom_data": self.custom_data or None,
            "ros_distro": "rosbags",
        }

    def _profiles(self, connection: Connection) -> Any:
        """Quality of service: a list since version 9, before that its text."""
        assert isinstance(connection.ext, ConnectionExtRosbag2)
        profiles = connection.ext.offered_qos_profiles
        return dump_qos_v9(profiles) if self.version >= 9 else _dump_v8(tuple(profiles))


@cache
def _dump_v8(profiles: tuple[Qos, ...]) -> str:
    return dump_qos_v8(list(profiles))
