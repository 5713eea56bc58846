"""The content of the page, without a browser."""

import base64
import json
import os
import re
import zlib
from importlib import resources

import numpy as np
import pytest

from mrpbench_core.files.errors import InputError
from mrpbench_core.report.html import listing
from mrpbench_core.report.html import page as page_module
from mrpbench_core.report.html.origin import spans
from mrpbench_core.report.html.page import write_report
from mrpbench_core.report.report import make_report


def test_the_page_is_well_formed_and_loads_nothing(page, parsed):
    text = page.read_text(encoding="utf-8")
    reader = parsed(text)
    assert (reader.wrong, reader.open) == ([], [])
    ids = [value for _, name, value in reader.attributes if name == "id"]
    assert len(ids) == len(set(ids))
    assert not re.search(r"<!--\w+-->", text), "every mark of the template is filled"
    assert "default-src 'none'" in text
    loaded = [value for _, name, value in reader.attributes if name in ("src", "href", "srcset", "action")]
    assert all(value.startswith(("data:", "#")) for value in loaded)
    assert not re.search(r"https?://|@import|url\(", text)


def test_text_of_runs_is_text(page):
    text = page.read_text(encoding="utf-8")
    assert "<b>bad</b>" not in text
    assert "</script><b>" not in text
    assert "&lt;b&gt;bad&lt;/b&gt;" in text


def test_the_page_answers_the_questions_of_a_reviewer(page, parsed):
    words = " ".join(" ".join(parsed(page.read_text(encoding="utf-8")).words).split())
    assert "42 runs: 2 configurations, 12 scenarios." in words
    assert "cbs comes out best" in words
    assert "1.47 [1.26, 1.64]" in words
    assert "9/0/0" in words
    assert "0.004" in words
    for fact in ("Wilson", "seed 0", "0..9, 77, 79", "1999 resamples", "2 times the planning limit", "SHA-256"):
        assert fact in words, fact


def test_every_run_is_in_the_list(page):
    text = page.read_text(encoding="utf-8")
    packed = re.search(r'id="data">([^<]*)<', text)[1]
    data = json.loads(zlib.decompress(base64.b64decode(packed)))
    assert len(data["id"]) == 42
    assert {data["statuses"][number] for number in data["status"]} == {
        "succeeded",
        "plan_timeout",
        "scenario_infeasible",
        "unknown",
    }
    cost = data["values"][data["columns"].index("planning.cost [s]")]
    assert cost[:4] == [20.0, 20.0, 21.0, 21.0]
    assert data["replays"] == {"cbs-0-0-5-": "results/replay-cbs.html"}
    assert "</script><b>no plan" in data["messages"]


def test_groups_have_eight_different_colours_in_either_theme():
    style = (resources.files("mrpbench_core.report.html") / "template" / "style.css").read_text(encoding="utf-8")
    light, _, dark = style.partition('data-theme="dark"')
    for theme in (light, dark):
        assert len(set(re.findall(r"--s\d: (#\w+)", theme))) == 8


def test_a_page_without_anything_to_compare(results, record, tmp_path, parsed):
    write_report(make_report([results([record(status="crashed", scenario=None)])]), tmp_path / "a.html")
    words = " ".join(parsed((tmp_path / "a.html").read_text(encoding="utf-8")).words)
    assert "1 run: 1 configuration, 0 scenarios." in words


def test_a_folder_that_does_not_exist_is_named(study, tmp_path):
    with pytest.raises(InputError, match="cannot be written"):
        write_report(make_report([study], ["planning.cost"]), tmp_path / "no" / "a.html")


def test_numbers_in_a_row_are_a_span():
    assert spans(np.array([3, 1, 2, 7, 9, 10, 2])) == "1..3, 7, 9..10"
    assert spans(np.array([], int)) == ""


def test_a_page_with_very_many_runs_lists_failures_of_every_configuration_first_and_says_so(
    study, tmp_path, monkeypatch
):
    monkeypatch.setattr(listing, "LISTED", 6)
    monkeypatch.setattr(page_module, "LISTED", 6)
    report = make_report([study], ["planning.cost"])
    write_report(report, tmp_path / "report.html")
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "The list has 6 of 42 runs: failed ones first, and every configuration in turn." in text
    data = json.loads(zlib.decompress(base64.b64decode(re.search(r'id="data">([^<]*)<', text)[1])))
    assert (len(data["id"]), data["total"]) == (6, 42)
    assert sorted(data["statuses"][number] for number in data["status"]) == [
        "plan_timeout",
        "plan_timeout",
        "scenario_infeasible",
        "succeeded",
        "succeeded",
        "unknown",
    ]


def test_failures_come_first_and_every_configuration_in_turn(study):
    report = make_report([study], ["planning.cost"])
    found = [(report.runs.status[index] == "succeeded", report.runs.config[index]) for index in report.failures_first()]
    assert sorted(report.failures_first()) == list(range(42))
    assert [succeeded for succeeded, _ in found] == [False] * 4 + [True] * 38
    assert {config for _, config in found[4:6]} == {0, 1}


def test_a_fifo_among_the_records_is_named_and_not_read(results, record, tmp_path):
    folder = results([record(seed=seed) for seed in range(2)])
    os.mkfifo(folder.folder.path / "runs" / "2.jsonl")
    write_report(make_report([folder]), tmp_path / "report.html")
    assert "2.jsonl: cannot be read: it is not a file" in (tmp_path / "report.html").read_text(encoding="utf-8")
