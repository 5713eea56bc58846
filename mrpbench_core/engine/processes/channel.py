"""Framed, authenticated messages between two processes over a socket.

A plugin runs in the process that writes, and may write to every descriptor that it inherits. A frame is its length, a
keyed BLAKE2b digest (RFC 7693) of the content, and the content, a JSON object. The receiver refuses everything else, so
that bytes of other origin neither pass for a message nor stop the receiver.
"""

import hashlib
import hmac
import json
import os
import select
import socket
import struct
from collections.abc import Mapping
from typing import Any

LARGEST = 1 << 28
"""Bytes of the largest message."""
KEY_BYTES = 32
_HEADER = struct.Struct("<Q16s")
_CHUNK = 1 << 16


class GarbledError(Exception):
    """The bytes received are no message of the other end."""


class ClosedError(Exception):
    """The other end is closed."""


class Channel:
    """One end of a connection; both ends know the key."""

    def __init__(self, connection: socket.socket, key: bytes) -> None:
        self._socket = connection
        self._key = key
        self._buffer = bytearray()
        self._length: int | None = None
        self._digest = b""

    def fileno(self) -> int:
        """The descriptor, for `select.poll`."""
        return self._socket.fileno()

    def send(self, message: Mapping[str, Any]) -> None:
        """Send a message.

        Raises:
            ClosedError: the other end is closed.
        """
        content = json.dumps(message).encode()
        try:
            self._socket.sendall(_HEADER.pack(len(content), self._sign(content)) + content)
        except OSError as error:
            raise ClosedError from error

    def receive(self, timeout_s: float | None = None) -> dict[str, Any] | None:
        """Return the next message, or None if none is complete in time; wait without limit if `timeout_s` is None.

        Raises:
            GarbledError: what was received is not a message.
            ClosedError: the other end is closed, and everything that it sent was returned.
        """
        while (message := self._next()) is None:
            if timeout_s is not None and not _readable(self._socket, timeout_s):
                return None
            try:
                received = self._socket.recv(_CHUNK)
            except OSError as error:
                raise ClosedError from error
            if not received:
                if self._buffer:
                    raise GarbledError("the last message is incomplete")
                raise ClosedError
            self._buffer += received
        return message

    def close(self) -> None:
        """Close this end."""
        self._socket.close()

    def shut_down(self) -> None:
        """Let both ends read the end of the connection; may be called while another thread receives."""
        try:
            self._socket.shutdown(socket.SHUT_RDWR)
        except OSError:  # the other end did it
            return

    def _next(self) -> dict[str, Any] | None:
        """Remove a complete message from the buffer."""
        if self._length is None:
            if len(self._buffer) < _HEADER.size:
                return None
            self._length, self._digest = _HEADER.unpack(self._buffer[: _HEADER.size])
            del self._buffer[: _HEADER.size]
            if self._length > LARGEST:
                raise GarbledError("the length of a message is impossible")
        if len(self._buffer) < self._length:
            return None
        content = bytes(self._buffer[: self._length])
        del self._buffer[: self._length]
        self._length = None
        if not hmac.compare_digest(self._digest, self._sign(content)):
            raise GarbledError("a message is not signed")
        try:
            message = json.loads(content)
        except (ValueError, RecursionError) as error:
            raise GarbledError("a message is no JSON") from error
        if not isinstance(message, dict):
            raise GarbledError("a message is not an object")
        return message

    def _sign(self, content: bytes) -> bytes:
        return hashlib.blake2b(content, key=self._key, digest_size=16).digest()


def new_key() -> bytes:
    """A key for one connection."""
    return os.urandom(KEY_BYTES)


def _readable(connection: socket.socket, timeout_s: float) -> bool:
    poll = select.poll()
    poll.register(connection, select.POLLIN)
    return bool(poll.poll(timeout_s * 1000))
