"""Bags that no code of ours, and not the library that reads them, wrote: `mcap`, `mcap_ros2` and bare SQLite."""

import sqlite3
import struct

import numpy as np
import pytest
from mcap.well_known import MessageEncoding
from mcap.writer import Writer as BareWriter
from mcap_ros2.writer import Writer
from mrpbench_exporters_rosbag2 import Rosbag2
from mrpbench_exporters_rosbag2.reading.bounds import check_definition
from mrpbench_exporters_rosbag2.reading.stream import Stream
from rosbags.interfaces import Connection, MessageDefinition, MessageDefinitionFormat
from rosbags.typesys import get_types_from_msg

from mrpbench_core.files.errors import InputError

SEPARATOR = "=" * 80 + "\n"
TIME = "int32 sec\nuint32 nanosec\n"
HEADER = "builtin_interfaces/Time stamp\nstring frame_id\n"
POSE = "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"
POINT, QUATERNION = "float64 x\nfloat64 y\nfloat64 z\n", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"
BATTERY = "acme_msgs/Cell[] cells\nstring<=8 label\nfloat32[3] volts\n"


def definition(text, **parts):
    return text + "".join(f"{SEPARATOR}MSG: {name.replace('__', '/')}\n{part}" for name, part in parts.items())


STAMPED = definition(
    "std_msgs/Header header\ngeometry_msgs/Pose pose\n",
    std_msgs__Header=HEADER,
    builtin_interfaces__Time=TIME,
    geometry_msgs__Pose=POSE,
    geometry_msgs__Point=POINT,
    geometry_msgs__Quaternion=QUATERNION,
)
CUSTOM = definition(BATTERY, acme_msgs__Cell="uint8 number\nbool hot\n")
EXTENDED = "string site\n" + STAMPED  # a fork of geometry_msgs: its own field comes first


def pose(t, x, y, yaw):
    return {
        "header": {"stamp": {"sec": int(t), "nanosec": round(t % 1 * 1e9)}, "frame_id": "map"},
        "pose": {
            "position": {"x": x, "y": y, "z": 0.0},
            "orientation": {"x": 0.0, "y": 0.0, "z": float(np.sin(yaw / 2)), "w": float(np.cos(yaw / 2))},
        },
    }


def write(file, topic, text, **more):
    """Poses of two robots and messages of a custom type, without metadata.yaml."""
    with file.open("wb") as stream:
        writer = Writer(stream)
        schema = writer.register_msgdef("geometry_msgs/msg/PoseStamped", text)
        own = writer.register_msgdef("acme_msgs/msg/Battery", CUSTOM)
        for step in range(50):
            t = 100 + step / 10
            for index, name in enumerate(("husky", "jackal")):
                writer.write_message(
                    topic.format(name), schema, pose(t, step / 10, index, 0.5) | more, log_time=int(t * 1e9)
                )
            battery = {"cells": [{"number": 1, "hot": True}], "label": "main", "volts": [1.0, 2.0, 3.0]}
            writer.write_message("/battery", own, battery, log_time=int(t * 1e9))
        writer.finish()
    return file


@pytest.mark.parametrize(("text", "more"), [(STAMPED, {}), (EXTENDED, {"site": "hall 3"})])
def test_other_names_and_definitions_of_their_own_are_read(tmp_path, text, more):
    file = write(tmp_path / "site.mcap", "/fleet/{}/pose", text, **more)
    observed = Rosbag2(amcl_pose=("/fleet/{robot}/pose",)).read(file)
    assert [(track.robot, track.source) for track in observed.tracks] == [
        ("husky", "amcl_pose"),
        ("jackal", "amcl_pose"),
    ]
    for index, track in enumerate(observed.tracks):
        assert track.time == pytest.approx(np.arange(50) / 10)
        assert track.pose == pytest.approx(np.array([(step / 10, index, 0.5) for step in range(50)]))


def test_without_a_pattern_that_fits_the_topics_are_listed(tmp_path):
    file = write(tmp_path / "site.mcap", "/fleet/{}/pose", STAMPED)
    with pytest.raises(InputError, match="holds no pose of any robot") as caught:
        Rosbag2().read(file)
    for words in ("/fleet/husky/pose (geometry_msgs/PoseStamped)", "/battery (acme_msgs/Battery)", "--option"):
        assert words in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("encoding", "schema", "data"),
    [("ros1msg", "ros1", b""), ("jsonschema", "json", b"{}"), ("protobuf", "protobuf", b"\x08\x01")],
)
def test_files_that_are_not_of_ros_2_are_refused_in_one_line(tmp_path, encoding, schema, data):
    file = tmp_path / "odd.mcap"
    with file.open("wb") as stream:
        writer = BareWriter(stream)
        writer.start()
        number = writer.register_schema(name="geometry_msgs/PoseStamped", encoding=encoding, data=b"{}")
        channel = writer.register_channel(topic="/a/amcl_pose", message_encoding=schema, schema_id=number)
        writer.add_message(channel_id=channel, log_time=1, publish_time=1, data=data)
        writer.finish()
    with pytest.raises(InputError) as caught:
        Rosbag2().read(file)
    assert "\n" not in str(caught.value)


