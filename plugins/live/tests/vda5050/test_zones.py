"""Zone sets of 3.0: how vehicles get them, and what they do in zones."""

import functools
import hashlib
import http.server
import json
import socket
import threading
import time

import pytest
from mrpbench_live.vda5050.condition import Here
from mrpbench_live.vda5050.messages import factsheet_of
from mrpbench_live.vda5050.schemas import validator
from mrpbench_live.vda5050.zones import SUPPORTED

MORE = {
    "RELEASE": {"releaseLossBehavior": "STOP"},
    "SPEED_LIMIT": {"maximumSpeed": 0.3},
    "ACTION": {"entryActions": [], "duringActions": [], "exitActions": []},
    "PRIORITY": {"priorityFactor": 0.5},
    "PENALTY": {"penaltyFactor": 0.5},
    "DIRECTED": {"direction": 0.0, "directedLimitation": "SOFT"},
    "BIDIRECTED": {"direction": 0.0, "bidirectedLimitation": "SOFT"},
}
ALL = ("BLOCKED", "LINE_GUIDED", "COORDINATED_REPLANNING", *MORE)


def zone(type="BLOCKED", low=2.6, high=3.4, y=0.5, id="z1", **more):
    corners = [(low, -y), (high, -y), (high, y), (low, y)]
    vertices = [{"x": x, "y": y} for x, y in corners]
    return {"zoneId": id, "zoneType": type, "vertices": vertices, **MORE.get(type, {}), **more}


def zone_set(*zones, id="set", map="ground"):
    header = {"headerId": 0, "timestamp": "2026-01-01T00:00:00.000Z", "version": "3.0.0"}
    sender = {"manufacturer": "mrpbench", "serialNumber": "robot_0"}
    return {**header, **sender, "zoneSet": {"mapId": map, "zoneSetId": id, "zones": list(zones)}}


def send(bench, message):
    bench.vehicle.take_zones(message, validator("3.0", "zoneSet")(message))
    return bench.step(0.0)


def enable(bench, id="set", key="enable", what="enableZoneSet"):
    state = bench.act(bench.action(what, key, "NONE", zoneSetId=id))
    return state, next(it["actionStatus"] for it in state["instantActionStates"] if it["actionId"] == key)


def errors(state):
    return [error["errorType"] for error in state["errors"]]


def refers(state):
    return {it["referenceKey"]: it["referenceValue"] for it in state["errors"][0]["errorReferences"]}


def test_a_zone_set_is_kept_enabled_replaced_and_deleted(bench3):
    state = send(bench3, zone_set(zone(), id="one"))
    assert state["zoneSets"] == [{"zoneSetId": "one", "mapId": "ground", "zoneSetStatus": "DISABLED"}]
    send(bench3, zone_set(zone(), id="two"))
    send(bench3, zone_set(zone(), id="upper", map="upper"))
    for name in ("one", "upper", "two"):
        state, status = enable(bench3, name, f"enable {name}")
        assert status == "FINISHED"
    assert {it["zoneSetId"]: it["zoneSetStatus"] for it in state["zoneSets"]} == {
        "one": "DISABLED",
        "two": "ENABLED",
        "upper": "ENABLED",
    }
    assert enable(bench3, "two", "d1", "deleteZoneSet")[1] == "FAILED"  # it is in use
    state, status = enable(bench3, "one", "d2", "deleteZoneSet")
    assert (status, [it["zoneSetId"] for it in state["zoneSets"]]) == ("FINISHED", ["two", "upper"])
    assert enable(bench3, "one", "d3", "deleteZoneSet")[1] == "FAILED"
    assert enable(bench3, "one", "e3")[1] == "FAILED"


REFUSED = {
    "a set that is there already": (zone_set(id="old"), "DUPLICATE_ZONE_SET"),
    "an unknown map": (zone_set(zone(), map="attic"), "UNKNOWN_MAP_ID"),
    "two vertices": (zone_set({**zone(), "vertices": zone()["vertices"][:2]}), "VALIDATION_FAILURE"),
    "a place that is no number": (
        zone_set({**zone(), "vertices": [*zone()["vertices"], {"x": float("nan"), "y": 0.0}]}),
        "VALIDATION_FAILURE",
    ),
    "no speed": (zone_set(zone("SPEED_LIMIT", maximumSpeed=None)), "VALIDATION_FAILURE"),
    "a speed of zero": (zone_set(zone("SPEED_LIMIT", maximumSpeed=0)), "VALIDATION_FAILURE"),
    "an id twice": (zone_set(zone(), zone()), "VALIDATION_FAILURE"),
    "no zoneType": (zone_set({"zoneId": "z1", "vertices": zone()["vertices"]}), "VALIDATION_FAILURE"),
} | {it: (zone_set(zone(it)), "UNSUPPORTED_PARAMETER") for it in ALL if it not in SUPPORTED}


