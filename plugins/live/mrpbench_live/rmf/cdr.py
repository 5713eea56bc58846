"""Writes and reads messages as plain CDR, which ROS 2 sends, in less than half the time that cyclonedds takes.

cyclonedds walks through a message value by value in Python; here all numbers that follow one another are one call of
`struct`. Representation: OMG DDS-XTypes 1.3, 7.4.3 (XCDR version 1, final types): numbers are aligned to their size,
counted from the end of the header; a string is its length with the final NUL, and its bytes; a sequence is its length,
and its elements.
"""

import struct
from collections.abc import Callable, Mapping, Sequence
from operator import attrgetter
from typing import Any, Protocol

HEADER = b"\x00\x01\x00\x00"
"""Of plain CDR in little-endian order."""
CODES = {"uint8": "B", "int32": "i", "uint32": "I", "int64": "q", "uint64": "Q", "float32": "f", "float64": "d"}
"""The code of each type of numbers in `struct`."""


class Step(Protocol):
    """Writes and reads some values that follow one another."""

    count: int
    """How many."""

    def write(self, parts: list[bytes], size: int, values: Sequence[Any]) -> int:
        """Append values to parts that are so many bytes long; return how many they are then."""
        ...

    def read(self, data: bytes, at: int, values: list[Any]) -> int:
        """Append the values that begin after so many bytes; return where they end."""
        ...


class _Numbers:
    """Numbers that follow one another."""

    def __init__(self, codes: str) -> None:
        self.codes, self.count = codes, len(codes)
        self._at = [struct.Struct(_aligned(codes, begin)) for begin in range(8)]
        """By where they begin, modulo 8."""

    def write(self, parts: list[bytes], size: int, values: Sequence[Any]) -> int:
        packed = self._at[size & 7]
        parts.append(packed.pack(*values))
        return size + packed.size

    def read(self, data: bytes, at: int, values: list[Any]) -> int:
        packed = self._at[at & 7]
        values += packed.unpack_from(data, at)
        return at + packed.size


class _Text:
    """One string."""

    count = 1

    def write(self, parts: list[bytes], size: int, values: Sequence[Any]) -> int:
        encoded = values[0].encode()
        begin = -size & 3
        parts.append(bytes(begin) + (len(encoded) + 1).to_bytes(4, "little") + encoded + b"\0")
        return size + begin + 5 + len(encoded)

    def read(self, data: bytes, at: int, values: list[Any]) -> int:
        begin = at + (-at & 3) + 4
        end = begin + int.from_bytes(data[begin - 4 : begin], "little")
        values.append(data[begin : end - 1].decode())
        return end


class _Elements:
    """One list: a sequence, or an array of a fixed `size`."""

    count = 1

    def __init__(self, codec: "Step | Codec", size: int | None) -> None:
        self._codec, self._size = codec, size

    def write(self, parts: list[bytes], size: int, values: Sequence[Any]) -> int:
        (elements,) = values
        if self._size is None:
            begin = -size & 3
            parts.append(bytes(begin) + len(elements).to_bytes(4, "little"))
            size += begin + 4
        codec = self._codec
        if isinstance(codec, Codec):
            for element in elements:
                size = codec.write(parts, size, element)
        elif isinstance(codec, _Numbers):
            size = _Numbers(codec.codes * len(elements)).write(parts, size, elements) if elements else size
        else:
            for element in elements:
                size = codec.write(parts, size, (element,))
        return size

    def read(self, data: bytes, at: int, values: list[Any]) -> int:
        length = self._size
        if length is None:
            at += (-at & 3) + 4
            length = int.from_bytes(data[at - 4 : at], "little")
        elements: list[Any] = []
        codec = self._codec
        for _ in range(length):
            if isinstance(codec, Codec):
                element, at = codec.read(data, at)
                elements.append(element)
            else:
                at = codec.read(data, at, elements)
        values.append(elements)
        return at