def test_a_definition_that_makes_no_sense_is_named(tmp_path):
    file = tmp_path / "torn.mcap"
    with file.open("wb") as stream:
        writer = BareWriter(stream)
        writer.start("ros2")
        number = writer.register_schema(name="geometry_msgs/msg/PoseStamped", encoding="ros2msg", data=b"?? no type")
        channel = writer.register_channel(topic="/a/amcl_pose", message_encoding=MessageEncoding.CDR, schema_id=number)
        writer.add_message(channel_id=channel, log_time=1, publish_time=1, data=b"\x00\x01\x00\x00")
        writer.finish()
    with pytest.raises(InputError, match=r"/a/amcl_pose: its type geometry_msgs/msg/PoseStamped is not understood"):
        Rosbag2().read(file)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (definition("acme_msgs/Cell[300000000] cells\n", acme_msgs__Cell="int8 a\n"), "300000000 entries"),
        ("string[600] a\nstring[600] b\n", "1200 entries"),
        ("int8 " + 300_000 * "a" + "\n", "300006 characters"),
    ],
)
def test_a_definition_that_would_be_long_code_is_named_and_not_compiled(tmp_path, text, said):
    connection = Connection(
        1, "/a", "acme_msgs/msg/Big", MessageDefinition(MessageDefinitionFormat.MSG, text), "", 1, None, None
    )
    with Stream(write(tmp_path / "site.mcap", "/{}/amcl_pose", STAMPED)) as stream:
        assert stream._definition(connection) is None
        assert said in stream.notes[-1]


def test_long_arrays_of_numbers_and_short_ones_of_messages_are_read():
    text = definition("float64[1000000] grid\nacme_msgs/Cell[8] cells\n", acme_msgs__Cell="int8 a\n")
    check_definition(text, get_types_from_msg(text, "acme_msgs/msg/Big"))


def sqlite(file, kind, data):
    """A database as ros2 bag of Foxy to Humble wrote it: without definitions."""
    with sqlite3.connect(file) as base:
        base.execute(
            "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
            "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)"
        )
        base.execute(
            "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, "
            "data BLOB NOT NULL)"
        )
        base.execute("INSERT INTO topics VALUES (1, '/a/amcl_pose', ?, 'cdr', '')", (kind,))
        rows = [(index, 1, stamp, blob) for index, (stamp, blob) in enumerate(data)]
        base.executemany("INSERT INTO messages VALUES (?, ?, ?, ?)", rows)
    base.close()
    return file


def stamped(t, x, y):
    """CDR of a PoseStamped by hand: stamp, `map`, padding to 8 bytes, position, turn."""
    head = struct.pack("<iI", int(t), round(t % 1 * 1e9)) + struct.pack("<I4s", 4, b"map\0")
    return b"\x00\x01\x00\x00" + head + struct.pack("<7d", x, y, 0, 0, 0, 0, 1)


def test_a_database_without_definitions_is_read_by_those_of_ros(tmp_path):
    data = [(int((5 + t) * 1e9), stamped(5 + t, 2 * t, 1.0)) for t in np.arange(0, 3, 0.25)]
    (track,) = Rosbag2().read(sqlite(tmp_path / "old.db3", "geometry_msgs/msg/PoseStamped", data)).tracks
    assert track.time == pytest.approx(np.arange(0, 3, 0.25))
    assert track.pose[:, :2] == pytest.approx(np.array([(2 * t, 1.0) for t in np.arange(0, 3, 0.25)]))


def test_a_database_of_an_unknown_type_is_refused(tmp_path):
    file = sqlite(tmp_path / "own.db3", "acme_msgs/msg/Place", [(1, b"\x00\x01\x00\x00")])
    with pytest.raises(InputError, match=r"holds no pose of any robot.*acme_msgs/Place"):
        Rosbag2().read(file)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ("UPDATE topics SET name = x'2f61'", "a topic has no name"),
        ("UPDATE messages SET timestamp = x'' WHERE id > 3", "a message has no time"),
        ("UPDATE messages SET timestamp = 1e300 WHERE id > 3", "a message has no time"),
    ],
)
def test_a_database_with_values_of_other_kinds_is_damaged_there(tmp_path, change, said):
    data = [(int((5 + t) * 1e9), stamped(5 + t, 2 * t, 1.0)) for t in range(8)]
    file = sqlite(tmp_path / "old.db3", "geometry_msgs/msg/PoseStamped", data)
    with sqlite3.connect(file) as base:
        base.execute(change)
    base.close()
    if "topic" in said:
        with pytest.raises(InputError, match=said):
            Rosbag2().read(file)
    else:
        observed = Rosbag2().read(file)
        assert len(observed.tracks[0].time) == 4
        assert not observed.complete
        assert any(said in note for note in observed.notes)
