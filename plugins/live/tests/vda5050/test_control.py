"""Our fleet control and our vehicles at both ends of a broker: two robots swap places in a corridor with one bay."""

import json
import os
import time

import pytest

pytest.importorskip("paho.mqtt", reason="mrpbench-live[vda5050] is not installed")
from mrpbench_live.vda5050.check.control import ControlCheck
from mrpbench_live.vda5050.check.rules import BROKEN, PASSED
from mrpbench_live.vda5050.control.fleet import ForeignFleet
from mrpbench_live.vda5050.messages import factsheet_of
from mrpbench_live.vda5050.wire import Broker, Client, Wire

from mrpbench_core.api import InputError

KILLS = int(os.environ.get("MRPBENCH_LIVE_KILLS", "0"))
"""How often the broker is killed while two robots swap places; `make live` does."""

OFTEN = "dispatcher.interface.visualization_interval=0.2"


@pytest.fixture
def swap(swap_study, serve, broker):
    """Begin the swap with a dispatcher; returns what gives the records of both ends."""
    start, result, mrpbench = serve
    swap_study()

    def begin(dispatcher, seconds, pace=5, version="3.0", more=()):
        start(seconds, version, pace, OFTEN)
        words = ["--vda5050", broker.url, "--pace", str(pace), "--version", version, "--out", "results/control"]
        control = mrpbench("control", "study.yaml", f"dispatcher={dispatcher}", *words, *more)

        def end():
            said = control.communicate(timeout=120)[1]
            assert control.returncode == 0, said
            record, _ = result("results/control")
            return record, result()[0], said

        end.control = control
        return end

    return begin


def test_two_robots_swap_places(swap, broker):
    check = ControlCheck(broker.url, "2.1", "")
    check.connect()
    end = swap("adg", 45, version="2.1")
    while end.control.poll() is None:
        check.listen(time.monotonic() + 0.1)
    findings = check.report.findings
    record, served, said = end()
    assert (record["status"], served["status"]) == ("succeeded", "succeeded"), said
    assert record["provenance"]["live"]
    assert record["metrics"]["execution.robot_contacts"] == served["metrics"]["execution.robot_contacts"] == 0
    assert {name: found.reason for name, found in findings.items() if found.verdict == BROKEN} == {}
    kept = {"order", "structure", "new_order", "update_ids", "stitching", "base", "accepted"}
    assert {name for name in kept if findings[name].verdict != PASSED} == set()


def test_without_releases_in_order_they_meet(swap):
    record, served, _ = swap("all_at_once", 50)()
    assert served["metrics"]["execution.robot_contacts"] > 0
    assert record["metrics"]["execution.robot_contacts"] > 0 or record["status"] != "succeeded"


@pytest.mark.skipif(not KILLS, reason="`make live` sets MRPBENCH_LIVE_KILLS")
def test_a_killed_broker_costs_time_only(swap, broker):
    end = swap("adg", 35 + 2 * KILLS, pace=1)
    kill(broker, end.control)
    record, served, said = end()
    assert (record["status"], served["status"]) == ("succeeded", "succeeded"), (record["error"], said)
    assert served["metrics"]["execution.robot_contacts"] == 0


SHELVES = "............\n" + ".@@.@@@.@@@.\n" * 2 + "............\n" + ".@@@.@@.@@@.\n" * 2 + "............\n"
SHELVING = {
    "name": "live",
    "world": {"plugin": "movingai", "file": "shelves.map"},
    "roadmap": "grid",
    "scenario": {"plugin": "random", "robots": 4},
    "fleet": "box.yaml",
    "simulator": "planar",
    "control_rate": "10 Hz",
    "metrics": ["execution", "tasks"],
    "tasks": {"plugin": "closed_pool", "errands": 2, "service": "1 s"},
    "planner": {"plugin": "rolling_horizon", "planner": "pibt"},
}


@pytest.mark.skipif(not KILLS, reason="`make live` sets MRPBENCH_LIVE_KILLS")
def test_vehicles_that_drive_around_corners_unheard_hit_no_wall(tmp_path, swap, broker):
    (tmp_path / "shelves.map").write_text(f"type octile\nheight 7\nwidth 12\nmap\n{SHELVES}")
    (tmp_path / "study.yaml").write_text(json.dumps(SHELVING))
    pace, seconds = 5, 20 + 1.5 * KILLS
    end = swap("adg", pace * (seconds + 15), pace, more=("--duration", f"{pace * seconds} s"))
    kill(broker, end.control)
    record, served, said = end()
    assert (record["status"], served["status"]) == ("succeeded", "succeeded"), (record["error"], said)
    assert served["metrics"]["execution.robot_contacts"] == 0
    assert record["metrics"]["tasks.per_hour"] > 0


def kill(broker, control):
    """Kill the broker, and start it again, as often as asked, from the first order on."""
    heard = []
    wire = Wire(Broker.of(broker.url))
    topics = ("vda5050/v3/mrpbench/+/order",)
    wire.add(Client(wire, "listener", None, topics, lambda: None, lambda topic, _: heard.append(topic)))
    while not heard:
        assert control.poll() is None, control.communicate()
        wire.serve(time.monotonic() + 0.1)
    wire.close()
    for _ in range(KILLS):
        broker.stop()
        time.sleep(0.3)
        broker.start()
        time.sleep(0.9)


STARTS_2 = [("robot_0", 0.0, 0.0, 0), ("robot_1", 3.5, 0.5, 0)]


def test_the_first_missing_message_is_named(broker, bench3):
    def meet(*sent):
        fleet = ForeignFleet(broker.url, "3.0", "", ["ground"])
        for serial, topic, message in sent:
            body = {**bench3._header(), **message, "serialNumber": serial}
            fleet._client.publish(f"vda5050/v3/mrpbench/{serial}/{topic}", json.dumps(body).encode())
        with pytest.raises(InputError) as error:
            fleet.meet(STARTS_2, 0.4)
        fleet.close()
        return error.value.message

    online = {"connectionState": "ONLINE"}
    intervals = 0.1, 1.0, 0.0
    factsheet = factsheet_of(bench3.site.fleet.robots[0], bench3.names, intervals, False)
    assert "no vehicle has sent anything" in meet()
    assert "mrpbench/a has sent no factsheet" in meet(("a", "connection", online))
    assert "mrpbench/a has sent no state" in meet(("a", "connection", online), ("a", "factsheet", factsheet))
    whole = [("a", "connection", online), ("a", "factsheet", factsheet), ("a", "state", bench3.state())]
    assert "no vehicle stands at the start of robot_1, (3.50, 0.50) on ground" in meet(*whole)
