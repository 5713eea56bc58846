"""Edges with corridors, in both versions: what is accepted, and what a vehicle does that leaves one."""

import pytest
from mrpbench_live.vda5050.condition import Here
from mrpbench_live.vda5050.messages import factsheet_of


def corridor(bench, left, right, contour=False, **more):
    key, center = (
        ("corridorReferencePoint", "KINEMATIC_CENTER")
        if bench.names.single
        else (
            "corridorRefPoint",
            "KINEMATICCENTER",
        )
    )
    return {"corridor": {"leftWidth": left, "rightWidth": right, key: "CONTOUR" if contour else center, **more}}


def errors(state):
    return [error["errorType"] for error in state["errors"]]


def beside(bench, y, yaw=0.0):
    """Let the vehicle be somewhere on the first edge, `y` metres to the left of its line."""
    bench.now += 0.1
    bench.vehicle.advance(Here(now=bench.now, pose=(0.5, y, yaw), level=0, driving=True, gave_up=False))
    return bench.state()


REFUSED = {
    "both widths are zero": (lambda b: corridor(b, 0.0, 0.0), "VALIDATION_FAILURE"),
    "a width that is no number": (lambda b: corridor(b, float("nan"), 1.0), "VALIDATION_FAILURE"),
    "narrower than the contour": (lambda b: corridor(b, 0.2, 0.14, contour=True), "VALIDATION_FAILURE"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_corridors_into_which_no_vehicle_fits_are_refused(bench, case):
    change, kind = REFUSED[case]
    state = bench.take(bench.order([0, 1], base=2, s1=change(bench)))
    assert errors(state) == [bench.names.error(kind, "WARNING")[0]]
    assert {it["referenceKey"]: it["referenceValue"] for it in state["errors"][0]["errorReferences"]}["edgeId"] == "e0"
    assert state["orderId"] == ""


def test_a_corridor_that_has_to_be_asked_for_is_not_supported(bench3):
    state = bench3.take(bench3.order([0, 1], base=2, s1=corridor(bench3, 1.0, 1.0, releaseRequired=True)))
    assert [(it["errorType"], it["errorLevel"]) for it in state["errors"]] == [("UNSUPPORTED_PARAMETER", "CRITICAL")]
    assert not errors(bench3.take(bench3.order([0, 1], 2, s1=corridor(bench3, 1.0, 1.0, releaseRequired=False))))


@pytest.mark.parametrize(
    ("contour", "y", "stays"),
    [(False, 0.29, True), (False, 0.31, False), (False, -0.51, False), (True, 0.14, True), (True, 0.16, False)],
)
def test_a_vehicle_that_leaves_its_corridor_stops_and_says_so(bench, contour, y, stays):
    bench.take(bench.order([0, 1, 2], base=3, s1=corridor(bench, 0.3, 0.5, contour)))
    state = beside(bench, y)
    assert bench.may_drive == (2 if stays else 0)
    expected = bench.names.error("OUTSIDE_OF_CORRIDOR", "CRITICAL")
    assert [(it["errorType"], it["errorLevel"]) for it in state["errors"]] == ([] if stays else [expected])


def test_the_vehicle_drives_again_by_another_order(bench):
    bench.take(bench.order([0, 1, 2], base=3, s1=corridor(bench, 0.3, 0.3)))
    beside(bench, 0.4)
    assert beside(bench, 0.0)["errors"]  # it stands, and fleet control has to decide
    assert bench.may_drive == 0
    state = bench.act(bench.action("cancelOrder", "c1", "NONE"))
    state = bench.step()
    assert (state["errors"], state["nodeStates"]) == ([], [])
    assert not errors(bench.take(bench.order([0, 1], base=2, id="o2", s1=corridor(bench, 0.5, 0.5))))
    assert bench.may_drive == 1


def test_the_line_of_an_edge_goes_on_after_an_update(bench):
    bench.take(bench.order([0, 1], base=2))
    bench.take(bench.order([1, 2], base=2, update=1, first=2, s3=corridor(bench, 0.3, 0.3)))
    bench.drive()
    assert not errors(bench.step(driving=True, x=1.2))
    bench.now += 0.1
    bench.vehicle.advance(Here(now=bench.now, pose=(1.5, 0.4, 0.0), level=0, driving=True, gave_up=False))
    assert errors(bench.state()) == [bench.names.error("OUTSIDE_OF_CORRIDOR", "CRITICAL")[0]]


def test_the_factsheet_announces_corridors(bench):
    sheet = factsheet_of(bench.site.fleet.robots[0], bench.names, (0.1, 1.0, 0.0), False)
    names = [it["parameter"] for it in sheet["protocolFeatures"]["optionalParameters"]]
    assert "order.edges.corridor" in names
