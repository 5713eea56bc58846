"""The npm package `vda-5050-lib` as fleet control of our vehicles, and as vehicles of our fleet control."""

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest

from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.results import Results

pytest.importorskip("paho.mqtt", reason="mrpbench-live[vda5050] is not installed")
SCRIPT = Path(__file__).with_name("vda_5050_lib.js")
ORDERS = int(os.environ.get("MRPBENCH_LIVE_ORDERS", "2"))
"""Orders of each vehicle; `make live` sends more."""


@pytest.fixture
def node():
    """Start the script; NODE_PATH says where the package is, as in `make live`."""
    program, running = shutil.which("node"), []
    if program is None:
        pytest.skip("node is not installed")
    found = subprocess.run([program, "-e", "require('vda-5050-lib')"], capture_output=True)
    if found.returncode:
        pytest.skip(
            "vda-5050-lib is not on NODE_PATH: npm install --prefix DIR vda-5050-lib, NODE_PATH=DIR/node_modules"
        )

    def start(*words):
        command = [program, SCRIPT, *words]
        running.append(subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True))
        return running[-1]

    yield start
    for process in running:
        process.kill()
        process.communicate()


def test_it_drives_our_vehicles_by_orders_with_updates_and_cancels(node, serve, broker):
    start, result, _ = serve
    master = node("master", broker.url, str(ORDERS))
    start(14 * ORDERS + 20, "2.1", 5)
    said, errors = master.communicate(timeout=30 + 4 * ORDERS)
    assert master.returncode == 0, errors
    found = json.loads(said)
    assert found["errors"] == []
    assert found["processed"] + found["cancelled"] == 3 * ORDERS
    assert found["cancelled"] == 3 * (ORDERS // 2)
    record, events = result()
    assert record["status"] == "succeeded"
    kinds = [kind for kind, _, _ in events]
    assert kinds.count("order_accepted") == 2 * 3 * ORDERS
    assert kinds.count("order_cancelled") == 3 * (ORDERS // 2)
    assert "refused" not in kinds


def test_our_fleet_control_lets_its_vehicles_swap_places(node, swap_study, command, broker):
    vehicles = node("vehicles", broker.url, "0.5,0.5,0", "6.5,0.5,3.14")
    assert vehicles.stdout.readline() == "ready\n"
    words = ("control", "study.yaml", "--vda5050", broker.url, "--version", "2.1", "--out", "results")
    folder = swap_study()
    done = subprocess.run([*command, *words], cwd=folder, capture_output=True, text=True, timeout=120)
    vehicles.kill()
    assert done.returncode == 0, (done.stderr, vehicles.communicate()[1])
    (record,) = Results(ResultsFolder(folder / "results"))
    assert record["status"] == "succeeded", (record["error"], done.stderr)
    assert record["metrics"]["execution.robot_contacts"] == 0
