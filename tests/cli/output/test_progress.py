"""The live line."""

import types
from pathlib import Path

import pytest

from mrpbench_core.cli.output import progress
from mrpbench_core.cli.output.progress import Printed
from mrpbench_core.report.reading.axes import word
from mrpbench_core.store.folder import ResultsFolder


def test_a_terminal_has_one_line_of_counts_and_a_line_for_each_failure(capsys, monkeypatch):
    monkeypatch.setattr(progress, "REFRESH_S", 0.0)
    points = [types.SimpleNamespace(run_id=f"{number:016d}", axes={"seed": number}) for number in range(4)]
    results = type("NoResults", (dict,), {"damaged": (), "folder": ResultsFolder(Path("out"))})()
    shown = Printed(live=True)
    chosen = tuple(point.run_id for point in points)
    shown.selected(types.SimpleNamespace(todo=points, chosen=chosen, changed=("x",)), results)
    for point in points[:3]:
        shown.started(point)
    shown.finished(points[0], {"run_id": points[0].run_id, "status": "succeeded"})
    error = {"stage": "planning", "message": "ValueError: no"}
    shown.finished(points[1], {"run_id": points[1].run_id, "status": "crashed", "error": error})
    shown.lost(points[2], "killed")
    shown.close()
    output = capsys.readouterr().out
    out = Path("out").absolute()
    assert output.startswith(f"{out}: 4 of 4 runs to do, 0 recorded\n1 recorded runs were made with other versions")
    permanent = [part for part in output.split("\r\x1b[K") if part.endswith("\n")][1:]
    assert permanent == [
        f"[2/4] 000000000000 crashed seed=1: ValueError: no; see {out}/logs/0000000000000001.txt\n",
        "000000000000 is repeated: killed\n",
    ]
    assert "[2/4] 1 succeeded, 1 crashed · 0:00, about 0:00 left · 000000000000" in output
    assert output.endswith("\r\x1b[K")


def test_each_study_of_a_command_is_counted_from_one(capsys):
    shown = Printed(live=False)
    point = types.SimpleNamespace(run_id="0" * 16, axes={})
    results = type("NoResults", (dict,), {"damaged": (), "folder": ResultsFolder(Path("out"))})()
    for _ in range(2):
        shown.selected(types.SimpleNamespace(todo=[point], chosen=(point.run_id,), changed=()), results)
        shown.started(point)
        shown.finished(point, {"run_id": point.run_id, "status": "succeeded"})
    assert capsys.readouterr().out.count("[1/1] 000000000000 succeeded") == 2


def test_long_studies_say_without_a_terminal_how_long_they_take(capsys, monkeypatch):
    now = [100.0]
    monkeypatch.setattr(progress.time, "monotonic", lambda: now[0])
    shown = Printed(live=False)
    points = [types.SimpleNamespace(run_id=f"{number:016d}", axes={}) for number in range(9)]
    results = type("NoResults", (dict,), {"damaged": (), "folder": ResultsFolder(Path("out"))})()
    shown.selected(types.SimpleNamespace(todo=points, chosen=[point.run_id for point in points], changed=()), results)
    for point in points[:3]:
        now[0] += 40.0
        shown.started(point)
        shown.finished(point, {"run_id": point.run_id, "status": "succeeded"})
    told = [line for line in capsys.readouterr().out.splitlines() if "after" in line]
    assert told == ["2 of 9 runs after 1:20, about 4:40 left"]


def test_a_limit_that_is_shorter_than_the_plan_is_said_once(capsys):
    shown = Printed(live=True)
    points = [types.SimpleNamespace(run_id=f"{number:016d}", axes={}) for number in range(3)]
    results = type("NoResults", (dict,), {"damaged": (), "folder": ResultsFolder(Path("out"))})()
    shown.selected(types.SimpleNamespace(todo=points, chosen=(), changed=()), results)
    for point, takes in zip(points, (8.0, 42.4, 50.0), strict=True):
        shown.started(point)
        config = {"limits": {"execution": 10.0}}
        record = {"run_id": point.run_id, "config": config, "metrics": {"planning.makespan": takes}}
        shown.finished(point, record | {"status": "goals_missed"})
    (note,) = [line for line in capsys.readouterr().out.splitlines() if "note:" in line]
    assert "000000000000 takes 42 s, and limits.execution is 10 s" in note


def test_the_live_line_does_not_wrap(capsys, monkeypatch):
    monkeypatch.setattr(progress, "REFRESH_S", 0.0)
    monkeypatch.setenv("COLUMNS", "40")
    shown = Printed(live=True)
    for number in range(9):
        shown.started(types.SimpleNamespace(run_id=f"{number:016d}", axes={}))
    lines = capsys.readouterr().out.split("\r\x1b[K")
    assert max(map(len, lines)) == 39


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ("cbs", "cbs"),
        (1.5, "1.5"),
        ({"plugin": "ecbs", "w": 1.2}, "ecbs[w=1.2]"),
        ([{"robot": "burger"}, {"plugin": "a", "b": {"plugin": "c", "d": 1}}], "[burger,a[b=c[d=1]]]"),
    ],
)
def test_an_axis_value_is_said_in_few_words(value, text):
    assert word(value) == text


def test_the_live_line_says_how_far_a_single_run_is(capsys, monkeypatch):
    monkeypatch.setattr(progress, "REFRESH_S", 0.0)
    monkeypatch.setenv("COLUMNS", "120")
    shown = Printed(live=True)
    shown.started(types.SimpleNamespace(run_id="abc", axes={}))
    facts = {"simulated_s": 34.05, "limit_s": 600.0, "arrived": 3, "robots": 9}
    shown.going([{"run_id": "abc", **facts}])
    assert capsys.readouterr().out.endswith("abc: 34 of 600 s simulated, 3 of 9 robots arrived")
    shown.started(types.SimpleNamespace(run_id="def", axes={}))
    assert capsys.readouterr().out.endswith("abc (34/600 s, 3/9) def")


@pytest.mark.parametrize(("live", "interval"), [(True, progress.GOING_S), (False, None)])
def test_only_a_terminal_is_kept_up_to_date_during_runs(live, interval):
    assert Printed(live=live).interval_s == interval
