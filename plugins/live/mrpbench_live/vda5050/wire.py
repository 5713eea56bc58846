"""MQTT: one connection for each vehicle, because each has its own last will; all in one loop, without threads."""

import os
import selectors
import socket
import time
from collections.abc import Callable
from typing import Any
from urllib.parse import urlsplit

import attrs

from mrpbench_core.api import InputError
from mrpbench_live.vda5050.schemas import HINT

PASSWORD = "MRPBENCH_MQTT_PASSWORD"  # noqa: S105 - the name of a variable
"""Environment variable with the password of the user that a URL names."""
RETRY_S, PATIENCE_S, KEEPALIVE_S = 0.5, 2.0, 30
"""Seconds between attempts to connect again; for a TCP connection; and until the broker takes a client for lost."""
MISC_S = 1.0
"""Seconds between looks at the keepalive of a client."""
CONNECTING_S = 0.01
"""Seconds at a time in which clients connect again: a thousand of them take seconds."""
LEAST_S = 0.01
"""Seconds for which messages that wait are received although it is time for something else."""
Take = Callable[[str, bytes], None]
"""Called with the topic and the payload of each message."""


@attrs.frozen(kw_only=True)
class Broker:
    """Where a broker is."""

    host: str
    port: int
    user: str | None
    encrypted: bool

    @classmethod
    def of(cls, url: str) -> "Broker":
        """Read `mqtt://host:1883` or `mqtts://user@host:8883`.

        Raises:
            InputError: it is no such URL.
        """
        parts = urlsplit(url)
        try:
            port = parts.port
        except ValueError:
            port = -1
        if parts.scheme not in ("mqtt", "mqtts") or not parts.hostname or port == -1 or parts.path.strip("/"):
            raise InputError(f"{url}: expected mqtt://HOST:PORT or mqtts://USER@HOST:PORT")
        if parts.password is not None:
            raise InputError(f"a URL with a password would be recorded: put it into the variable {PASSWORD}")
        encrypted = parts.scheme == "mqtts"
        return cls(
            host=parts.hostname, port=port or (8883 if encrypted else 1883), user=parts.username, encrypted=encrypted
        )


class Client:
    """The connection of one vehicle or control.

    Args:
        wire: that serves it.
        name: of the client; a broker cuts off an older client of the same name.
        will: topic and payload that the broker sends when the connection breaks.
        topics: to subscribe to.
        online: called each time when it is connected.
        take: called with messages.
    """

    def __init__(
        self,
        wire: "Wire",
        name: str,
        will: tuple[str, bytes] | None,
        topics: tuple[str, ...],
        online: Callable[[], None],
        take: Take,
    ) -> None:
        self._wire, self._topics, self._online, self._take = wire, topics, online, take
        self.connected = False
        self.ended = False
        self.mqtt: Any = wire.new(name)
        if will is not None:
            self.mqtt.will_set(will[0], will[1], qos=1, retain=True)
        self.mqtt.on_connect = self._connected
        self.mqtt.on_disconnect = self._lost
        self.mqtt.on_message = lambda _client, _data, message: take(message.topic, message.payload)
        self.mqtt.on_socket_open = lambda _client, _data, sock: wire.opened(self, sock)
        self.mqtt.on_socket_close = lambda _client, _data, sock: wire.closed(self, sock)

    @property
    def lost(self) -> bool:
        """True if there is no connection, and none is being made."""
        return not self.connected and not self.ended and self.mqtt.socket() is None

    def publish(self, topic: str, payload: bytes, qos: int = 0, retain: bool = False) -> bool:
        """Send a message; tell whether there is a connection to send it by."""
        if self.connected:
            self.mqtt.publish(topic, payload, qos=qos, retain=retain)
            self._wire.flush(self)
        return self.connected

    def _connected(self, _client: Any, _data: Any, _flags: Any, reason: Any, _properties: Any) -> None:
        if reason.is_failure:
            raise InputError(f"the broker refuses the connection: {reason}")
        self.connected = True
        if self._topics:
            self.mqtt.subscribe([(topic, 0) for topic in self._topics])
        self._online()

    def _lost(self, _client: Any, _data: Any, _flags: Any, _reason: Any, _properties: Any) -> None:
        self.connected = False


