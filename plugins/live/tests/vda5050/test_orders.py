"""Orders, updates and cancellations, as a vehicle reports them in both versions."""

import pytest
from mrpbench_live.vda5050.names import VERSIONS


def errors(state):
    return [error["errorType"] for error in state["errors"]]


def refers(state):
    (error,) = state["errors"]
    return {it["referenceKey"]: it["referenceValue"] for it in error["errorReferences"]}


def test_a_vehicle_drives_its_base_and_reports_each_node(bench):
    state = bench.take(bench.order([0, 1, 2, 3], base=3))
    assert (state["orderId"], state["lastNodeId"], state["lastNodeSequenceId"]) == ("o1", "n0", 0)
    assert [(it["nodeId"], it["released"]) for it in state["nodeStates"]] == [("n1", True), ("n2", True), ("n3", False)]
    assert [it["sequenceId"] for it in state["edgeStates"]] == [1, 3, 5]
    assert bench.may_drive == 2
    state = bench.drive()
    assert (state["lastNodeId"], state["lastNodeSequenceId"]) == ("n1", 2)
    state = bench.drive()
    assert [it["nodeId"] for it in state["nodeStates"]] == ["n3"]
    assert state["newBaseRequest"]
    assert bench.may_drive == 0  # it stops at the decision point


def test_an_update_releases_the_horizon_without_a_new_path(bench):
    bench.take(bench.order([0, 1, 2, 3], base=2))
    bench.paths.changed.clear()
    state = bench.take(bench.order([1, 2, 3], base=3, update=1, first=2))
    assert not errors(state)
    assert not bench.paths.changed
    assert state["orderUpdateId"] == 1
    state = bench.drive(3)
    assert (state["lastNodeId"], state["nodeStates"], state["edgeStates"]) == ("n3", [], [])
    assert bench.vehicle.idle


def test_an_update_replaces_the_horizon(bench):
    bench.take(bench.order([0, 1, 2, 3], base=2))
    state = bench.take(bench.order([1, 0], base=2, update=1, first=2))
    assert [it["nodeId"] for it in state["nodeStates"]] == ["n1", "n0"]
    assert bench.paths.length[0] == 2


def test_a_completed_order_is_continued_where_it_ended(bench):
    bench.take(bench.order([0, 1], base=2))
    assert bench.drive()["nodeStates"] == []
    state = bench.take(bench.order([1, 2], base=2, update=1, first=2))
    assert not errors(state)
    assert bench.drive()["lastNodeSequenceId"] == 4


def test_nodes_without_positions_are_places_by_name(bench3):
    order = bench3.order([0, 9], base=2, s0={"nodeId": "dock"}, s2={"nodeId": "end"})
    for node in order["nodes"]:
        del node["nodePosition"]
    assert not errors(bench3.take(order))
    assert bench3.may_drive == 9


BROKEN = {
    "no nodes": {"nodes": [], "edges": []},
    "an edge too few": {"edges": []},
    "no orderId": {"orderId": None},
    "nodes that are no list": {"nodes": 7},
}


@pytest.mark.parametrize("change", BROKEN.values(), ids=BROKEN)
def test_malformed_orders_are_refused(bench, change):
    state = bench.take({**bench.order([0, 1], base=2), **change})
    assert errors(state) == [bench.names.error("VALIDATION_FAILURE", "WARNING")[0]]
    assert state["orderId"] == ""


@pytest.mark.parametrize(
    ("part", "change"),
    [
        ("s0", {"released": False}),
        ("s2", {"released": False}),
        ("s3", {"released": True}),
        ("s2", {"sequenceId": 4}),
    ],
)
def test_orders_whose_base_or_numbers_have_gaps_are_refused(bench, part, change):
    state = bench.take(bench.order([0, 1, 2], base=2, **{part: change}))
    assert errors(state) == [bench.names.error("VALIDATION_FAILURE", "WARNING")[0]]


REFUSED = {
    "UNSUPPORTED_PARAMETER": lambda b: b.order(
        [1, 2], 2, update=1, first=2, s3={"trajectory": {"degree": 1, "knotVector": [0, 1], "controlPoints": []}}
    ),
    "INVALID_ORDER_ACTION": lambda b: b.order([1, 2], 2, update=1, first=2, s4={"actions": [b.action("fly")]}),
    "OUTDATED_ORDER_UPDATE": lambda b: b.order([0, 1, 2], 2),
    "SAME_ORDER_UPDATE_ID": lambda b: b.order([0, 1], 2, update=1),
    "OTHER_ORDER_ACTIVE": lambda b: b.order([1, 2], 2, id="o2"),
    "NO_ROUTE_TO_TARGET": lambda b: b.order(
        [2, 3], 2, update=2, first=4, s6={"nodePosition": {"x": 0.0, "y": 0.0, "mapId": "upper"}}
    ),
    "UNKNOWN_MAP_ID": lambda b: b.order(
        [2, 3], 2, update=2, first=4, s6={"nodePosition": {"x": 0.0, "y": 0.0, "mapId": "attic"}}
    ),
    "NO_STITCHING": lambda b: b.order([3, 4], 2, update=2, first=6),
}


