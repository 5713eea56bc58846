"""Actions on nodes and edges, pauses, loads and batteries."""

import math

import pytest
from mrpbench_live.vda5050.condition import Here


def status(state, id, instant=False):
    return next(
        it["actionStatus"] for it in state["instantActionStates" if instant else "actionStates"] if it["actionId"] == id
    )


def test_a_hard_action_stops_the_vehicle_at_its_node_until_it_ends(bench3):
    bench3.take(bench3.order([0, 1, 2], base=3, s2={"actions": [bench3.action("pick", loadId="pallet")]}))
    assert bench3.may_drive == 1
    state = bench3.drive()
    assert status(state, "a1") == "RUNNING"
    assert bench3.may_drive == 0
    state = bench3.step(2.0)
    assert status(state, "a1") == "FINISHED"
    assert state["loads"] == [{"loadId": "pallet"}]
    assert bench3.may_drive == 1


def test_actions_that_do_not_block_run_while_the_vehicle_drives(bench3):
    action = bench3.action("detectObject", blocking="NONE")
    bench3.take(bench3.order([0, 1, 2], base=3, s0={"actions": [action]}))
    assert bench3.may_drive == 2
    assert status(bench3.step(driving=True), "a1") == "RUNNING"


@pytest.mark.parametrize(("blocking", "together"), [("SOFT", True), ("HARD", False)])
def test_hard_actions_run_one_after_another(bench3, blocking, together):
    both = [bench3.action("finePositioning", key, blocking) for key in ("a1", "a2")]
    state = bench3.take(bench3.order([0, 1], base=2, s0={"actions": both}))
    assert [status(state, key) for key in ("a1", "a2")] == ["RUNNING", "RUNNING" if together else "WAITING"]
    state = bench3.step(2.0)
    assert status(state, "a2") == ("FINISHED" if together else "RUNNING")
    assert bench3.may_drive == (1 if together else 0)


def test_actions_of_an_edge_end_with_it(bench3):
    action = bench3.action("detectObject", blocking="NONE")
    bench3.take(bench3.order([0, 3, 4], base=3, s1={"actions": [action]}))
    assert status(bench3.drive(1), "a1") == "RUNNING"
    assert status(bench3.drive(2), "a1") == "FINISHED"


def test_a_drop_without_a_load_fails(bench3):
    bench3.take(bench3.order([0], base=1, s0={"actions": [bench3.action("drop")]}))
    state = bench3.step(2.0)
    assert status(state, "a1") == "FAILED"
    assert state["actionStates"][0]["actionResult"] == "the vehicle has no load"


def test_a_paused_vehicle_keeps_its_order(bench):
    bench.take(bench.order([0, 1, 2], base=3))
    state = bench.act(bench.action("startPause", "p1", "NONE"))
    assert state["paused"]
    assert bench.may_drive == 0
    state = bench.act(bench.action("stopPause", "p2", "NONE"))
    assert not state["paused"]
    assert bench.may_drive == 2


def test_a_pause_ends_when_the_vehicle_stands(bench3):
    bench3.take(bench3.order([0, 1, 2], base=3))
    bench3.step(driving=True)
    bench3.instant.take({"actions": [{"actionType": "startPause", "actionId": "p1", "blockingType": "NONE"}]}, None)
    assert status(bench3.step(driving=True), "p1", instant=True) == "RUNNING"
    assert status(bench3.step(), "p1", instant=True) == "FINISHED"


def test_a_trigger_ends_what_waits_for_it(bench3):
    bench3.take(bench3.order([0, 1], base=2, s0={"actions": [bench3.action("waitForTrigger")]}))
    assert status(bench3.step(100.0), "a1") == "RUNNING"
    assert status(bench3.act(bench3.action("trigger", "t1", "NONE")), "a1") == "FINISHED"
    assert bench3.may_drive == 1


def test_instant_actions_stay_until_they_are_cleared(bench3):
    bench3.act(bench3.action("stateRequest", "s1", "NONE"))
    bench3.act(bench3.action("factsheetRequest", "s2", "NONE"))
    assert bench3.vehicle.wants_factsheet
    state = bench3.act(bench3.action("clearInstantActions", "s3", "NONE"))
    assert [it["actionId"] for it in state["instantActionStates"]] == ["s3"]


def test_a_position_is_accepted_where_the_vehicle_is(bench):
    name = bench.names.initialize_position
    right = bench.action(name, "i1", "NONE", x=0.2, y=0.0, theta=0.0, mapId="ground", lastNodeId="here")
    wrong = bench.action(name, "i2", "NONE", x=5.0, y=0.0, theta=0.0, mapId="ground", lastNodeId="there")
    state = bench.act(right, wrong)
    own = state["instantActionStates" if bench.names.has_instant_states else "actionStates"]
    assert [it["actionStatus"] for it in own] == ["FINISHED", "FAILED"]
    assert state["lastNodeId"] == "here"


def test_a_battery_drains_and_charges(bench):
    power, charge = bench.names.power, bench.names.charge
    hour = bench.step(3600.0)[power][charge]
    assert 100 - hour == pytest.approx(6.94, abs=0.02)  # 20 W of 288 Wh
    bench.act(bench.action("startCharging", "c1", "NONE"))
    state = bench.step(1800.0)
    assert state[power]["charging"]
    assert state[power][charge] == pytest.approx(min(100, hour + 10.42 - 3.47), abs=0.05)


def test_speed_limits_of_edges_hold(bench):
    bench.take(bench.order([0, 1, 2], base=3, s1={bench.names.maximum_speed: 0.3}))
    assert bench.paths.speed[0] == 0.3
    bench.drive()
    assert bench.paths.speed[0] == float("inf")


@pytest.mark.parametrize("yaw", [math.pi, -math.pi, 3.14159, 4.0, -7.0, 0.5])
def test_orientations_are_within_half_a_turn(bench, yaw):
    bench.vehicle.advance(Here(now=1.0, pose=(0.0, 0.0, yaw), level=0, driving=False, gave_up=False))
    theta = bench.state()[bench.names.position]["theta"]
    assert math.remainder(theta - yaw, 2 * math.pi) == pytest.approx(0.0, abs=1e-3)
