"""The message types of Open-RMF, made from a file of definitions as ROS 2 writes them."""

import re
import time
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from mrpbench_core.api import InputError
from mrpbench_live.rmf.cdr import HEADER as PLAIN
from mrpbench_live.rmf.cdr import Codec

DEFINITIONS = Path(__file__).with_name("definitions.txt")
"""The definitions that this distribution brings."""
HINT = "pip install 'mrpbench-live[rmf]'"
FIELD = re.compile(
    r"(?P<type>[a-z0-9_]+(/[A-Za-z0-9]+)?)(?P<array>\[(?P<bound><=)?(?P<size>\d*)\])? (?P<name>[a-z0-9_]+)"
)
NUMBERS = "uint8", "int32", "uint32", "int64", "uint64", "float32", "float64"

CODE_UNKNOWN_DESTINATION, CODE_TEMPORARILY_UNREACHABLE, CODE_UNREACHABLE = 1001, 1002, 1004
CODE_INCOMPATIBLE_CONSTRAINT = 1005
"""Codes of `DestinationError`."""
CODE_REPLAN_REQUEST, CODE_PATH_BLOCKED, CODE_UNRECOGNIZED_ACTION = 2001, 2002, 2003
"""Codes of `PlanError`."""
HINT_POINT = 1
"""Of `Region`: it is one point."""

PlanKey = tuple[bytes, int, int]
"""What tells plans apart: destination session, MAPF session (0 where the definitions have none), version."""


class Messages:
    """The types of one file of definitions.

    Args:
        path: of the file.

    Raises:
        InputError: it cannot be read, or cyclonedds is missing.
    """

    def __init__(self, path: Path) -> None:
        idl, self._types = _library(path)
        self._fields: dict[str, dict[str, Any]] = {}
        self._made: dict[str, Any] = {}
        codecs: dict[str, Codec] = {}
        for name, fields in _read(path).items():
            package, short = name.split("/")
            kinds = {field: self._kind(kind) for field, kind in fields.items()}
            self._made[name] = idl.make_idl_struct(short, f"{package}::msg::dds_::{short}_", kinds)
            self._fields[name] = fields
            codecs[name] = Codec(self._made[name], fields, codecs)
            _use(codecs[name], self._made[name])

    def type(self, name: str) -> Any:
        """Return the type of messages such as `rmf_prototype_msgs/Plan`."""
        return self._made[name]

    def new(self, name: str, /, **values: Any) -> Any:
        """Return a message; fields that are not given are zero or empty, those that it does not have are left out."""
        fields = self._fields[name].items()
        given = {field: values[field] if field in values else self._empty(kind) for field, kind in fields}
        return self._made[name](**given)

    def _empty(self, field: Mapping[str, Any]) -> Any:
        if field["array"] is None:
            return self._empty_of(field["type"])
        fixed = field["size"] and not field["bound"]
        return [self._empty_of(field["type"]) for _ in range(int(field["size"]))] if fixed else []

    def _empty_of(self, kind: str) -> Any:
        if kind == "string":
            return ""
        return self.new(kind) if "/" in kind else (0.0 if kind.startswith("float") else 0)

    def _kind(self, field: Mapping[str, Any]) -> Any:
        """The type of a field in the words of cyclonedds."""
        base = field["type"]
        kind = str if base == "string" else self._made[base] if "/" in base else getattr(self._types, base)
        if field["array"] is None:
            return kind
        size = int(field["size"] or 0)
        if field["bound"]:
            return self._types.sequence[kind, size]
        return self._types.array[kind, size] if size else self._types.sequence[kind]


def _use(codec: Codec, made: Any) -> None:
    """Let a type of cyclonedds write and read plain CDR by a codec, and all else as before."""
    serialize, deserialize = made.serialize, made.deserialize

    def write(message: Any, buffer: Any = None, endianness: Any = None, use_version_2: bool | None = None) -> bytes:
        if use_version_2 is False and buffer is endianness is None:
            return codec.serialize(message)
        found: bytes = serialize(message, buffer, endianness, use_version_2)
        return found

    def read(data: bytes, has_header: bool = True, use_version_2: bool | None = None) -> Any:
        if has_header and data[:2] == PLAIN[:2]:
            return codec.deserialize(data)
        return deserialize(data, has_header, use_version_2)

    made.serialize, made.deserialize = write, staticmethod(read)


def _library(path: Path) -> tuple[Any, Any]:
    try:
        from cyclonedds import idl
        from cyclonedds.idl import types
    except ImportError as error:
        raise InputError(f"rmf: cyclonedds cannot be imported: {error}", hint=HINT) from error
    if not path.is_file():
        raise InputError(f"{path}: there is no such file of message definitions")
    return idl, types


def _read(path: Path) -> dict[str, dict[str, Any]]:
    """The fields of each message of a file; a message uses only those before it."""
    found: dict[str, dict[str, Any]] = {}
    fields: dict[str, Any] | None = None
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        text = line.partition("#")[0].strip()
        if text.startswith("MSG: "):
            fields = found[text[5:]] = {}
        elif text:
            match = FIELD.fullmatch(text)
            known = match is not None and (match["type"] in (*NUMBERS, "string") or match["type"] in found)
            if match is None or fields is None or not known:
                raise InputError(
                    f"{path}:{number}: expected `MSG: package/Name` or a field of a known type, got {text!r}"
                )
            fields[match["name"]] = match.groupdict()
    return found


@cache
def messages_of(path: str) -> Messages:
    """Return the types of a file of definitions; empty: those that this distribution brings."""
    return Messages(Path(path) if path else DEFINITIONS)


def plan_key(plan_id: Any) -> PlanKey:
    """Return what tells a `PlanId` from others."""
    session = bytes(plan_id.destination_session.uuid)
    return session, int(getattr(plan_id, "mapf_session", 0)), int(plan_id.plan_version)


def stamp(messages: Messages) -> Any:
    """Return the time now, as ROS 2 counts it without a simulated clock."""
    seconds, nanoseconds = divmod(time.time_ns(), 10**9)
    return messages.new("builtin_interfaces/Time", sec=seconds, nanosec=nanoseconds)
