"""Vehicles that we did not write are driven by our fleet control: `vda5050-sdk` from PyPI takes and refuses orders."""

import asyncio
import contextlib
import math

import pytest
from mrpbench_live.vda5050.check.control import ControlCheck
from mrpbench_live.vda5050.check.rules import BROKEN, PASSED

from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.results import Results

agv = pytest.importorskip("vda5050.client.agv", reason="vda5050-sdk is not installed")
config = pytest.importorskip("vda5050.config")
factsheet = pytest.importorskip("vda5050.model.factsheet")
pytest.importorskip("aiomqtt", reason="aiomqtt, by which vda5050-sdk speaks, is not installed")
pytest.importorskip("paho.mqtt", reason="mrpbench-live[vda5050] is not installed")

SPEED, RATE, STEP_S = 0.6, 1.5, 0.1
"""m/s, rad/s, and wall seconds between two positions; at pace 1."""
FACTSHEET = {
    "typeSpecification": {
        "seriesName": "sdk",
        "agvKinematic": "DIFF",
        "agvClass": "CARRIER",
        "maxLoadMass": 0.0,
        "localizationTypes": ["NATURAL"],
        "navigationTypes": ["VIRTUAL_LINE_GUIDED"],
    },
    "physicalParameters": {
        "speedMin": 0.0,
        "speedMax": 1.0,
        "accelerationMax": 1.0,
        "decelerationMax": 1.0,
        "heightMax": 0.5,
        "width": 0.3,
        "length": 0.4,
    },
    "protocolLimits": {
        "maxStringLens": {},
        "maxArrayLens": {},
        "timing": {"minOrderInterval": 0.0, "minStateInterval": 0.05},
    },
    "protocolFeatures": {"optionalParameters": [], "agvActions": []},
    "agvGeometry": {},
    "loadSpecification": {},
}


class Vehicle:
    """Drives from node to node of what the SDK has accepted."""

    def __init__(self, url, serial, x, y, yaw):
        settings = config.VehicleConfig(broker_url=url, manufacturer="sdk", serial_number=serial, state_interval=0.5)
        self.client = agv.VehicleClient(
            settings, factsheet_provider=lambda: factsheet.Factsheet.model_validate(FACTSHEET | self.header)
        )
        self.header = {"headerId": 0, "timestamp": "2026-01-01T00:00:00.000Z", "version": "2.1.0"}
        self.header |= {"manufacturer": "sdk", "serialNumber": serial}
        self.place, self.yaw, self.ahead, self.orders = (x, y), yaw, {}, 0
        self.client.on_order(self.take)

    async def take(self, order):
        self.orders += 1
        here = self.client.publisher.last_node_sequence_id
        new = {node.sequence_id: node for node in order.nodes if node.released}
        if order.order_update_id == 0:
            first = order.nodes[0]
            self.ahead = {}
            self.client.mark_node_traversed(first.node_id, first.sequence_id)
            here = first.sequence_id
        self.ahead |= {key: node for key, node in new.items() if key > here}

    def say(self):
        self.client.update_position(x=self.place[0], y=self.place[1], theta=self.yaw, map_id="L1")

    def step(self, goal):
        """Turn to a place, or drive there."""
        dx, dy = goal[0] - self.place[0], goal[1] - self.place[1]
        turn = math.remainder(math.atan2(dy, dx) - self.yaw, 2 * math.pi)
        if abs(turn) > 1e-6:
            step = math.copysign(min(abs(turn), RATE * STEP_S), turn)
            self.yaw = math.remainder(self.yaw + step, 2 * math.pi)
        else:
            share = min(1.0, SPEED * STEP_S / math.hypot(dx, dy))
            self.place = goal if share == 1.0 else (self.place[0] + share * dx, self.place[1] + share * dy)
        self.say()

    async def drive(self):
        await self.client.connect()
        await self.client._publish_factsheet()
        self.say()
        while True:
            if not self.ahead:
                self.client.publisher.set_driving(False)
                await asyncio.sleep(STEP_S)
                continue
            node = self.ahead[min(self.ahead)]
            goal = node.node_position.x, node.node_position.y
            self.client.publisher.set_driving(True)
            while self.place != goal:
                await asyncio.sleep(STEP_S)
                self.step(goal)
            del self.ahead[node.sequence_id]
            self.client.mark_node_traversed(node.node_id, node.sequence_id)


async def serve_and_check(vehicles, url, command, folder):
    """Let the vehicles drive while the control runs, and listen to it."""
    check = ControlCheck(url, "2.1", "")
    check.connect()
    driving = asyncio.gather(*(vehicle.drive() for vehicle in vehicles))
    await asyncio.sleep(0.5)
    control = await asyncio.create_subprocess_exec(*command, cwd=folder, stderr=asyncio.subprocess.PIPE)
    ended = asyncio.ensure_future(control.communicate())
    while not ended.done() and not driving.done():
        check.listen(0.0)
        await asyncio.sleep(0.01)
    assert not driving.done(), driving.exception()
    driving.cancel()
    with contextlib.suppress(asyncio.CancelledError):
        await driving
    return control.returncode, (await ended)[1].decode(), check


def test_foreign_vehicles_swap_places(swap_study, command, broker):
    folder = swap_study()
    words = ("control", "study.yaml", "--vda5050", broker.url, "--version", "2.1", "--out", "results")
    vehicles = [Vehicle(broker.url, "a", 0.5, 0.5, 0.0), Vehicle(broker.url, "b", 6.5, 0.5, math.pi)]
    code, said, check = asyncio.run(serve_and_check(vehicles, broker.url, (*command, *words), folder))
    assert code == 0, said
    (record,) = Results(ResultsFolder(folder / "results"))
    assert record["status"] == "succeeded", (record["error"], said)
    assert record["metrics"]["execution.robot_contacts"] == 0
    assert all(vehicle.orders >= 2 for vehicle in vehicles)
    verdicts = {name: finding.verdict for name, finding in check.report.findings.items()}
    broken = {name: check.report.findings[name].reason for name, it in verdicts.items() if it == BROKEN}
    assert broken == {}
    assert {"order", "structure", "update_ids", "stitching", "accepted"} <= {
        name for name, verdict in verdicts.items() if verdict == PASSED
    }
