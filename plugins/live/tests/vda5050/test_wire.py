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