@pytest.mark.parametrize("kind", REFUSED)
def test_a_refused_order_is_reported_and_leaves_the_running_one_alone(bench, kind):
    bench.take(bench.order([0, 1, 2, 3], base=2))
    before = bench.take(bench.order([1, 2, 3], base=2, update=1, first=2))
    order = REFUSED[kind](bench)
    if kind in ("UNSUPPORTED_PARAMETER", "INVALID_ORDER_ACTION"):
        order["orderUpdateId"] = 2
    state = bench.take(order)
    name, level = bench.names.error(kind, "CRITICAL" if kind == "UNSUPPORTED_PARAMETER" else "WARNING")
    assert [(error["errorType"], error["errorLevel"]) for error in state["errors"]] == [(name, level)]
    assert refers(state)["orderUpdateId"] == str(order["orderUpdateId"])
    for key in ("orderId", "orderUpdateId", "nodeStates", "edgeStates", "lastNodeId", "actionStates"):
        assert state[key] == before[key]
    assert bench.drive()["lastNodeId"] == "n1"
    assert errors(bench.take(bench.order([2, 3], base=2, update=3, first=4))) == []  # until an order is accepted


def test_the_same_message_again_is_ignored(bench):
    order = bench.order([0, 1], base=2)
    bench.take(order)
    assert errors(bench.take({**order, "headerId": 99})) == []


def test_the_first_node_must_be_near(bench):
    state = bench.take(bench.order([2, 3], base=2))
    assert errors(state) == [bench.names.error("START_NODE_OUT_OF_RANGE", "WARNING")[0]]
    assert refers(state)["nodeId"] == "n2"
    wide = 2.5 if not bench.names.single else {"a": 2.5, "b": 2.5, "theta": 0.0}
    place = {"x": 2.0, "y": 0.0, "mapId": "ground", "allowedDeviationXY": wide}
    assert errors(bench.take(bench.order([2, 3], base=2, id="o2", s0={"nodePosition": place}))) == []


def test_a_cancelled_order_ends_at_the_next_node_at_which_the_vehicle_can_stop(bench):
    bench.take(bench.order([0, 1, 2, 3], base=4, s6={"actions": [bench.action("pick")]}))
    bench.drive()
    bench.paths.released[0] = 2
    state = bench.act(bench.action("cancelOrder", "c1", "NONE"))
    own = state["instantActionStates" if bench.names.has_instant_states else "actionStates"]
    assert [it["actionStatus"] for it in own if it["actionId"] == "c1"] == ["RUNNING"]
    assert [it["actionStatus"] for it in state["actionStates"] if it["actionId"] == "a1"] == ["FAILED"]
    late = bench.take(bench.order([3, 4], base=2, update=1, first=6))
    assert errors(late) == [bench.names.error("ORDER_UPDATE_FOLLOWING_CANCEL", "WARNING")[0]]
    assert bench.may_drive == 1
    state = bench.drive()
    own = state["instantActionStates" if bench.names.has_instant_states else "actionStates"]
    assert [it["actionStatus"] for it in own if it["actionId"] == "c1"] == ["FINISHED"]
    assert (state["lastNodeId"], state["nodeStates"], state["orderId"]) == ("n2", [], "o1")
    assert errors(bench.take(bench.order([2, 3], base=2, id="o2"))) == []


def test_without_an_order_there_is_nothing_to_cancel(bench):
    state = bench.act(bench.action("cancelOrder", "c1", "NONE"))
    assert errors(state) == [bench.names.error("NO_ORDER_TO_CANCEL", "WARNING")[0]]
    assert refers(state) == {"actionId": "c1"}


def test_another_order_is_not_cancelled(bench3):
    bench3.take(bench3.order([0, 1], base=2))
    state = bench3.act(bench3.action("cancelOrder", "c1", "NONE", orderId="o7"))
    assert errors(state) == ["NO_ORDER_TO_CANCEL"]
    assert bench3.may_drive == 1


def test_a_vehicle_that_gave_up_takes_no_orders(bench):
    bench.take(bench.order([0, 1], base=2))
    state = bench.step(gave_up=True)
    assert errors(state) == [bench.names.error("NODE_UNREACHABLE", "CRITICAL")[0]]
    assert (state["operatingMode"], state["nodeStates"]) == ("MANUAL", [])
    state = bench.take(bench.order([0, 1], base=2, id="o2"))
    assert bench.names.error("MOBILE_ROBOT_NOT_AVAILABLE", "WARNING")[0] in errors(state)


def test_unknown_instant_actions_fail(bench):
    state = bench.act(bench.action("fly", "f1", "NONE"))
    assert errors(state) == [bench.names.error("INVALID_INSTANT_ACTION", "WARNING")[0]]
    assert refers(state)["actionId"] == "f1"
    assert errors(bench.act(bench.action("stateRequest", "s1", "NONE"))) == []


def test_each_version_has_its_own_names():
    old, new = VERSIONS["2.1"], VERSIONS["3.0"]
    assert {old.error(kind, "WARNING")[0] for kind in REFUSED} == {"orderError", "orderUpdateError", "noRouteError"}
    assert all(new.error(kind, "WARNING")[0].isupper() for kind in REFUSED)
