"""The checks of vehicles and fleet controls: they pass ours, and name what others break."""

import json

import pytest
from mrpbench_live.vda5050.check.areas import RULES as AREA_RULES
from mrpbench_live.vda5050.check.control import ControlCheck
from mrpbench_live.vda5050.check.rules import BROKEN, PASSED

pytest.importorskip("paho.mqtt", reason="mrpbench-live[vda5050] is not installed")
ROOT = "vda5050/v3/mrpbench/robot_0/"


def test_our_vehicles_keep_every_rule(serve, broker):  # of 2.1; those of 3.0 are asked by `test_how_to.py`
    start, result, mrpbench = serve
    start(36, "2.1", 6)
    words = ["--version", "2.1", "--vehicle", "mrpbench/robot_0", "--seconds", "2", "--json"]
    check = mrpbench("check-vda5050", "vehicle", broker.url, *words)
    said = check.communicate(timeout=60)[0]
    findings = json.loads(said)
    other = {name for name, found in findings.items() if found["verdict"] != PASSED}
    assert other == set(AREA_RULES)  # which `test_check_areas.py` asks a vehicle that drives
    assert check.returncode == 0
    assert result()[0]["status"] == "succeeded"


@pytest.fixture
def control(bench3):
    """A check of a control that hears what a test sends, and a maker of orders."""
    check = ControlCheck("mqtt://127.0.0.1:1", "3.0", "")

    def send(topic, message):
        check.take(ROOT + topic, json.dumps(message).encode())

    send("state", bench3.step())
    return check, send


def broken(check):
    return {name: found.reason for name, found in check.report.findings.items() if found.verdict == BROKEN}


def test_a_sound_control_breaks_no_rule(control, bench3):
    check, send = control
    for order in (
        bench3.order([0, 1, 2], base=2),
        bench3.order([1, 2], base=2, update=1, first=2),
    ):
        send("order", {**order, "headerId": order["orderUpdateId"]})
        send("state", bench3.take(order))
    assert broken(check) == {}
    assert check.report.findings["stitching"].verdict == PASSED


BREAKS = {
    "json": (lambda b: "nothing", "no object"),
    "schema": (lambda b: {**b.order([1, 2], 2, update=1, first=2), "nodes": 3}, "nodes must be array"),
    "header": (lambda b: {**b.order([1, 2], 2, update=1, first=2), "serialNumber": "r7"}, "mrpbench/r7"),
    "header_ids": (lambda b: {**b.order([1, 2], 2, update=1, first=2), "headerId": 9}, "9 after 0"),
    "timestamp": (
        lambda b: {**b.order([1, 2], 2, update=1, first=2), "timestamp": "2026-01-01T00:00:00+00:00"},
        "2026",
    ),
    "structure": (lambda b: b.order([1, 2], 2, update=1, first=2, s4={"sequenceId": 6}), "sequenceId 6 instead of 4"),
    "new_order": (lambda b: b.order([0], 1, update=2, id="o2"), "begins with 2"),
    "idle": (lambda b: b.order([0], 1, id="o2"), "has nodes left"),
    "update_ids": (lambda b: b.order([0, 1], 2), "0 after 0"),
    "stitching": (lambda b: b.order([2, 3], 2, update=1, first=4), "the base ends with 'n1'"),
    "base": (lambda b: b.order([0, 1], 2, update=1), "sequenceId 0 is sent again"),
    "maps": (
        lambda b: b.order([1, 2], 2, update=1, first=2, s4={"nodePosition": {"x": 0.0, "y": 0.0, "mapId": "attic"}}),
        "unknown maps: attic",
    ),
    "action_ids": (
        lambda b: b.order([1, 2], 2, update=1, first=2, s4={"actions": [b.action("drop", "a1")]}),
        "actionId 'a1' is used for",
    ),
}


@pytest.mark.parametrize("rule", BREAKS)
def test_a_control_that_breaks_a_rule_is_told_by_which_message(control, bench3, rule):
    check, send = control
    order = bench3.order([0, 1, 2], base=2, s0={"actions": [bench3.action("pick", "a1", "NONE")]})
    send("order", {**order, "headerId": 0})
    send("state", bench3.take(order))
    make, reason = BREAKS[rule]
    message = make(bench3)
    if rule not in ("json", "header_ids"):
        message = {**message, "headerId": 1}
    send("order", message)
    assert reason in broken(check)[rule]
    assert check.report.findings[rule].message is not None


def test_an_update_after_cancel_is_found(control, bench3):
    check, send = control
    send("order", bench3.order([0, 1], base=2))
    cancel = {**bench3._header(), "actions": [bench3.action("cancelOrder", "c1", "NONE")]}
    send("instantActions", cancel)
    send("order", bench3.order([1, 2], base=2, update=1, first=2))
    assert broken(check)["after_cancel"] == "order 'o1' was cancelled"


def test_refusals_by_vehicles_are_found(control, bench3):
    check, send = control
    order = bench3.order([5, 6], base=2)
    send("order", order)
    send("state", bench3.take(order))
    assert "START_NODE_OUT_OF_RANGE" in broken(check)["accepted"]
