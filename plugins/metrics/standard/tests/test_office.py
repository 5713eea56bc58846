"""All metrics on a true run in the office: what they say of one thing agrees."""

import pytest

from mrpbench_core import run

DEFAULTS = ["planning", "execution"]
OTHERS = ["clearance", "contact", "deadlock", "delay", "efficiency"]
OTHERS += ["fairness", "smoothness", "stops", "throughput", "tracking"]


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    setting = {"world": "office", "scenario": {"plugin": "random", "robots": 5}, "planner": "prioritized"}
    (record,) = run({**setting, "seed": 3, "metrics": DEFAULTS + OTHERS}, out=tmp_path_factory.mktemp("office"))
    assert record["status"] == "succeeded", record.get("error")
    return record["metrics"]


def test_all_columns_have_values_except_those_of_events_that_did_not_happen(measured):
    unknown = {name for name, value in measured.items() if value is None and name.split(".")[0] in OTHERS}
    assert unknown <= {"contact.first_s", "contact.force_max_n"}


def test_delays_are_service_times_beyond_the_plan(measured):
    assert measured["delay.robots"] == measured["throughput.tasks"] == measured["execution.goals_reached"] == 5
    late = 5 * measured["throughput.service_mean_s"] - measured["planning.sum_of_costs"]
    assert 5 * measured["delay.mean_s"] == pytest.approx(late)
    assert measured["throughput.service_max_s"] == measured["execution.duration_s"]
    assert 1 / 5 <= measured["fairness.jain"] <= 1


def test_ways_agree(measured):
    assert 0 < measured["efficiency.spl"] <= 1
    assert measured["efficiency.planned_detour"] >= 1
    ratio = measured["efficiency.path_efficiency"] * measured["efficiency.detour"]
    assert ratio == pytest.approx(measured["efficiency.planned_detour"])
    driven = measured["planning.distance_m"] / measured["efficiency.path_efficiency"]
    coasted = measured["execution.distance_m"] - driven
    assert 0 <= coasted < 5 * 0.1, "what robots still drive after arriving within the tolerance of their goal"


def test_no_robot_is_nearer_than_the_nearest(measured):
    assert (
        measured["execution.min_clearance_m"] <= measured["clearance.robots_min_m"] <= measured["clearance.robots_p5_m"]
    )
    assert measured["contact.robot_time_s"] == measured["execution.robot_contacts"] == 0
    assert 0 < measured["clearance.walls_min_m"] <= measured["clearance.walls_p50_m"]


def test_a_perfectly_kinematic_robot_stays_on_its_path(measured):
    assert measured["tracking.mean_m"] <= measured["tracking.p95_m"] <= measured["tracking.max_m"] < 0.2
    assert measured["smoothness.normalised_jerk"] > 18.9, "no way from rest to rest is smoother than the smoothest"
    assert not measured["deadlock.unresolved"]
    assert measured["stops.standing_released_s"] <= measured["stops.standing_s"]
