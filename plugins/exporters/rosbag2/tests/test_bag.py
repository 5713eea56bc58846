import os
import signal
import sqlite3
import subprocess
import sys

import numpy as np
import pytest
import yaml
from mcap.reader import make_reader
from mrpbench_exporters_rosbag2 import Rosbag2
from mrpbench_exporters_rosbag2.bag import Bag
from mrpbench_exporters_rosbag2.messages import TYPES, Topic, message, serialize
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_typestore

from mrpbench_core.files.errors import InputError

TEXT = Topic("/text", "std_msgs/String")
LATCHED = ("/map", "/run", "/run_data", "/navigation_graph", "/tf_static", "/goals", "/plan", "/goal_pose")


def text(content):
    return serialize(TEXT.type, message(TEXT.type, data=content))


def write(destination, content, storage="mcap", close=True):
    bag = Bag(destination, storage, 9)
    bag.write(TEXT, 7, text(content))
    bag.close() if close else bag.writer.abort()


def texts(destination):
    with Reader(destination) as reader:
        return [TYPES.deserialize_cdr(data, "std_msgs/msg/String").data for _, _, data in reader.messages()]


def export(context, recording, destination, **options):
    session = Rosbag2(**options).open(context, destination)
    session.write(recording)
    session.close()
    return destination


def metadata(bag):
    return yaml.safe_load((bag / "metadata.yaml").read_text())["rosbag2_bagfile_information"]


@pytest.mark.parametrize("version", [8, 9])
@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_metadata_list_the_topics_of_the_bag(context, recording, tmp_path, storage, version):
    bag = export(context, recording, tmp_path / "bag", storage=storage, version=version, start_time=50.0)
    facts = metadata(bag)
    suffix = {"mcap": "mcap", "sqlite3": "db3"}[storage]
    assert facts["version"] == version
    assert facts["storage_identifier"] == storage
    assert facts["relative_file_paths"] == [f"bag.{suffix}"]
    assert (bag / f"bag.{suffix}").is_file()
    assert facts["starting_time"]["nanoseconds_since_epoch"] == 50 * 10**9
    assert facts["duration"]["nanoseconds"] == 4 * 10**9
    assert facts["custom_data"] == {"mrpbench_run_id": "f00d"}
    topics = {entry["topic_metadata"]["name"]: entry for entry in facts["topics_with_message_count"]}
    assert topics["/tf"]["message_count"] == len(recording["time"])
    assert topics["/tf"]["topic_metadata"]["type"] == "tf2_msgs/msg/TFMessage"
    assert facts["message_count"] == sum(entry["message_count"] for entry in topics.values())
    for name, entry in topics.items():
        quality = entry["topic_metadata"]["offered_qos_profiles"]
        assert isinstance(quality, list if version == 9 else str)
        (quality,) = quality if version == 9 else yaml.safe_load(quality)
        latched = name.endswith(LATCHED)
        if version == 9:
            assert quality["durability"] == ("transient_local" if latched else "volatile")
            assert (quality["reliability"], quality["history"]) == ("reliable", "keep_last")
        else:
            assert (quality["durability"], quality["reliability"], quality["history"]) == (1 if latched else 2, 1, 1)
        assert quality["depth"] == (1 if latched else 10)


def test_mcap_is_compressed_and_indexed_and_names_latched_topics(context, recording, tmp_path):
    bag = export(context, recording, tmp_path / "bag")
    with (bag / "bag.mcap").open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        assert reader.get_header().profile == "ros2"
        summary = reader.get_summary()
    assert {index.compression for index in summary.chunk_indexes} == {"zstd"}
    for channel in summary.channels.values():
        (quality,) = yaml.safe_load(channel.metadata["offered_qos_profiles"])
        assert (quality["durability"] == "transient_local") == channel.topic.endswith(LATCHED)
        assert summary.schemas[channel.schema_id].encoding == "ros2msg"
    assert summary.statistics.message_count == metadata(bag)["message_count"]


