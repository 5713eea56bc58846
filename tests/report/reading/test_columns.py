"""Columns of a report: invocations declare them, installed metrics complete them."""

import numpy as np

from mrpbench_core.api.metric import Column
from mrpbench_core.report.reading.columns import describe_columns, heading, primary_columns, shown_columns

OLD = {"unit": "s", "better": "lower", "description": "how long", "source": ""}
"""A column as invocations of version 0.1 declare it."""


def names(known):
    return [column.name for column in primary_columns(known)]


def test_columns_of_an_older_version_are_shown_as_before():
    known = describe_columns(dict.fromkeys(["execution.duration_s", "execution.success", "planning.makespan"], OLD))
    assert names(known) == [
        *("planning.makespan", "timing.planning_s", "timing.planning_par2_s"),
        "execution.duration_s",
    ]
    assert known["execution.duration_s"].description == "how long", "what the invocation declares counts"
    assert (known["execution.duration_s"].drawn, known["execution.duration_s"].stage) == ("profile", "execution")


def test_columns_without_an_invocation_are_described_by_the_installed_metric():
    known = describe_columns({}, ["execution.robot_contacts", "execution.duration_s"])
    assert list(known)[:2] == ["execution.duration_s", "execution.robot_contacts"], "in the order of the metric"
    assert heading(known["execution.duration_s"]) == "execution.duration_s"
    assert known["execution.duration_s"].unit == "s"


def test_columns_declared_in_a_folder_take_precedence_over_installed_ones():
    own = OLD | {"primary": False, "stage": "planning", "drawn": "interval", "aliases": []}
    known = describe_columns({"execution.duration_s": own, "execution.success": OLD | {"primary": True}})
    assert "execution.duration_s" not in names(known)
    assert known["execution.duration_s"].stage == "planning"
    assert names(known)[-1] == "execution.success"


def test_declarations_that_make_no_sense_do_no_harm():
    known = describe_columns({"x.a": None, "x.b": OLD | {"stage": 3, "drawn": "pie", "primary": None}, "x.c": "text"})
    assert {known[name].stage for name in ("x.a", "x.b", "x.c")} == {"execution"}
    assert {known[name].drawn for name in ("x.a", "x.b", "x.c")} == {"interval"}
    assert not any(name.startswith("x.") for name in names(known))
    odd = {"threshold": "far", "threshold_share": -1, "answers": "everything"}
    x = describe_columns({"x.a": OLD | odd})["x.a"]
    assert (x.threshold, x.threshold_share, x.answers) == (None, 0.0, None)


def test_thresholds_of_an_older_version_are_those_of_the_installed_metric():
    known = describe_columns({"execution.duration_s": OLD, "execution.time_blocked_s": OLD | {"threshold": None}})
    assert (known["execution.duration_s"].threshold, known["execution.duration_s"].answers) == (1.0, "duration")
    assert known["execution.time_blocked_s"].threshold is None


def test_contacts_with_walls_are_shown_if_there_are_any():
    known = {"execution.wall_contacts": Column("execution.wall_contacts", "", "lower", "touches")}
    for values, shown in (([0.0, np.nan], []), ([0.0, 2.0], ["execution.wall_contacts"])):
        columns = shown_columns(known, {"execution.wall_contacts": np.array(values)})
        assert [column.name for column in columns] == shown
    assert shown_columns(known, {}) == []
