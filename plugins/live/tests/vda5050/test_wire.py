"""Connections of a process, served for as long as there is time."""

import time

import pytest

pytest.importorskip("paho.mqtt", reason="mrpbench-live[vda5050] is not installed")
from mrpbench_live.vda5050.wire import Broker, Client, Wire


def test_who_is_late_receives_what_waits_but_not_for_long(broker):
    came, busy = [], [0.0]

    def take(topic, payload):
        came.append(payload)
        time.sleep(busy[0])

    wire = Wire(Broker.of(broker.url))
    listener = Client(wire, "listener", None, ("t",), lambda: None, take)
    sender = Client(wire, "sender", None, (), lambda: None, take)
    for client in (listener, sender):
        wire.add(client)
    wire.meet(5)
    wire.serve(time.monotonic() + 0.2)  # until the broker knows of the subscription
    for number in range(40):
        sender.publish("t", str(number).encode())
    time.sleep(0.2)
    wire.serve(time.monotonic())
    assert len(came) > 1
    busy[0] = 0.004
    began, before = time.monotonic(), len(came)
    wire.serve(began)
    assert len(came) - before <= 4
    busy[0] = 0.0
    while len(came) < 40:
        wire.serve(time.monotonic())
    assert came == [str(number).encode() for number in range(40)]
    wire.close()


def test_many_clients_connect_again_a_few_at_a_time(broker):
    came = []
    wire = Wire(Broker.of(broker.url))
    clients = [
        Client(wire, f"c{number}", None, ("t",), lambda: None, lambda *what: came.append(what)) for number in range(30)
    ]
    for client in clients:
        wire.add(client)
        connect = client.mqtt.reconnect

        def slowly(connect=connect):
            time.sleep(0.004)
            came.append("again")
            return connect()

        client.mqtt.reconnect = slowly
    wire.meet(5)
    broker.stop()
    until = time.monotonic() + 5
    while any(client.connected for client in clients) and time.monotonic() < until:
        wire.serve(time.monotonic() + 0.01)
    broker.start()
    came.clear()
    most = 0
    while not all(client.connected for client in clients) and time.monotonic() < until + 10:
        before = came.count("again")
        wire.serve(time.monotonic())
        most = max(most, came.count("again") - before)
    assert all(client.connected for client in clients)
    assert 0 < most <= 12  # 3 each time that it looks, of which there are a few in a call
    clients[0].publish("t", b"all")
    while len([it for it in came if it != "again"]) < 30 and time.monotonic() < until + 20:
        wire.serve(time.monotonic() + 0.05)
    assert len([it for it in came if it != "again"]) == 30
    wire.close()
