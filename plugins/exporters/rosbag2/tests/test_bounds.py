"""Small bags that would grow large."""

import sqlite3
import struct
import tracemalloc

import lz4.frame
import pytest
from mrpbench_exporters_rosbag2.reading import bounds
from mrpbench_exporters_rosbag2.reading.bounds import LARGEST, inflate
from mrpbench_exporters_rosbag2.reading.salvage import END, MAGIC, salvage
from mrpbench_exporters_rosbag2.reading.stream import Stream
from rosbags.rosbag2 import CompressionFormat, CompressionMode, ReaderError, StoragePlugin, Writer, storage_mcap
from rosbags.typesys import Stores, get_typestore

from mrpbench_core.files.errors import InputError

PACK = {"zstd": storage_mcap.zstd.compress, "lz4": lz4.frame.compress}
BOMB = bytes(LARGEST + 2**20)


def record(opcode, content):
    return struct.pack("<BQ", opcode, len(content)) + content


def text(word):
    return struct.pack("<I", len(word)) + word.encode()


def chunked(file, content, size, compression):
    """Write an mcap with one chunk, whose declared size is `size`."""
    data = PACK[compression](content)
    chunk = struct.pack("<QQQI", 0, 1, size, 0) + text(compression) + struct.pack("<Q", len(data)) + data
    file.write_bytes(MAGIC + record(1, text("ros2") + text("")) + record(6, chunk) + END)
    assert file.stat().st_size < 2**22
    return file


@pytest.mark.parametrize("compression", PACK)
@pytest.mark.parametrize(
    ("size", "said"), [(100, "more than 100 bytes"), (len(BOMB), "larger than"), (2**63, "larger than")]
)
def test_a_chunk_that_would_grow_beyond_what_is_read_takes_no_memory(tmp_path, compression, size, said):
    file = chunked(tmp_path / "a.mcap", BOMB, size, compression)
    tracemalloc.start()
    try:
        with pytest.raises(InputError) as caught:
            Stream(file)
        assert said in str(caught.value)
        assert tracemalloc.get_traced_memory()[1] < 2**26
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("compression", PACK)
def test_a_chunk_that_is_what_it_declares_is_read(tmp_path, compression):
    with Stream(chunked(tmp_path / "a.mcap", record(5, bytes(22 + 2**20)), 9 + 22 + 2**20, compression)) as stream:
        assert stream.complete


def test_several_frames_are_bounded_together():
    frames = PACK["zstd"](bytes(1000)) * 3
    assert inflate(frames, 3000) == bytes(3000)
    with pytest.raises(ReaderError, match="more than 2999 bytes"):
        inflate(frames, 2999)
    with pytest.raises(ReaderError, match="ends early"):
        inflate(frames[:-2], 3000)


def test_a_table_whose_messages_are_computed_is_refused(tmp_path):
    file = tmp_path / "a.db3"
    with sqlite3.connect(file) as database:
        database.execute("CREATE TABLE topics(id INTEGER, name TEXT, type TEXT, serialization_format TEXT)")
        database.execute(
            "CREATE TABLE messages(id INTEGER, topic_id INTEGER, timestamp INTEGER, data AS (zeroblob(900000000)))"
        )
        database.execute("INSERT INTO topics VALUES (1, '/a', 'std_msgs/msg/String', 'cdr')")
        database.executemany(
            "INSERT INTO messages(id, topic_id, timestamp) VALUES (?, 1, ?)", [(i, i) for i in range(9)]
        )
    database.close()
    with pytest.raises(InputError, match="table messages computes its values"):
        Stream(file)


ENDLESS = "(WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i FROM n)"


def test_the_copy_of_a_damaged_database_computes_nothing_that_its_names_and_constraints_say(tmp_path):
    file = tmp_path / "a.db3"
    with sqlite3.connect(file) as database:
        database.execute(f'CREATE TABLE "messages"" JOIN {ENDLESS} --" (id INTEGER)')
        database.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY AUTOINCREMENT, CHECK (length(zeroblob(2e9))))")
        database.execute("PRAGMA ignore_check_constraints = ON")
        database.execute("INSERT INTO topics VALUES (7)")
    database.close()
    (tmp_path / "copy").mkdir()
    with sqlite3.connect(salvage(file, tmp_path / "copy")) as copy:
        assert copy.execute("SELECT * FROM topics").fetchall() == [(7,)]
        assert "CHECK" not in "".join(text for (text,) in copy.execute("SELECT sql FROM sqlite_schema"))
    copy.close()


def test_a_database_whose_damage_is_no_text_is_refused_in_one_line(tmp_path):
    folder = written(tmp_path / "bag", StoragePlugin.SQLITE3)
    (file,) = folder.glob("*.db3")
    content = file.read_bytes()
    file.write_bytes(
        content.replace(b"CREATE TABLE schema(\n      schema", b"CREATE TABLE schema(\n     [\xd5\xd5\xd5\xd5\xd5\xd5")
    )
    assert file.read_bytes() != content
    with pytest.raises(InputError, match="malformed database schema"):
        Stream(file)


def test_definitions_and_quality_of_service_are_not_parsed_again(tmp_path):
    folder = written(tmp_path / "bag", StoragePlugin.SQLITE3)
    (file,) = folder.glob("*.db3")
    with sqlite3.connect(file) as database:
        database.execute("UPDATE topics SET offered_qos_profiles = '{'")
    database.close()
    stores = []
    for _ in range(2):
        with Stream(file) as stream:
            assert [message.data for _, _, message in stream.messages(["/a"])] == ["x"]
            stores += stream._types.values()
    assert stores[0] is stores[1]


def written(folder, storage, mode=None):
    """Write a bag with one message."""
    writer = Writer(folder, version=9, storage_plugin=storage)
    if mode is not None:
        writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:
        connection = writer.add_connection("/a", "std_msgs/msg/String", typestore=get_typestore(Stores.ROS2_HUMBLE))
        writer.write(connection, 1, struct.pack("<BBBBI", 0, 1, 0, 0, 2) + b"x\0")
    return folder


def test_chunks_that_would_grow_large_together_are_not_read_at_once(tmp_path):
    folder = written(tmp_path / "bag", StoragePlugin.MCAP)
    with Stream(folder) as stream:
        assert len(list(stream.messages(["/a"]))) == 1
    (file,) = folder.glob("*.mcap")
    data, place, found = bytearray(file.read_bytes()), len(MAGIC), 0
    while place < len(data) - len(MAGIC):
        opcode, length = struct.unpack_from("<BQ", data, place)
        place += 9 + length
        if opcode == 8:  # the index of a chunk ends with the size of the chunk when it is decompressed
            struct.pack_into("<Q", data, place - 8, 2**41)
            found += 1
    assert found
    file.write_bytes(data)
    with Stream(folder) as stream:  # reads chunk by chunk what such an index does not describe
        assert "its chunks would take 2048.0 GiB of memory" in stream.notes[-1]
        assert len(list(stream.messages(["/a"]))) == 1


def test_a_file_that_is_compressed_as_a_whole_is_decompressed_within_bounds(tmp_path, monkeypatch):
    folder = written(tmp_path / "bag", StoragePlugin.SQLITE3, CompressionMode.FILE)
    with Stream(folder) as stream:
        assert len(list(stream.messages(["/a"]))) == 1
    (file,) = folder.glob("*.zstd")
    monkeypatch.setattr(bounds, "FREE", 2**20)
    file.write_bytes(PACK["zstd"](bytes(2**24)))
    with pytest.raises(InputError, match="would grow to more than"):
        Stream(folder)
