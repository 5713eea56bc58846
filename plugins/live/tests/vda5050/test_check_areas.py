"""The check of corridors and zones: it passes our vehicle, and names what one breaks that does not keep to them."""

import itertools
import json
import time
import urllib.request

import pytest
from mrpbench_live.vda5050.check.areas import RULES, AreaCheck
from mrpbench_live.vda5050.check.conversation import Conversation
from mrpbench_live.vda5050.check.rules import BROKEN, PASSED, Report
from mrpbench_live.vda5050.condition import Here
from mrpbench_live.vda5050.messages import factsheet_of
from mrpbench_live.vda5050.schemas import validator

THERE = (6.0, 0.0)


class Direct(Conversation):
    """A conversation without a wire, with the vehicle of a bench that drives; `lie` changes what it says."""

    address = "127.0.0.1"

    def __init__(self, bench, lie=lambda state: None, sheet=lambda sheet: None):
        self.names, self.patience, self.bench, self._lie = bench.names, 1.0, bench, lie
        self.newest, self.count, self.states = {}, {}, None
        self._ids, self._numbers = itertools.count(), itertools.count()
        factsheet = factsheet_of(bench.site.fleet.robots[0], bench.names, (0.1, 1.0, 0.0), False)
        sheet(factsheet)
        self.newest["factsheet"] = factsheet
        self.x, self.y, self.obeys = 0.0, 0.0, True
        self.tick()

    def header(self, topic):
        return self.bench._header()

    def publish(self, topic, body):
        message = body if "headerId" in body else {**self.bench._header(), **body}
        fault = validator("3.0" if self.names.zones else "2.1", topic)(message)
        assert fault is None
        if topic == "order":
            self.bench.vehicle.take_order(message, fault)
        elif topic == "instantActions":
            self.bench.instant.take(message, fault)
        else:
            self.bench.vehicle.take_zones(message, fault)

    def wait(self, topic, holds, seconds=None):
        for _ in range(300):
            if holds(self.newest[topic]):
                return True
            if self.bench.instant.restless:  # a download takes wall time
                time.sleep(0.02)
            self.tick()
        return False

    def tick(self):
        """Drive on for a tenth of a second, within a metre of each move."""
        bench, paths = self.bench, self.bench.paths
        passed, allowed = int(paths.passed[0]), int(paths.allowed[0])
        driving = allowed > passed
        speed = min(float(paths.speed[0]), 1.0) if driving else 0.0
        if driving:
            paths.released[0] = max(paths.released[0], passed + 1)
            head = float(bench.site.roadmap.position[bench.site.roadmap.edges[paths.after(0, passed)[0], 1], 0])
            step = max(-0.1 * speed, min(0.1 * speed, head - self.x))
            self.x += step
            if abs(self.x - head) < 1e-6:
                paths.passed[0] += 1
        bench.now += 0.1
        bench.instant.advance()
        here = Here(
            now=bench.now,
            pose=(self.x, self.y, 0.0),
            level=0,
            driving=driving,
            gave_up=False,
            velocity=(speed, 0.0, 0.0),
        )
        bench.vehicle.advance(here)
        state = bench.state()
        self._lie(state)
        self.newest["state"] = state
        if self.states is not None:
            self.states.append(state)


def found(direct, drive=THERE):
    report = Report(RULES)
    AreaCheck(direct, report, drive).run()
    return report.findings


def test_our_vehicle_keeps_all_that_applies_to_it(bench):
    findings = found(Direct(bench))
    zones = {name for name in RULES if not name.startswith("corridor")} if bench.names.zones else set()
    assert {name for name, it in findings.items() if it.verdict == PASSED} == {"corridor", *zones}
    assert {name for name, it in findings.items() if it.verdict == BROKEN} == set()
    assert all(it.reason for it in findings.values() if it.verdict != PASSED)


