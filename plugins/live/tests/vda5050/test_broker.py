"""Vehicles whose broker is killed: they drive to the end of their base, come back, and go on."""

import json
import time

import pytest

pytest.importorskip("paho.mqtt", reason="mrpbench-live[vda5050] is not installed")
from mrpbench_live.vda5050.messages import Headers
from mrpbench_live.vda5050.wire import Broker, Client, Wire

TOPIC = "vda5050/v3/mrpbench/robot_0/"


class Control:
    """Sends orders to robot_0, and keeps the newest message of each topic."""

    def __init__(self, url):
        self.newest, self.headers, self.states = {}, Headers("3.0.0", "mrpbench", "robot_0"), []
        self.wire = Wire(Broker.of(url))
        self.client = Client(
            self.wire, "control", None, (TOPIC + "state", TOPIC + "connection"), lambda: None, self.take
        )
        self.wire.add(self.client)
        self.wire.meet(5)

    def take(self, topic, payload):
        kind, message = topic.rpartition("/")[2], json.loads(payload)
        self.newest[kind] = message
        if kind == "state":
            self.states.append(message)

    def publish(self, topic, **body):
        self.client.publish(TOPIC + topic, json.dumps({**self.headers.next(topic), **body}).encode())

    def wait(self, holds, seconds=30):
        until = time.monotonic() + seconds
        while not holds(self.newest):
            assert time.monotonic() < until, self.newest
            self.wire.serve(time.monotonic() + 0.02)

    def order(self, places, base, update, first):
        nodes = [
            {
                "nodeId": f"n{first // 2 + i}",
                "sequenceId": first + 2 * i,
                "released": i < base,
                "nodePosition": {"x": x, "y": y, "mapId": "L1"},
                "actions": [],
            }
            for i, (x, y) in enumerate(places)
        ]
        edges = [
            {"edgeId": f"e{first + i}", "sequenceId": first + 2 * i + 1, "released": i + 1 < base, "actions": []}
            for i in range(len(places) - 1)
        ]
        body = {"orderId": "o1", "orderUpdateId": update, "nodes": nodes, "edges": edges}
        self.publish("order", **body)


def located(broker):
    """Return a control that has heard the vehicle, where that is (metres), and the way along x to the far wall."""
    control = Control(broker.url)
    control.wait(lambda it: "state" in it)
    place = control.newest["state"]["mobileRobotPosition"]
    return control, place["x"], place["y"], 1 if place["x"] < 6 else -1


def test_a_killed_broker_stops_vehicles_at_the_end_of_their_base(serve, broker):
    start, result, _ = serve
    start(75, "3.0", 4)
    control, x, y, step = located(broker)
    places = [(x + i * step, y) for i in range(5)]
    control.order(places, base=3, update=0, first=0)
    control.wait(lambda it: it["state"]["orderId"] == "o1")
    broker.stop()
    time.sleep(1.0)
    broker.start()
    control.newest.clear()
    control.wait(lambda it: it.get("connection", {}).get("connectionState") == "ONLINE" and "state" in it)
    control.wait(lambda it: it["state"]["lastNodeId"] == "n2" and not it["state"]["driving"])
    control.wire.serve(time.monotonic() + 1.0)  # three simulated seconds
    state = control.newest["state"]
    assert (state["lastNodeId"], len(state["nodeStates"]), state["driving"]) == ("n2", 2, False)
    control.order(places[2:], base=3, update=1, first=4)
    control.wait(lambda it: it["state"]["lastNodeId"] == "n4" and not it["state"]["nodeStates"])
    control.wait(lambda it: it["connection"]["connectionState"] == "OFFLINE")
    control.wire.close()
    record, events = result()
    late = Control(broker.url)
    late.wait(lambda it: "connection" in it)
    assert late.newest["connection"]["connectionState"] == "OFFLINE"  # and stays so: there was no last will
    late.wire.close()
    assert record["status"] == "succeeded"
    assert record["metrics"]["execution.robot_contacts"] == 0
    assert [detail.split()[0] for kind, _, detail in events if kind == "node_traversed"] == ["n1", "n2", "n3", "n4"]


def square(x, y, half):
    return [{"x": x + i * half, "y": y + j * half} for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]


def test_vehicles_keep_to_zone_sets(serve, broker):
    start, result, _ = serve
    start(60, "3.0", 4)
    control, x, y, step = located(broker)
    zones = [
        {"zoneId": "closed", "zoneType": "BLOCKED", "vertices": square(x + step, y, 0.2)},
        {"zoneId": "slow", "zoneType": "SPEED_LIMIT", "vertices": square(x, y, 20.0), "maximumSpeed": 0.15},
    ]
    control.publish("zoneSet", zoneSet={"mapId": "L1", "zoneSetId": "set", "zones": zones})
    control.wait(lambda it: it["state"]["zoneSets"])
    parameters = [{"key": "zoneSetId", "value": "set"}]
    action = {"actionId": "a", "actionType": "enableZoneSet", "blockingType": "NONE", "actionParameters": parameters}
    control.publish("instantActions", actions=[action])
    control.wait(lambda it: it["state"]["zoneSets"][0]["zoneSetStatus"] == "ENABLED")
    control.order([(x, y), (x + 2 * step, y)], base=2, update=0, first=0)
    control.wait(lambda it: it["state"]["lastNodeId"] == "n1" and not it["state"]["driving"])
    control.wire.close()
    record, _ = result()
    assert record["status"] == "succeeded"
    assert not any(state["errors"] for state in control.states)
    speeds = [state["velocity"]["vx"] for state in control.states]
    assert 0.1 < max(speeds) <= 0.15 + 1e-3
    away = [
        max(abs(it["mobileRobotPosition"]["x"] - x - step), abs(it["mobileRobotPosition"]["y"] - y))
        for it in control.states
    ]
    assert min(away) > 0.25  # around the zone
