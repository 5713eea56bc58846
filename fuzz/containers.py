"""Changes what zips, MCAP files and SQLite databases hold, so that checksums, offsets and pages stay right."""

import random
import sqlite3
import struct
import zlib
from collections.abc import Sequence
from contextlib import closing

from mrpbench_exporters_rosbag2.reading.salvage import quoted
from mutation import Mutate, mutate_bytes, mutate_text

_LOCAL, _CENTRAL, _END = struct.Struct("<4s5H3I2H"), struct.Struct("<4s6H3I5H2I"), struct.Struct("<4s4H2IH")
STORED, DEFLATED = 0, 8


def zipped(files: Sequence[tuple[str, bytes]]) -> bytes:
    """A zip of files by name, not compressed; a name may occur twice. `zipfile` takes ten times as long."""
    out, directory = bytearray(), bytearray()
    for name, content in files:
        path, begin, size = name.encode(errors="replace")[: 2**16 - 1], len(out), len(content)
        sums = (STORED, 0, 0x21, zlib.crc32(content), size, size, len(path), 0)
        directory += _CENTRAL.pack(b"PK\1\2", 20, 20, 0x800, *sums, 0, 0, 0, 0, begin) + path
        out += _LOCAL.pack(b"PK\3\4", 20, 0x800, *sums) + path + content
    end = _END.pack(b"PK\5\6", 0, 0, len(files), len(files), len(directory), len(out), 0)
    return bytes(out + directory + end)


def unzipped(data: bytes) -> list[tuple[str, bytes]]:
    """The files of a zip.

    Raises:
        ValueError: it is none.
    """
    files = []
    try:
        _, _, _, _, count, _, at, _ = _END.unpack_from(data, data.rindex(b"PK\5\6"))
        for _ in range(count):
            _, _, _, _, method, _, _, _, size, _, named, extra, comment, *_, begin = _CENTRAL.unpack_from(data, at)
            at += _CENTRAL.size
            name = data[at : at + named].decode(errors="replace")
            at += named + extra + comment
            *_, named, extra = _LOCAL.unpack_from(data, begin)
            begin += _LOCAL.size + named + extra
            content = data[begin : begin + size]
            files.append((name, zlib.decompress(content, -15) if method == DEFLATED else content))
    except (struct.error, zlib.error) as error:
        raise ValueError(str(error)) from error
    return files


def in_zip(mutate: Mutate) -> Mutate:
    """Change the content, the name or the number of the files in a zip; sometimes the bytes of the zip itself."""

    def changed(data: bytes, rng: random.Random) -> bytes:
        try:
            files = unzipped(data)
        except ValueError:  # an earlier change broke it
            files = []
        if not files or rng.random() < 0.05:
            return mutate_bytes(data, rng)
        for _ in range(rng.choice((1, 1, 2))):
            if not files:
                break
            place = rng.randrange(len(files))
            name, content = files[place]
            match rng.randrange(12):
                case 0:
                    del files[place]
                case 1:
                    files[place] = name, rng.choice(files)[1]
                case 2:
                    files.append((rng.choice(files)[0].replace("0", "1"), content))
                case _:
                    files[place] = name, mutate(content, rng)
        return zipped(files)

    return changed


MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, DATA_END = 0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x0F
_CHUNK = struct.Struct("<QQQI")  # first and last time, size, checksum; then compression and records with their lengths


def mutate_mcap(data: bytes, rng: random.Random) -> bytes:
    """Change a record of an MCAP file (https://mcap.dev/spec), in its place or in a file without an index."""
    try:
        spans = _records(data, len(MAGIC), len(data) - len(MAGIC))
    except struct.error:  # an earlier change broke it
        spans = []
    if not spans or rng.random() < 0.1:
        return mutate_bytes(data, rng)
    if rng.random() < 0.6:
        return _overwritten(data, [span for span in spans if span[0] != CHUNK], rng)
    return _rebuilt(data, spans, rng)


def _records(data: bytes, begin: int, end: int) -> list[tuple[int, int, int]]:
    """Opcode, begin and end of the content of each record, a chunk before what is in it."""
    spans = []
    while begin + 9 <= end:
        opcode, length = struct.unpack_from("<BQ", data, begin)
        if begin + 9 + length > end:
            raise struct.error("a record ends late")
        begin += 9
        spans.append((opcode, begin, begin + length))
        if opcode == CHUNK:
            (named,) = struct.unpack_from("<I", data, begin + _CHUNK.size)
            if not named:  # not compressed
                spans += _records(data, begin + _CHUNK.size + 4 + 8, begin + length)
        begin += length
    return spans