def test_without_a_place_nothing_moves_the_vehicle(bench3):
    direct = Direct(bench3)
    findings = found(direct, None)
    asked = {"blocked_ahead", "speed_limit", "corridor"}
    assert all("--drive" in findings[name].reason for name in asked)
    assert findings["blocked_inside"].verdict == PASSED
    assert direct.x == 0.0
    assert [it["zoneSetStatus"] for it in direct.state["zoneSets"]] == ["ENABLED"]  # an empty one


def test_the_zone_set_that_was_enabled_is_enabled_again(bench3):
    direct = Direct(bench3)
    own = {"mapId": "ground", "zoneSetId": "own", "zones": []}
    direct.publish("zoneSet", {**bench3._header(), "zoneSet": own})
    direct.act("enableZoneSet", zoneSetId="own")
    direct.tick()
    found(direct, None)
    assert direct.state["zoneSets"] == [{"zoneSetId": "own", "mapId": "ground", "zoneSetStatus": "ENABLED"}]


def without(kind):
    def lie(state):
        state["errors"] = [it for it in state["errors"] if it["errorType"] != kind]

    return lie


def all_enabled(state):
    for it in state["zoneSets"]:
        it["zoneSetStatus"] = "ENABLED"


def all_enabled_later(state):
    if len({it["zoneSetStatus"] for it in state["zoneSets"]}) == 2:
        all_enabled(state)


def fast(state):
    state["velocity"]["vx"] *= 2


def into_the_zone(state):
    if "NO_ROUTE_TO_TARGET" in [it["errorType"] for it in state["errors"]]:
        state["mobileRobotPosition"] |= {"x": 6.1, "y": 0.0}


def aside(state):
    state["mobileRobotPosition"]["y"] += 1.2 if state["driving"] else 0.0


def forgotten(state):
    state["zoneSets"] = [it for it in state["zoneSets"] if it["zoneSetStatus"] == "ENABLED"]


class Keeps:
    """Reports each zone set that it had, also when it is deleted."""

    def __init__(self):
        self.known = {}

    def __call__(self, state):
        for it in state["zoneSets"]:
            self.known[it["zoneSetId"]] = it
        state["zoneSets"] = [dict(it) for it in self.known.values()]


LIES = {
    "zone_set": (all_enabled, "is not DISABLED"),
    "zone_duplicate": (without("DUPLICATE_ZONE_SET"), "no error DUPLICATE_ZONE_SET"),
    "zone_download": (forgotten, "is not DISABLED"),
    "zone_enable": (all_enabled_later, "enabled: "),
    "zone_delete": (Keeps(), "still in the state"),
    "blocked_inside": (without("BLOCKED_ZONE_VIOLATION"), "no error BLOCKED_ZONE_VIOLATION"),
    "blocked_ahead": (into_the_zone, "came into the zone"),
    "speed_limit": (fast, "1.00 m/s instead of 0.50 m/s"),
    "corridor": (aside, "outside without an error"),
}


@pytest.mark.parametrize("rule", LIES)
def test_a_vehicle_that_breaks_a_rule_is_told_by_which_state(bench3, rule):
    lie, reason = LIES[rule]
    findings = found(Direct(bench3, lie))
    assert findings[rule].verdict == BROKEN
    assert reason in findings[rule].reason
    assert findings[rule].message is not None


def test_a_factsheet_without_zones_and_corridors_is_believed(bench3):
    def bare(sheet):
        del sheet["typeSpecification"]["supportedZones"]
        sheet["protocolFeatures"]["optionalParameters"] = []

    findings = found(Direct(bench3, sheet=bare))
    assert findings["zone_types"].verdict == BROKEN
    assert findings["corridor_unsupported"].verdict == BROKEN  # it took the corridor
    assert findings["speed_limit"].reason == "the vehicle understands no zones"


def test_what_is_downloaded_is_served_on_this_machine(bench3, monkeypatch):
    links, opened = [], urllib.request.urlopen

    def watched(link, timeout):
        links.append(link)
        return opened(link, timeout=timeout)

    monkeypatch.setattr(urllib.request, "urlopen", watched)
    assert found(Direct(bench3), None)["zone_download"].verdict == PASSED
    (link,) = links
    assert json.dumps(link).startswith('"http://127.0.0.1:')