@pytest.mark.parametrize("case", REFUSED)
def test_a_zone_set_that_is_refused_changes_nothing_but_errors(bench3, case):
    send(bench3, zone_set(id="old"))
    message, kind = REFUSED[case]
    state = send(bench3, message)
    assert errors(state) == [kind]
    assert refers(state)["topic"] == "zoneSet"
    assert [it["zoneSetId"] for it in state["zoneSets"]] == ["old"]
    assert errors(send(bench3, zone_set(id="new"))) == []


@pytest.mark.parametrize("type", ALL)
def test_the_zones_here_are_valid_by_the_published_schema(shared_data, type):
    fastjsonschema = pytest.importorskip("fastjsonschema")
    published = json.loads((shared_data / "vda5050/zoneSet.schema").read_text())
    fastjsonschema.compile(published)(zone_set(zone(type)))
    assert validator("3.0", "zoneSet")(zone_set(zone(type))) is None


def test_no_way_leads_through_a_blocked_zone(bench3):
    send(bench3, zone_set(zone()))
    assert not errors(bench3.take(bench3.order([0, 9], base=2)))  # it is not enabled
    bench3.act(bench3.action("cancelOrder", "c1", "NONE"))
    bench3.step()
    enable(bench3)
    state = bench3.take(bench3.order([0, 9], base=2, id="o2"))
    assert errors(state) == ["NO_ROUTE_TO_TARGET"]
    assert not errors(bench3.take(bench3.order([0, 2], base=2, id="o2")))


def test_a_vehicle_stops_before_a_zone_that_was_enabled_later(bench3):
    send(bench3, zone_set(zone()))
    bench3.take(bench3.order([0, 1, 4], base=3))
    state, _ = enable(bench3)
    assert errors(state) == ["NODE_UNREACHABLE"]
    assert refers(state) == {"nodeId": "n4"}
    assert bench3.may_drive == 2  # at 3 its body would be in the zone
    state = bench3.drive(2)
    assert bench3.may_drive == 0
    bench3.act(bench3.action("cancelOrder", "c1", "NONE"))
    bench3.step()
    assert not errors(bench3.take(bench3.order([2, 0], base=2, id="o2")))


def test_a_vehicle_in_a_blocked_zone_stops_and_leaves_it_by_another_order(bench3):
    send(bench3, zone_set(zone()))
    bench3.take(bench3.order([0, 4], base=2))
    bench3.drive(3)
    state, _ = enable(bench3)
    state = bench3.step()
    assert "BLOCKED_ZONE_VIOLATION" in errors(state)
    (found,) = [it for it in state["errors"] if it["errorType"] == "BLOCKED_ZONE_VIOLATION"]
    assert found["errorLevel"] == "CRITICAL"
    assert found["errorReferences"] == [{"referenceKey": "zoneId", "referenceValue": "z1"}]
    assert bench3.may_drive == 0
    bench3.act(bench3.action("cancelOrder", "c1", "NONE"))
    bench3.step()
    state = bench3.take(bench3.order([3, 4], base=2, id="o2"))
    assert errors(state) == ["BLOCKED_ZONE_VIOLATION"]  # until it is out
    assert errors(bench3.drive()) == []


def test_the_contour_decides_and_only_on_the_map_of_the_zone(bench3):
    send(bench3, zone_set(zone(), id="ground"))
    enable(bench3, "ground")
    for x, level, violated in ((2.39, 0, False), (2.41, 0, True), (2.39, 0, False), (3.0, 1, False)):
        bench3.now += 0.1
        here = Here(now=bench3.now, pose=(x, 0.0, 0.0), level=level, driving=False, gave_up=False)
        bench3.vehicle.advance(here)
        assert ("BLOCKED_ZONE_VIOLATION" in errors(bench3.state())) == violated


def test_the_speed_limit_holds_from_where_a_vehicle_brakes_for_it(bench3):
    send(bench3, zone_set(zone("SPEED_LIMIT", 3.6, 4.4), zone("SPEED_LIMIT", 3.6, 4.4, id="z2", maximumSpeed=0.5)))
    enable(bench3)
    bench3.take(bench3.order([0, 9], base=2, s1={"maximumSpeed": 0.8}))
    robot = bench3.site.fleet.robots[0]
    braking = (robot.max_speed**2 - 0.3**2) / (2 * robot.acceleration)
    assert bench3.paths.speed[0] == 0.8
    for moves in range(1, 8):
        bench3.drive()
        near = 3.6 - braking - robot.radius <= moves <= 4.4 + robot.radius
        if near:
            assert bench3.paths.speed[0] == 0.3  # the lowest of those that compete
    assert bench3.paths.speed[0] == 0.8