def _overwritten(data: bytes, spans: list[tuple[int, int, int]], rng: random.Random) -> bytes:
    """A few bytes of a record of a kind replaced by as many others: all offsets remain."""
    out = bytearray(data)
    for _ in range(rng.choice((1, 1, 2, 3))):
        kind = rng.choice(sorted({opcode for opcode, *_ in spans}))
        _, begin, end = rng.choice([span for span in spans if span[0] == kind])
        if begin == end:
            continue
        place = rng.randrange(begin, end)
        size = min(rng.choice((1, 1, 2, 4, 8)), end - place)
        number = rng.choice((0, 1, 2, 0x7F, 0x80, 0xFF, 2**31 - 1, 2**63 - 1, 2**64 - 1, rng.randrange(2**64)))
        out[place : place + size] = number.to_bytes(8, "little")[:size]
    return bytes(out)


def _rebuilt(data: bytes, spans: list[tuple[int, int, int]], rng: random.Random) -> bytes:
    """Header, schemas, channels and messages, one of which is changed, dropped, repeated or moved."""
    found = [(opcode, data[begin:end]) for opcode, begin, end in spans if opcode in (HEADER, SCHEMA, CHANNEL, MESSAGE)]
    for _ in range(rng.choice((1, 1, 2))):
        if not found:
            break
        kind = rng.choice(sorted({opcode for opcode, _ in found}))
        place = rng.choice([number for number, (opcode, _) in enumerate(found) if opcode == kind])
        opcode, content = found[place]
        match rng.randrange(8):
            case 0:
                del found[place]
            case 1:
                found.insert(rng.randrange(len(found)), found[place])
            case 2:
                found[place] = opcode, rng.choice(found)[1]
            case _:
                begin = {HEADER: 0, SCHEMA: 2, CHANNEL: 4}.get(opcode)
                found[place] = opcode, mutate_bytes(content, rng) if begin is None else _texts(content, begin, rng)
    return indexless(found)


def _texts(content: bytes, begin: int, rng: random.Random) -> bytes:
    """Change one of the texts with lengths with which a record ends."""
    head, rest, parts = content[:begin], content[begin:], []
    while len(rest) >= 4:
        size = int.from_bytes(rest[:4], "little")
        parts.append(rest[4 : 4 + size])
        rest = rest[4 + size :]
    if not parts:
        return mutate_bytes(content, rng)
    place = rng.randrange(len(parts))
    parts[place] = mutate_text(parts[place], rng)
    return head + b"".join(len(part).to_bytes(4, "little") + part for part in parts) + rest


def indexless(records: Sequence[tuple[int, bytes]]) -> bytes:
    """An MCAP file of records without chunks and without an index."""
    footer = (DATA_END, bytes(4)), (FOOTER, bytes(20))
    return MAGIC + b"".join(struct.pack("<BQ", kind, len(part)) + part for kind, part in (*records, *footer)) + MAGIC


def mutate_database(data: bytes, rng: random.Random) -> bytes:
    """Change a value, the rows or the definition of a table of an SQLite database; sometimes its bytes."""
    if rng.random() < 0.2:
        return mutate_bytes(data, rng)
    try:
        with closing(sqlite3.connect(":memory:", isolation_level=None)) as database:
            database.deserialize(data)
            database.execute("PRAGMA writable_schema = ON")
            _change(database, rng)
            return database.serialize()
    except Exception:  # noqa: BLE001 - an earlier change broke it, or there is nothing to change
        return mutate_bytes(data, rng)


def _change(database: sqlite3.Connection, rng: random.Random) -> None:
    """Change one row of a table."""
    names = [name for (name,) in database.execute("SELECT name FROM sqlite_schema WHERE typeof(name) = 'text'")]
    table = quoted(rng.choice([*names, "sqlite_schema"]))
    columns = [quoted(name) for _, name, *_ in database.execute(f"PRAGMA table_info({table})")]
    one, other = rng.choice(columns), rng.choice(columns)
    value, row = rng.choice(database.execute(f"SELECT {one}, rowid FROM {table}").fetchall())  # noqa: S608
    match rng.randrange(8):
        case 0:
            database.execute(f"DELETE FROM {table} WHERE rowid = ?", (row,))  # noqa: S608
        case 1:
            database.execute(f"UPDATE {table} SET {one} = {other} WHERE rowid = ?", (row,))  # noqa: S608
        case 2 if table != '"sqlite_schema"':
            database.execute(f"ALTER TABLE {table} RENAME COLUMN {one} TO {other}")
        case _:
            database.execute(f"UPDATE {table} SET {one} = ? WHERE rowid = ?", (_other(value, rng), row))  # noqa: S608


def _other(value: object, rng: random.Random) -> object:
    if rng.random() < 0.1:
        return rng.choice((None, 0, -1, 1.5, float("inf"), "", "x", b"", b"\xff", 2**63 - 1, -(2**63)))
    if isinstance(value, str):
        return mutate_text(value.encode(), rng).decode(errors="replace")
    if isinstance(value, bytes):
        return mutate_bytes(value, rng)
    return rng.choice((0, 1, -1, 2, 2**31, 2**63 - 1, -(2**63), 1.5, None))