class Codec:
    """Writes and reads the messages of one type.

    Args:
        make: the type, called with the values of all fields in order.
        fields: type, array (None: a single value), bound and size of each, as in files of definitions.
        codecs: of the other types that it uses.
    """

    def __init__(self, make: Any, fields: Mapping[str, Mapping[str, Any]], codecs: Mapping[str, "Codec"]) -> None:
        self._make, self._fields, self._codecs = make, fields, codecs
        self._steps: list[Step] = []
        self._paths: list[str] = []
        """The attributes of a message whose values follow one another, also within messages in it."""
        self._arrays: list[int] = []
        """The indices of those that are arrays of numbers."""
        self._build = self._builder(self, "", [0])
        get = attrgetter(*self._paths)
        self._get: Callable[[Any], tuple[Any, ...]] = get if len(self._paths) > 1 else lambda message: (get(message),)

    def serialize(self, message: Any) -> bytes:
        """Return a message with its header."""
        parts = [HEADER]
        self.write(parts, 0, message)
        return b"".join(parts)

    def deserialize(self, data: bytes) -> Any:
        """Return the message of some bytes with their header."""
        return self.read(data[len(HEADER) :], 0)[0]

    def write(self, parts: list[bytes], size: int, message: Any) -> int:
        """Append a message to parts that are so many bytes long; return how many they are then."""
        values: Sequence[Any] = self._get(message)
        for index in reversed(self._arrays):
            values = (*values[:index], *values[index], *values[index + 1 :])
        at = 0
        for step in self._steps:
            size = step.write(parts, size, values[at : at + step.count])
            at += step.count
        return size

    def read(self, data: bytes, at: int) -> tuple[Any, int]:
        """Return the message that begins after so many bytes, and where it ends."""
        values: list[Any] = []
        for step in self._steps:
            at = step.read(data, at, values)
        return self._build(values), at

    def _builder(self, codec: "Codec", path: str, at: list[int]) -> Callable[[list[Any]], Any]:
        """Add the steps of a message; return what makes it of all values, of which its own begin at `at`, a counter."""
        makers = [self._maker(f"{path}{name}", field, at) for name, field in codec._fields.items()]
        make = codec._make
        return lambda values: make(*[maker(values) for maker in makers])

    def _maker(self, path: str, field: Mapping[str, Any], at: list[int]) -> Callable[[list[Any]], Any]:
        """Add the steps of a field; return what finds its value among all values."""
        kind, inner, begin = field["type"], self._codecs.get(field["type"]), at[0]
        size = int(field["size"]) if field["size"] and not field["bound"] else None
        if field["array"] is None and inner is not None:
            return self._builder(inner, f"{path}.", at)
        self._paths.append(path)
        if field["array"] is not None and size is not None and kind in CODES:
            self._arrays.append(len(self._paths) - 1)
            list_of = bytes if kind == "uint8" else list  # as cyclonedds has them
            self._add_numbers(CODES[kind] * size)
            at[0] = end = begin + size
            return lambda values: list_of(values[begin:end])
        if field["array"] is not None:
            self._steps.append(_Elements(inner or (_Numbers(CODES[kind]) if kind in CODES else _Text()), size))
        elif kind in CODES:
            self._add_numbers(CODES[kind])
        else:
            self._steps.append(_Text())
        at[0] += 1
        return lambda values: values[begin]

    def _add_numbers(self, codes: str) -> None:
        if self._steps and isinstance(before := self._steps[-1], _Numbers):
            self._steps[-1] = _Numbers(before.codes + codes)
        else:
            self._steps.append(_Numbers(codes))


def _aligned(codes: str, begin: int) -> str:
    """Return the format of numbers that begin after so many bytes, with the bytes by which they are aligned."""
    aligned = ["<"]
    for code in codes:
        size = struct.calcsize(f"<{code}")
        aligned.append("x" * (-begin % size) + code)
        begin += -begin % size + size
    return "".join(aligned)
