"""Reads the messages of a bag in the order of recording, up to the first damage."""

from collections.abc import Collection, Iterable, Iterator
from contextlib import ExitStack, suppress
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rosbags.interfaces import Connection, MessageDefinitionFormat
from rosbags.rosbag2 import Reader, ReaderError
from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from mrpbench_core.files.errors import InputError
from mrpbench_exporters_rosbag2.messages import TYPES
from mrpbench_exporters_rosbag2.reading.bounds import bound, check_definition, check_index
from mrpbench_exporters_rosbag2.reading.salvage import salvage

STORAGES = (".mcap", ".db3")
IDL_SEPARATOR = "=" * 80 + "\n"
STAMPS = 2**63
"""Bound of log times, nanoseconds."""


class Stream:
    """A bag that is open for reading; a context manager."""

    def __init__(self, path: Path) -> None:
        """Open a bag's folder, or one storage file.

        Raises:
            InputError: nothing of it can be read.
        """
        self.path = path
        self.notes: list[str] = []
        self.complete = True
        """False where something could not be read."""
        self._stack = ExitStack()
        self._types: dict[str, Typestore | None] = {}
        try:
            self.readers = self._open()
        except BaseException:
            self._stack.close()
            raise

    def __enter__(self) -> "Stream":
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()

    @property
    def topics(self) -> dict[str, str]:
        """Message type (`nav_msgs/msg/Odometry`) of each topic that has messages."""
        return {connection.topic: connection.msgtype for connection in self._connections() if connection.msgcount}

    def messages(self, topics: Collection[str]) -> Iterator[tuple[str, int, Any]]:
        """Yield topic, log time (nanoseconds) and message; `notes` says what cannot be read."""
        for reader in self.readers:
            wanted = [
                candidate
                for candidate in reader.connections
                if candidate.topic in topics and self._definition(candidate)
            ]
            count = 0
            try:
                for connection, stamp, data in reader.messages(wanted) if wanted else ():
                    store = self._definition(connection)
                    assert store is not None
                    if not _is_time(stamp):
                        raise ReaderError("a message has no time")
                    message = store.deserialize_cdr(data, connection.msgtype)
                    count += 1
                    yield connection.topic, stamp, message
            except Exception as error:  # noqa: BLE001 - of zstd, SQLite, struct, …: whatever damaged bytes lead to
                self.complete = False
                self.notes.append(
                    f"{Path(str(reader.path)).name} is damaged ({_words(error)}): of what is wanted, only the first "
                    f"{count} messages can be read"
                )

    def _connections(self) -> list[Connection]:
        return [connection for reader in self.readers for connection in reader.connections]

    def _definition(self, connection: Connection) -> Typestore | None:
        """Return the type store of a connection: the bag's own definition, or that of ROS 2 with this name."""
        name = connection.msgtype
        if name not in self._types:
            self._types[name] = self._find(connection)
        return self._types[name]

    def _find(self, connection: Connection) -> Typestore | None:
        name, definition = connection.msgtype, connection.msgdef
        if definition.format in (MessageDefinitionFormat.MSG, MessageDefinitionFormat.IDL):
            try:
                return _store(name, definition.format, definition.data)
            except Exception as error:  # noqa: BLE001 - a parser's error about text from the bag
                self.notes.append(f"{connection.topic}: its type {name} is not understood ({_words(error)})")
                return None
        if name in TYPES.fielddefs:
            return TYPES
        self.notes.append(f"{connection.topic}: the bag does not define its type {name}, so it was not read")
        return None

    def _open(self) -> list[Reader]:
        if not self.path.exists():
            raise InputError("there is no such bag", file=self.path)
        try:
            return [self._reader(self.path)]
        except InputError as error:
            reason = error.message
            files = [self.path] if self.path.is_file() else sorted(self.path.iterdir())
            files = [file for file in files if file.suffix in STORAGES]
            if not files:
                if (self.path / "metadata.yaml").is_file():
                    raise
                raise InputError(
                    "is not a rosbag2", file=self.path, hint="give the folder with metadata.yaml"
                ) from error
        readers = []
        for file in files:
            if file != self.path:
                try:
                    readers.append(self._reader(file))
                    self.notes.append(f"read without metadata.yaml ({reason})")
                    continue
                except InputError as error:
                    reason = error.message
            with suppress(Exception):  # as in `messages`
                copy = salvage(file, Path(self._stack.enter_context(TemporaryDirectory())))
                readers.append(self._reader(copy))
                self.complete = False
                self.notes.append(f"{file.name} is damaged ({reason}): what is before the damage was read")
        if not readers:
            raise InputError(f"nothing of it can be read: {reason}", file=self.path)
        return readers

    def _reader(self, path: Path) -> Reader:
        try:
            bound()
            reader = Reader(path)
            self._stack.enter_context(reader)
            check_index(reader)
            texts: Iterable[Any] = ((c.topic, c.msgtype, c.msgdef.data) for c in reader.connections)
            if not all(isinstance(text, str) for named in texts for text in named):  # SQLite keeps what it is given
                raise ReaderError("a topic has no name or no type")
        except Exception as error:  # as in `messages`
            raise InputError(_words(error), file=path) from error
        return reader


@lru_cache(maxsize=64)
def _store(name: str, kind: MessageDefinitionFormat, text: str) -> Typestore:
    """The types that a definition of the type `name` names; bags of the same robots have the same ones."""
    if kind == MessageDefinitionFormat.MSG:
        types = get_types_from_msg(text, name)
    else:
        types = {}
        for part in filter(str.strip, text.split(IDL_SEPARATOR)):
            types |= get_types_from_idl(part.partition("\n")[2] if part.startswith("IDL: ") else part)
    check_definition(text, types)
    store = get_typestore(Stores.EMPTY)
    store.register(types)
    return store


def _is_time(stamp: Any) -> bool:
    return isinstance(stamp, int) and -STAMPS <= stamp < STAMPS


def _words(error: Exception) -> str:
    return " ".join(str(error).split())[:200].rstrip(".") or type(error).__name__