def test_sqlite_holds_the_same_messages_as_mcap(context, recording, tmp_path):
    flat = export(context, recording, tmp_path / "flat", storage="sqlite3")
    packed = export(context, recording, tmp_path / "packed")
    database = sqlite3.connect(flat / "flat.db3")
    rows = database.execute(
        "SELECT name, timestamp, data FROM messages JOIN topics ON topics.id = topic_id ORDER BY messages.id"
    ).fetchall()
    database.close()
    with (packed / "packed.mcap").open("rb") as file:
        messages = make_reader(file).iter_messages(log_time_order=False)
        assert rows == [(channel.topic, message.log_time, message.data) for _, channel, message in messages]
    types = get_typestore(Stores.ROS2_JAZZY)
    with Reader(flat) as reader:
        (scan_topic,) = [one for one in reader.connections if one.topic == "/robot_1/scan"]
        scans = [types.deserialize_cdr(data, scan_topic.msgtype) for _, _, data in reader.messages([scan_topic])]
    expected = recording["scan_ranges"][recording["scan_robot"] == 1]
    assert np.array_equal([scan.ranges for scan in scans], expected)


def test_types_are_those_of_every_distribution_that_reads_the_bag(context, recording, tmp_path):
    used = {
        entry["topic_metadata"]["type"]
        for entry in metadata(export(context, recording, tmp_path / "bag"))["topics_with_message_count"]
    } - {"rmf_fleet_msgs/msg/FleetState"}  # which is not part of ROS
    for store in (Stores.ROS2_IRON, Stores.ROS2_JAZZY, Stores.ROS2_KILTED):
        other = get_typestore(store)
        assert {name: other.hash_rihs01(name) for name in used} == {name: TYPES.hash_rihs01(name) for name in used}


def test_an_earlier_bag_is_replaced_only_at_the_end(tmp_path):
    write(tmp_path / "bag", "old", "sqlite3")
    bag = Bag(tmp_path / "bag", "mcap", 9)
    bag.write(TEXT, 7, text("new"))
    assert texts(tmp_path / "bag") == ["old"]
    bag.close()
    assert texts(tmp_path / "bag") == ["new"]
    assert sorted(path.name for path in (tmp_path / "bag").iterdir()) == ["bag.mcap", "metadata.yaml"]
    assert [path.name for path in tmp_path.iterdir()] == ["bag"]


def test_a_killed_writer_leaves_nothing_under_the_name_and_the_next_one_cleans_up(tmp_path):
    script = (
        "import sys, pathlib\n"
        "from mrpbench_exporters_rosbag2.bag import Bag\n"
        "from mrpbench_exporters_rosbag2.messages import Topic\n"
        "bag = Bag(pathlib.Path(sys.argv[1]), 'mcap', 9)\n"
        "for stamp in range(2000):\n"
        "    bag.write(Topic('/text', 'std_msgs/String'), stamp, bytes(2000))\n"
        "print('written', flush=True)\n"
        "sys.stdin.read()\n"
    )
    command = [sys.executable, "-c", script, str(tmp_path / "bag")]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as writer:
        assert writer.stdout.readline() == b"written\n"
        os.kill(writer.pid, signal.SIGKILL)
    assert not (tmp_path / "bag").exists()
    assert [path.name for path in tmp_path.iterdir()] == [".bag.partial"]
    write(tmp_path / "bag", "again")
    assert texts(tmp_path / "bag") == ["again"]
    assert [path.name for path in tmp_path.iterdir()] == ["bag"]


def test_log_time_does_not_run_backwards(tmp_path):
    bag = Bag(tmp_path / "bag", "mcap", 9)
    for stamp in (5, 9, 7):
        bag.write(TEXT, stamp, text("now"))
    bag.close()
    with Reader(tmp_path / "bag") as reader:
        assert [stamp for _, stamp, _ in reader.messages()] == [5, 9, 9]


def test_a_folder_that_is_not_a_bag_is_not_replaced(tmp_path):
    (tmp_path / "thesis").mkdir()
    (tmp_path / "thesis" / "chapter.tex").write_text("years of work")
    (tmp_path / "file").write_text("")
    for name in ("thesis", "file"):
        with pytest.raises(InputError, match="is not a rosbag2"):
            Bag(tmp_path / name, "mcap", 9)
    assert (tmp_path / "thesis" / "chapter.tex").exists()
    with pytest.raises(InputError, match="does not exist"):
        Bag(tmp_path / "nowhere" / "bag", "mcap", 9)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "thesis"]


def test_an_empty_folder_may_become_a_bag(tmp_path):
    (tmp_path / "bag").mkdir()
    write(tmp_path / "bag", "here")
    assert texts(tmp_path / "bag") == ["here"]
