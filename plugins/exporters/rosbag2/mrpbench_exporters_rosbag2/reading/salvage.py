"""Makes readable copies of damaged storage files, with the messages before the damage.

Of mcap that is everything up to the last whole record, with a proper end. The format: https://mcap.dev/spec. A file is
magic, records (opcode u1, length u8, content), magic. The end need not have an index; readers then go through it all.
"""

import shutil
import sqlite3
import struct
from contextlib import closing, suppress
from pathlib import Path

from mrpbench_exporters_rosbag2.reading.bounds import COMPUTED, LARGEST

MAGIC = b"\x89MCAP0\r\n"
FOOTER, DATA_END = 0x02, 0x0F
END = struct.pack("<BQI", DATA_END, 4, 0) + struct.pack("<BQQQI", FOOTER, 20, 0, 0, 0) + MAGIC


def salvage(file: Path, folder: Path) -> Path:
    """Return a copy in `folder` with everything that can be read."""
    return _mcap(file, folder) if file.suffix == ".mcap" else _sqlite(file, folder)


def _sqlite(file: Path, folder: Path) -> Path:
    """Copy all tables, row by row until a row cannot be read.

    Of a table's definition only the names are taken: its constraints would be computed in the copy.
    """
    copy = folder / file.name
    with (
        closing(sqlite3.connect(f"{file.resolve().as_uri()}?immutable=1", uri=True)) as old,
        closing(sqlite3.connect(copy, isolation_level=None)) as new,
    ):
        old.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, LARGEST)
        new.execute("PRAGMA journal_mode = OFF")  # an unfinished copy is of no use
        new.execute("PRAGMA synchronous = OFF")
        new.execute("BEGIN")
        computed = {name for (name,) in old.execute(COMPUTED)}
        tables = [
            name
            for (name,) in old.execute("SELECT name FROM sqlite_schema WHERE type = 'table' AND typeof(name) = 'text'")
        ]
        for name in sorted(set(tables) - computed):
            with suppress(sqlite3.Error, UnicodeDecodeError):  # the latter of words about damaged names
                rows = old.execute(f"SELECT * FROM {quoted(name)}")  # noqa: S608 - its own table
                columns = [quoted(column) for column, *_ in rows.description]
                new.execute(f"CREATE TABLE {quoted(name)} ({', '.join(columns)})")
                places = ", ".join("?" * len(columns))
                new.executemany(f"INSERT INTO {quoted(name)} VALUES ({places})", rows)  # noqa: S608
        new.execute("COMMIT")
    return copy


def quoted(name: str) -> str:
    """A name in SQL, whatever characters it has."""
    return '"' + name.replace('"', '""') + '"'


def _mcap(file: Path, folder: Path) -> Path:
    copy = folder / file.name
    shutil.copyfile(file, copy)
    size = copy.stat().st_size
    with copy.open("r+b") as stream:
        end = stream.seek(len(MAGIC))
        while len(head := stream.read(9)) == 9:
            opcode, length = struct.unpack("<BQ", head)
            if opcode in (DATA_END, FOOTER) or end + 9 + length > size:
                break
            end = stream.seek(end + 9 + length)
        stream.seek(end)
        stream.truncate()
        stream.write(END)
    return copy
