"""Properties: kinds of failures, bounds and comparisons, and the margins that give a search its direction."""

import pytest
from mrpbench_search.hunting.properties import failures, read_property
from mrpbench_search.hunting.reasons import signature

from mrpbench_core.api.metric import Column
from mrpbench_core.files.errors import InputError

DURATION = Column("execution.duration_s", "s", "lower", "")
COLUMNS = {DURATION.name: DURATION}


def record(status="succeeded", **metrics):
    named = {name.replace("__", "."): value for name, value in metrics.items()}
    return {"status": status, "metrics": named, "config": {"limits": {"execution": 100.0}}}


def reading(text, candidates=("",), column=DURATION):
    return read_property(text, candidates, COLUMNS, column)


@pytest.mark.parametrize(
    ("shown", "kinds"),
    [
        (record(), ()),
        (record("plan_invalid"), ("invalid",)),
        (record("crashed"), ("crash",)),
        (record("goals_missed", deadlock__unresolved=True), ("deadlock",)),
        (record("goals_missed", deadlock__unresolved=False), ("stuck",)),
        (
            record("goals_missed", planning__makespan=101.0),
            ("a plan that takes longer than `limits.execution`",),
        ),
        (record("goals_missed", planning__makespan=101.0, deadlock__unresolved=True), ("deadlock",)),
        (record("goals_missed", planning__makespan=99.0), ("stuck",)),
        (record(execution__robot_contacts=1), ("contact",)),
        (record(people__contacts_per_robot_h=3.0), ("contact",)),
        (record(execution__duration_s=21.0, planning__makespan=10.0), ("late",)),
        (record("plan_timeout"), ("no_plan",)),
        (record("plan_not_found"), ("no_plan",)),
        (record("plan_unsolvable"), ()),
        (record("scenario_infeasible"), ()),
    ],
)
def test_failures_are_told_from_statuses_and_metrics(shown, kinds):
    assert failures(shown) == kinds


@pytest.mark.parametrize(
    ("text", "worse", "better"),
    [
        ("contact", {"clearance__robots_min_m": 0.1}, {"clearance__robots_min_m": 0.2}),
        ("deadlock", {"deadlock__longest_s": 9.0}, {"deadlock__longest_s": 2.0}),
        ("stuck", {"execution__duration_s": 90.0}, {"execution__duration_s": 20.0}),
        (
            "late",
            {"execution__duration_s": 18.0, "planning__makespan": 10.0},
            {"execution__duration_s": 11.0, "planning__makespan": 10.0},
        ),
        ("execution.duration_s > 60", {"execution__duration_s": 59.0}, {"execution__duration_s": 20.0}),
    ],
)
def test_a_run_that_is_nearer_to_failing_has_a_smaller_margin(text, worse, better):
    tried = reading(text)
    margins = [tried.judge([record(**metrics)]).margin for metrics in (worse, better)]
    assert 0 <= margins[0] < margins[1]


def test_a_broken_property_has_a_negative_margin_and_names_the_failure():
    verdict = reading("contact").judge([record(execution__wall_contacts=2, clearance__walls_min_m=0.0)])
    assert verdict.margin < 0
    assert verdict.failures == ("contact",)
    verdict = reading("execution.duration_s > 60").judge([record(execution__duration_s=61.0)])
    assert verdict.failures == ("execution.duration_s > 60",)


def test_failures_that_are_not_searched_for_are_told_apart():
    verdict = reading("contact").judge([record("crashed")])
    assert (verdict.margin, verdict.failures, verdict.others) == (None, (), ("crash",))


def test_a_candidate_is_worse_by_more_than_a_share_or_by_failing_alone():
    tried = reading("dwb worse than rpp by 20 %", ("rpp", "dwb"))
    near, beyond = (
        tried.judge([record(execution__duration_s=10.0), record(execution__duration_s=took)]) for took in (11.0, 12.5)
    )
    assert near.margin == pytest.approx(0.1)
    assert beyond.margin == pytest.approx(-0.05)
    assert beyond.failures == ("dwb worse than rpp by 20 %",)
    assert tried.judge([record(execution__duration_s=10.0), record("goals_missed")]).margin == -1
    assert tried.judge([record("goals_missed"), record("goals_missed")]).margin is None


@pytest.mark.parametrize(
    ("text", "candidates", "message"),
    [
        ("boredom", ("",), "not a failure"),
        ("deadlock", ("cbs", "pbs"), "the study has 2 candidates"),
        ("execution.duration > 3", ("",), "the study has no column execution.duration"),
        ("cbs worse than pibt by 20 %", ("cbs", "pbs"), "no candidate 'pibt'"),
    ],
)
def test_mistakes_are_named(text, candidates, message):
    with pytest.raises(InputError, match=message):
        reading(text, candidates)


def test_the_same_failure_of_other_robots_at_other_times_has_the_same_signature():
    robots = [f"robot_{index}" for index in range(12)]
    one = signature("stuck", "robot_1 waits for robot_11, which stopped for good at 5.0 s", robots)
    assert one == signature("stuck", "robot_10 waits for robot_2, which stopped for good at 41.5 s", robots)
    assert one != signature("stuck", "robot_1 waits for door_2", robots)


def test_the_number_and_the_order_of_robots_that_are_listed_make_no_other_failure():
    many = "not all arrived: robot_0 waits for robot_2; robot_2 was under way; robot_3 waits for robot_0; … (4 robots)"
    few = "not all arrived: robot_1 was under way; robot_2 waits for robot_1"
    robots = [f"robot_{index}" for index in range(4)]
    assert signature("deadlock", many, robots) == signature("deadlock", few, robots)
    assert signature("deadlock", many, robots) != signature(
        "deadlock", "not all arrived: robot_1 was under way", robots
    )