def test_the_factsheet_announces_the_zones_that_are_supported(bench3):
    sheet = factsheet_of(bench3.site.fleet.robots[0], bench3.names, (0.1, 1.0, 0.0), False)
    assert sheet["typeSpecification"]["supportedZones"] == ["BLOCKED", "SPEED_LIMIT"]
    actions = {it["actionType"] for it in sheet["protocolFeatures"]["mobileRobotActions"]}
    assert {"downloadZoneSet", "enableZoneSet", "deleteZoneSet"} <= actions


def test_there_are_no_zones_in_2_1(bench):
    state = bench.act(bench.action("enableZoneSet", "e1", "NONE", zoneSetId="set"))
    assert ("zoneSets" in state) == bench.names.zones
    assert bool(errors(state)) == (not bench.names.zones)


@pytest.fixture
def files(tmp_path):
    """A server of files on this machine: its address, and its folder."""

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    handler = functools.partial(Quiet, directory=str(tmp_path))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/", tmp_path
    server.shutdown()
    server.server_close()


def download(bench, key, **parameters):
    """Let a vehicle fetch a zone set; return its first and its last state, and the last of the action."""
    first = bench.act(bench.action("downloadZoneSet", key, "NONE", **parameters))
    until = time.monotonic() + 10
    while bench.instant.restless and time.monotonic() < until:
        time.sleep(0.01)
        bench.step(0.0)
    state = bench.step(0.0)
    (action,) = [it for it in state["instantActionStates"] if it["actionId"] == key]
    return first, state, action


def test_a_zone_set_is_downloaded_once_and_then_enabled(bench3, files):
    url, folder = files
    content = json.dumps({"zoneSet": zone_set(zone(), id="far")["zoneSet"]})  # without a header
    (folder / "far.json").write_text(content)
    right = hashlib.sha256(content.encode()).hexdigest()
    link = {"zoneSetId": "far", "zoneSetDownloadLink": url + "far.json"}
    _, state, action = download(bench3, "d1", **link, zoneSetHash="0" * 64)
    assert (action["actionStatus"], "SHA-256" in action["actionResult"], state["zoneSets"]) == ("FAILED", True, [])
    _, state, action = download(bench3, "d2", **link, zoneSetHash=right)
    assert action["actionStatus"] == "FINISHED"
    assert state["zoneSets"] == [{"zoneSetId": "far", "mapId": "ground", "zoneSetStatus": "DISABLED"}]
    assert errors(state) == []
    _, state, action = download(bench3, "d3", **link)
    assert (action["actionStatus"], errors(state)) == ("FAILED", ["DUPLICATE_ZONE_SET"])
    assert enable(bench3, "far")[1] == "FINISHED"


BAD_LINKS = {
    "a file that is missing": ({"zoneSetDownloadLink": "none.json"}, "404"),
    "a file that is no JSON": ({"zoneSetDownloadLink": "text"}, "not JSON"),
    "another zone set": ({"zoneSetDownloadLink": "other.json"}, "is called 'other'"),
    "a zone that is not supported": ({"zoneSetDownloadLink": "line.json"}, "LINE_GUIDED"),
    "no link": ({"zoneSetDownloadLink": None}, "zoneSetDownloadLink"),
    "a link to the disk of the vehicle": ({"zoneSetDownloadLink": "file:///etc/hostname"}, "no address"),
}


@pytest.mark.parametrize("case", BAD_LINKS)
def test_a_download_that_fails_says_why_and_changes_no_zone_set(bench3, files, case):
    url, folder = files
    (folder / "text").write_text("zones")
    (folder / "other.json").write_text(json.dumps(zone_set(zone(), id="other")))
    (folder / "line.json").write_text(json.dumps(zone_set(zone("LINE_GUIDED"), id="far")))
    given, why = BAD_LINKS[case]
    link = given["zoneSetDownloadLink"]
    parameters = {} if link is None else {"zoneSetDownloadLink": link if ":" in link else url + link}
    _, state, action = download(bench3, "d1", zoneSetId="far", **parameters)
    assert action["actionStatus"] == "FAILED"
    assert why in action["actionResult"]
    assert state["zoneSets"] == []


def test_a_download_leaves_the_vehicle_at_work(bench3):
    with socket.create_server(("127.0.0.1", 0)) as silent:
        link = f"http://127.0.0.1:{silent.getsockname()[1]}/far.json"
        state = bench3.act(bench3.action("downloadZoneSet", "d1", "NONE", zoneSetId="far", zoneSetDownloadLink=link))
        assert [it["actionStatus"] for it in state["instantActionStates"]] == ["RUNNING"]
        bench3.take(bench3.order([0, 1], base=2))
        assert bench3.drive()["lastNodeId"] == "n1"
        assert bench3.instant.restless
    until = time.monotonic() + 10
    while bench3.instant.restless and time.monotonic() < until:
        time.sleep(0.01)
        state = bench3.step(0.0)
    assert [it["actionStatus"] for it in state["instantActionStates"]] == ["FAILED"]