class Wire:
    """Serves all clients of this process.

    Args:
        broker: to which they connect.

    Raises:
        InputError: `paho-mqtt` is not installed.
    """

    def __init__(self, broker: Broker) -> None:
        try:
            import paho.mqtt.client as paho
        except ImportError as error:
            raise InputError(f"vda5050: paho-mqtt cannot be imported: {error}", hint=HINT) from error
        self._paho, self._broker = paho, broker
        self._selector = selectors.DefaultSelector()
        self._clients: list[Client] = []
        self._waiting: set[Client] = set()
        """Those whose sockets could not take all that there is to send."""
        self._retry_at, self._lost = 0.0, list[Client]()
        self._began, self._looks = time.monotonic(), 0
        """Since when, and how often, keepalives were looked at."""
        self._turn = 0

    def new(self, name: str) -> Any:
        """Make a client of the library."""
        paho = self._paho
        client = paho.Client(paho.CallbackAPIVersion.VERSION2, client_id=name, protocol=paho.MQTTv311)
        client.connect_timeout = PATIENCE_S
        if self._broker.encrypted:
            client.tls_set()
        if self._broker.user is not None:
            client.username_pw_set(self._broker.user, os.environ.get(PASSWORD))
        return client

    def add(self, client: Client) -> None:
        """Connect a client.

        Raises:
            InputError: there is no broker.
        """
        where = f"{self._broker.host}:{self._broker.port}"
        try:
            client.mqtt.connect(self._broker.host, self._broker.port, KEEPALIVE_S)
        except OSError as error:
            raise InputError(f"no broker answers at {where}: {error.strerror or error}") from error
        self._clients.append(client)

    def meet(self, seconds: float) -> None:
        """Serve until all clients are connected.

        Raises:
            InputError: some are not within so many seconds.
        """
        until = time.monotonic() + seconds
        while silent := [client for client in self._clients if not client.connected]:
            if time.monotonic() > until:
                raise InputError(f"the broker does not accept {len(silent)} of {len(self._clients)} connections")
            self.serve(time.monotonic() + 0.05)

    def serve(self, until: float) -> None:
        """Send and receive until a time of `time.monotonic`, or what waits, for at most `LEAST_S`, if that is over.

        What is left then is received by the next call, so that many messages at once do not stop the clock of a run.
        """
        end = max(until, time.monotonic() + LEAST_S)
        while True:
            now = time.monotonic()
            self._keep(now)
            ready = self._selector.select(max(0.0, min(until - now, MISC_S)))
            if not ready and time.monotonic() >= until:
                return
            begin = self._turn
            for index in range(len(ready)):
                key, mask = ready[(begin + index) % len(ready)]
                self._turn += 1  # others come first the next time
                client = key.data
                if mask & selectors.EVENT_READ:
                    client.mqtt.loop_read()
                self.flush(client)
                if time.monotonic() >= end:
                    return

    def flush(self, client: Client) -> None:
        """Write what a client has to send, as far as its socket takes it; the rest follows in `serve`."""
        mqtt = client.mqtt
        if mqtt.want_write():
            mqtt.loop_write()
        waits = bool(mqtt.want_write())
        if waits != (client in self._waiting) and (sock := mqtt.socket()) is not None:
            self._selector.modify(sock, selectors.EVENT_READ | (selectors.EVENT_WRITE if waits else 0), client)
            (self._waiting.add if waits else self._waiting.discard)(client)

    def _keep(self, now: float) -> None:
        """Keep connections alive, and connect again what was lost, a few clients at a time."""
        looks = int((now - self._began) / MISC_S * len(self._clients))
        for look in range(max(self._looks, looks - len(self._clients)), looks):
            self._clients[look % len(self._clients)].mqtt.loop_misc()
        self._looks = looks
        if now >= self._retry_at:
            self._retry_at = now + RETRY_S
            self._lost = [client for client in self._clients if client.lost]
        while self._lost:
            client = self._lost.pop()
            try:
                if client.lost:
                    client.mqtt.reconnect()
            except OSError:
                self._lost.clear()  # all have the same broker
            if time.monotonic() >= now + CONNECTING_S:
                return

    def cut(self, seconds: float) -> None:
        """Break all connections without a word, and do not connect again for so many seconds."""
        self._retry_at = time.monotonic() + seconds
        self._lost.clear()
        for client in self._clients:
            if (sock := client.mqtt.socket()) is not None:
                sock.shutdown(socket.SHUT_RDWR)

    def close(self) -> None:
        """Disconnect all clients, after what they have to send."""
        for client in self._clients:
            client.ended = True
        until = time.monotonic() + 1.0
        while any(client.mqtt.want_write() for client in self._clients if client.connected):
            if time.monotonic() > until:
                break
            self.serve(time.monotonic() + 0.01)
        for client in self._clients:
            client.mqtt.disconnect()
            self.flush(client)
        self._clients = []
        self._selector.close()

    def opened(self, client: Client, sock: Any) -> None:
        """Serve a socket."""
        self._selector.register(sock, selectors.EVENT_READ, client)

    def closed(self, client: Client, sock: Any) -> None:
        """Serve a socket no longer."""
        self._waiting.discard(client)
        if sock in (self._selector.get_map() or {}):
            self._selector.unregister(sock)
