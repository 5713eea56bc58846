"""A fleet control that we did not write drives the vehicles of a run over a broker: `vda5050-sdk` from PyPI."""

import asyncio
import os
import time

import numpy as np
import pytest
from mrpbench_live.vda5050.check.control import ControlCheck
from mrpbench_live.vda5050.check.rules import BROKEN, PASSED

vda5050 = pytest.importorskip("vda5050", reason="vda5050-sdk is not installed")
pytest.importorskip("aiomqtt", reason="aiomqtt, by which vda5050-sdk speaks, is not installed")
pytest.importorskip("paho.mqtt", reason="mrpbench-live[vda5050] is not installed")

ORDERS = int(os.environ.get("MRPBENCH_LIVE_ORDERS", "2"))
"""Orders of each vehicle; `make live` sends more."""
ROBOTS = ("robot_0", "robot_1", "robot_2")


class Master:
    """Sends each vehicle on round trips of three nodes, with updates and cancels, until it has sent enough orders."""

    def __init__(self, client, orders):
        self.client, self.orders, self.sent = client, orders, dict.fromkeys(ROBOTS, 0)
        self.errors, self.issues, self.places = [], [], {}
        client.on_vehicle_error(lambda event, key: self.errors.append((key.serial_number, event.error.error_type)))
        client.on_error(lambda event: self.issues.append(str(event)))
        client.on_state(lambda state, key: self.places.setdefault(key.serial_number, state.agv_position))

    async def drive(self, serial):
        client, key = self.client, f"mrpbench/{serial}"
        await client.wait_for(key, lambda session: session.state is not None, timeout=60)
        session = await client.session(key)
        while self.sent[serial] < self.orders:
            number = self.sent[serial]
            here = session.state.agv_position
            x, y = round(here.x - 0.5) + 0.5, round(here.y - 0.5) + 0.5
            step = 1 if x < 6 else -1
            order = vda5050.OrderBuilder(order_id=f"{serial}-{number}", manufacturer="mrpbench", serial_number=serial)
            names = [f"{serial}-{number}-{i}" for i in range(4)]
            for i, name in enumerate(names):
                within = None if i else 0.5
                order.add_node(name, x=x + i * step, y=y, map_id="L1", allowed_deviation_xy=within, released=i < 2)
                if i:
                    order.add_edge(names[i - 1], name, released=i < 2)
            built = order.build()
            result = await client.dispatch(built, key)
            assert result.accepted, result
            self.sent[serial] += 1
            name = built.order_id
            await client.wait_for(key, lambda it, name=name: it.state.order_id == name, timeout=20)
            nodes, edges = (
                [it.model_copy(update={"released": True}) for it in parts]
                for parts in (built.nodes[2:], built.edges[1:])
            )
            result = await client.extend_base(key, nodes, edges)
            assert result.accepted, result
            await client.wait_for(key, lambda it: it.state.order_update_id == 1, timeout=20)
            if number % 2:
                await client.cancel_order(key, action_id=f"cancel-{number}")
            await client.wait_for(key, lambda it: not it.state.node_states and not it.state.driving, timeout=30)


async def drive_all(url, orders):
    """Drive, while a check of the fleet control listens; return the master and the check."""
    check = ControlCheck(url, "2.1", "")
    check.connect()
    config = vda5050.MasterConfig(broker_url=url, validate_messages=True)
    async with vda5050.MasterClient(config) as client:
        master = Master(client, orders)
        driving = asyncio.gather(*(master.drive(serial) for serial in ROBOTS))
        while not driving.done():
            check.listen(time.monotonic())
            await asyncio.sleep(0.01)
        await driving
        return master, check


def test_a_foreign_fleet_control_drives_orders_with_updates_and_cancels(serve, broker):
    start, result, _ = serve
    start(12 * ORDERS + 12, "2.1", 6)
    master, check = asyncio.run(drive_all(broker.url, ORDERS))
    assert master.errors == []
    assert master.issues == []
    verdicts = {name: finding.verdict for name, finding in check.report.findings.items()}
    assert {name for name, verdict in verdicts.items() if verdict == PASSED} >= {
        "schema",
        "stitching",
        "idle",
        "accepted",
    }
    assert BROKEN not in verdicts.values()
    record, events = result()
    assert record["status"] == "succeeded"
    assert record["provenance"]["live"] is True
    kinds = [kind for kind, _, _ in events]
    assert kinds.count("order_accepted") == 2 * 3 * ORDERS
    assert kinds.count("order_cancelled") == 3 * (ORDERS // 2)
    assert "refused" not in kinds
    away = [float(detail.split()[2]) for kind, _, detail in events if kind == "node_traversed"]
    assert len(away) >= 3 * ORDERS
    assert np.max(away) <= 0.5
