"""Fleet controls under a load that rises: ours, and one of vda5050-sdk that knows nothing of traffic."""

import asyncio
import json
import os

import pytest

from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.results import Results

pytest.importorskip("paho.mqtt", reason="mrpbench-live[vda5050] is not installed")
pytestmark = pytest.mark.skipif(
    not int(os.environ.get("MRPBENCH_LIVE_KILLS", "0")), reason="takes minutes; `make live` sets MRPBENCH_LIVE_KILLS"
)
TASKS = {"plugin": "poisson", "rate": 2, "errands": 2, "service": "2 s"}
LOADED = {
    "name": "live",
    "world": {"plugin": "movingai", "file": "free.map"},
    "roadmap": "grid",
    "scenario": {"plugin": "random", "robots": 3},
    "fleet": "box.yaml",
    "tasks": TASKS,
    "simulator": "planar",
    "planner": {"plugin": "rolling_horizon", "planner": "pibt"},
    "metrics": ["execution"],
    "limits": {"execution": "20 min"},
}
LOAD = ("load", "study.yaml", "--pace", "6", "--window", "2 min", "--growth", "3", "--json", "--out", "results/load")
WIRE = "dispatcher.interface.faults={lost: 0.02, doubled: 0.02, late: 0.05, delay: 0.2, cut_every: 90, cut_for: 1}"


@pytest.fixture
def study(serve, swap_study):
    """The study in a folder with its files."""
    del serve  # which writes another study
    folder = swap_study()
    (folder / "free.map").write_text("type octile\nheight 10\nwidth 12\nmap\n" + "............\n" * 10)
    (folder / "study.yaml").write_text(json.dumps(LOADED))
    return folder


def steps_of(said):
    return json.loads(said[said.index("{") :])


@pytest.mark.parametrize("faults", [(), (WIRE,)], ids=["sound", "faulty"])
def test_our_control_is_loaded_until_it_falls_behind(study, serve, broker, faults):
    del study
    _, _, mrpbench = serve
    words = ("tasks=vda5050", f"tasks.url={broker.url}", "--vda5050", broker.url, "--pace", "6", "--duration", "19 min")
    control = mrpbench("control", "study.yaml", *words, "simulator.horizon=100", "--out", "results/control")
    load = mrpbench(*LOAD, "--vda5050", broker.url, "--pid", str(control.pid), *faults)
    said, log = load.communicate(timeout=240)
    assert load.returncode == 0, log
    found = steps_of(said)
    assert found["silent"] == []
    assert found["steps"][0]["done"] > 0
    assert not found["steps"][-1]["kept_up"]
    assert all(step["contacts"] == 0 for step in found["steps"])
    assert all(step["cpu"] > 0 and step["memory"] > 1e7 for step in found["steps"])
    control.terminate()


class Simple:
    """Gives each transport to a vehicle that is free, by orders with a released end each, and looks at nothing else."""

    def __init__(self, client, vehicles):
        self.client, self.vehicles, self.waiting, self.sent = client, vehicles, asyncio.Queue(), 0

    async def serve(self, serial, builder):
        key = f"mrpbench/{serial}"
        await self.client.wait_for(key, lambda session: session.state is not None, timeout=60)
        session = await self.client.session(key)
        while True:
            transport = await self.waiting.get()
            for errand in transport["errands"]:
                place, here = errand["places"][0], session.state.agv_position
                self.sent += 1
                order = builder(order_id=f"simple-{self.sent}", manufacturer="mrpbench", serial_number=serial)
                order.add_node("from", x=here.x, y=here.y, map_id=here.map_id, allowed_deviation_xy=0.5, released=True)
                order.add_node("to", x=place["x"], y=place["y"], map_id=place["mapId"], released=True)
                order.add_edge("from", "to", released=True)
                built = order.build()
                await self.client.dispatch(built, key)

                def arrived(it, name=built.order_id):
                    return it.state.order_id == name and not it.state.node_states and not it.state.driving

                await self.client.wait_for(key, arrived, timeout=120)
                await asyncio.sleep(errand["service"] / 6 + 0.2)


async def control_simply(sdk, paho, url, load):
    """Run the simple control until the load has ended."""
    heard = []
    host = paho.Client(paho.CallbackAPIVersion.VERSION2)
    host.on_message = lambda _client, _data, message: heard.append(json.loads(message.payload))
    host.connect("127.0.0.1", int(url.rpartition(":")[2]))
    host.subscribe("mrpbench/transports", 1)
    host.loop_start()
    config = sdk.MasterConfig(broker_url=url)
    async with sdk.MasterClient(config) as client:
        simple = Simple(client, [f"robot_{number}" for number in range(3)])
        driving = [asyncio.ensure_future(simple.serve(serial, sdk.OrderBuilder)) for serial in simple.vehicles]
        while load.poll() is None:
            while heard:
                simple.waiting.put_nowait(heard.pop(0))
            await asyncio.sleep(0.05)
        for it in driving:
            it.cancel()
        await asyncio.gather(*driving, return_exceptions=True)
    host.loop_stop()


def test_contacts_are_counted_that_a_foreign_control_does_not_see(study, serve, broker):
    sdk = pytest.importorskip("vda5050", reason="vda5050-sdk is not installed")
    pytest.importorskip("aiomqtt", reason="aiomqtt, by which vda5050-sdk speaks, is not installed")
    paho = pytest.importorskip("paho.mqtt.client")
    load = serve[2](*LOAD, "--version", "2.1", "--vda5050", broker.url)
    asyncio.run(control_simply(sdk, paho, broker.url, load))
    said, log = load.communicate(timeout=60)
    assert load.returncode == 0, log
    found = steps_of(said)
    assert sum(step["done"] for step in found["steps"]) > 0
    assert not found["steps"][-1]["kept_up"]
    (record,) = Results(ResultsFolder(study / "results" / "load"))
    contacts = sum(step["contacts"] for step in found["steps"])
    assert (contacts > 0) == (record["metrics"]["execution.robot_contacts"] > 0)
