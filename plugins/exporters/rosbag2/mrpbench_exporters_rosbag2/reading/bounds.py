"""Bounds what rosbags decompresses and what SQLite computes, so that a small bag cannot fill memory or disk.

rosbags decompresses a chunk of mcap (https://mcap.dev/spec) or a message whole, and compares sizes afterwards.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import IO, Any

import rosbags.rosbag2.reader
import rosbags.rosbag2.storage_mcap
import rosbags.rosbag2.storage_sqlite3
from lz4.frame import LZ4FrameDecompressor  # type: ignore[import-untyped]
from rosbags.interfaces import Nodetype
from rosbags.rosbag2 import Reader, ReaderError

LARGEST = 2**28
"""Bytes of one decompressed chunk or message."""
LONGEST, ENTRIES = 2**18, 1000
"""Characters of the definition of a type, and entries of its arrays of fixed size that are texts or messages."""
RATIO, FREE = 200, 2**30
"""A bag may grow to `FREE` bytes and `RATIO` times its own."""
COMPUTED = """
SELECT m.name FROM sqlite_master m JOIN pragma_table_list l ON l.name = m.name WHERE l.type NOT IN ('table', 'shadow')
UNION ALL
SELECT m.name FROM sqlite_master m JOIN pragma_table_xinfo(m.name) x WHERE m.type = 'table' AND x.hidden <> 0
"""
"""Names tables whose values are not stored: views, virtual tables, and those with generated columns."""

_READER: Any = rosbags.rosbag2.reader
_MCAP: Any = rosbags.rosbag2.storage_mcap
_SQLITE: Any = rosbags.rosbag2.storage_sqlite3


def bound() -> None:
    """Let rosbags decompress and read within bounds in this process, and only what is used here."""
    _MCAP.DECOMPRESSORS.update({"lz4": _lz4, "zstd": inflate})
    _READER.zstd = _Zstd
    _READER.parse_qos = _MCAP.parse_qos = _SQLITE.parse_qos = _no_qos  # it compares what these read
    if _check_database not in _SQLITE.apsw.connection_hooks:
        _SQLITE.apsw.connection_hooks.append(_check_database)


def check_index(reader: Reader) -> None:
    """Check the declared sizes of the chunks of an open bag: rosbags may hold all of them at once.

    Raises:
        ReaderError: together they are too large.
    """
    for storage in getattr(reader.storage, "storages", [reader.storage]):
        size = sum(chunk.uncompressed_size for chunk in getattr(storage, "chunks", ()))
        if size > allowed(Path(storage.path)):
            raise ReaderError(f"its chunks would take {size / 2**30:.1f} GiB of memory")


def check_definition(text: str, types: Mapping[str, Any]) -> None:
    """Check the definition of a message type: rosbags writes code for each entry of an array of texts or messages.

    Raises:
        ReaderError: it is too long, or its arrays are.
    """
    if len(text) > LONGEST:
        raise ReaderError(f"its definition has {len(text)} characters, and {LONGEST} are read")
    fields = [kind for _, own in types.values() for _, kind in own]
    arrays = [of for kind, of in fields if kind == Nodetype.ARRAY]
    written = sum(length for (kind, of), length in arrays if kind == Nodetype.NAME or of[0] == "string")
    if written > ENTRIES:
        raise ReaderError(f"its arrays have {written} entries that are texts or messages, and {ENTRIES} are read")


def allowed(file: Path) -> int:
    """Bytes to which a file may grow."""
    return FREE + RATIO * file.stat().st_size


def inflate(data: bytes, largest: int = LARGEST) -> bytes:
    """Decompress zstd frames.

    Raises:
        ReaderError: the content is larger than `largest` or `LARGEST`.
    """
    largest = _within(largest)
    inflated = bytearray()
    while data:
        frame = _MCAP.zstd.ZstdDecompressor()
        inflated += frame.decompress(data, largest + 1 - len(inflated))
        if len(inflated) > largest:
            raise ReaderError(f"more than {largest} bytes are compressed in one place")
        if not frame.eof:
            raise ReaderError("a compressed part ends early")
        data = frame.unused_data
    return bytes(inflated)


def _no_qos(_text: str) -> list[Any]:
    """Leave out the quality of service of a topic, which nothing here uses: rosbags takes 10 ms for its YAML."""
    return []


def _lz4(data: bytes, largest: int) -> bytes:
    frame = LZ4FrameDecompressor()
    inflated: bytes = frame.decompress(data, max_length=_within(largest) + 1)
    if len(inflated) > largest:
        raise ReaderError(f"more than {largest} bytes are compressed in one place")
    return inflated


def _within(size: int) -> int:
    if not 0 <= size <= LARGEST:
        raise ReaderError(f"a chunk of {size} bytes is larger than the {LARGEST} that are read")
    return size


def _check_database(connection: Any) -> None:
    connection.limit(_SQLITE.apsw.SQLITE_LIMIT_LENGTH, LARGEST)
    for (name,) in connection.execute(COMPUTED):
        raise ReaderError(f"the table {name} computes its values")


class _Zstd:
    """What `rosbags.rosbag2.reader` uses of zstd: whole files and messages."""

    decompress = staticmethod(inflate)

    @staticmethod
    def open(file: IO[bytes], mode: str) -> Any:
        opened = _MCAP.zstd.open(file, mode)
        most, read, total = allowed(Path(file.name)), opened.read, 0

        def bounded(size: int = -1) -> bytes:
            nonlocal total
            content: bytes = read(size)
            total += len(content)
            if total > most:
                raise ReaderError(f"{file.name} would grow to more than {most} bytes")
            return content

        opened.read = bounded
        return opened
