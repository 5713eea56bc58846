"""`mrpbench run` and what reads its results."""

import json
from pathlib import Path


def records(folder):
    return [json.loads(line) for file in Path(folder).iterdir() for line in file.read_text().splitlines()]


def test_overrides_may_stand_anywhere(mrpbench):
    words = ["run", "scenario.robots=1", "--workers", "2", "tiny.yaml", "--dry-run", "--json", "seed=3..5"]
    code, output, errors = mrpbench(*words)
    assert (code, errors) == (0, "")
    runs = json.loads(output)
    assert [(entry["config"]["seed"], entry["config"]["scenario"]["robots"]) for entry in runs] == [
        (3, 1),
        (4, 1),
        (5, 1),
    ]
    assert not Path("results").exists()


def test_a_study_is_run_reported_and_not_done_twice(mrpbench):
    code, output, errors = mrpbench("run", "tiny.yaml")
    assert (code, errors) == (0, "")
    lines = output.splitlines()
    assert lines[0].startswith("plugins: mrpbench-core ")
    assert "mrpbench-standard" in lines[0]
    assert lines[1].endswith("results/tiny: 2 of 2 runs to do, 0 recorded")
    assert lines[2].startswith("[1/2] ")
    assert lines[2].endswith(" succeeded seed=0")
    assert lines[-2:] == [
        "2 runs: 2 succeeded; results in results/tiny",
        "for intervals, comparisons and an HTML page: `mrpbench report results/tiny`",
    ]
    assert "0 of 2 runs to do, 2 recorded" in mrpbench("run", "tiny.yaml")[1]


def test_records_are_printed_as_json_on_request(mrpbench):
    code, output, errors = mrpbench("run", "tiny.yaml", "--json")
    assert code == 0
    assert json.loads(output) == [{"out": "results/tiny", "runs": 2, "statuses": {"succeeded": 2}}]
    assert "2 runs: 2 succeeded" in errors


def test_a_damaged_line_does_not_stop_a_study(mrpbench):
    mrpbench("run", "tiny.yaml")
    (shard,) = Path("results/tiny/runs").iterdir()
    shard.write_bytes(b"{]\n" + shard.read_bytes().partition(b"\n")[2])
    code, output, errors = mrpbench("run", "tiny.yaml")
    assert code == 0
    assert f"{shard.name}:1: is not a record" in errors
    assert "1 of 2 runs to do, 1 recorded" in output
    code, output, errors = mrpbench("report", "results/tiny")
    assert code == 0
    assert "2/2" in output


def test_points_that_cannot_be_run_are_told_and_the_others_run(mrpbench):
    study = Path("tiny.yaml").read_text().replace("seed: 0..1", "planner.order: [given, sideways]")
    Path("tiny.yaml").write_text(study)
    code, output, errors = mrpbench("run", "tiny.yaml")
    assert code == 1
    assert "sideways" in errors
    assert errors.count("\n") == 1
    assert "1 run: 1 succeeded" in output


def test_a_crash_is_exit_code_1_and_the_log_is_named(mrpbench):
    Path("bad.py").write_text(
        "import attrs\nfrom mrpbench_core.api import Planner\n"
        "@attrs.frozen(kw_only=True)\nclass Bad(Planner):\n    def plan(self, problem, budget):\n"
        "        raise ValueError('no')\n"
    )
    code, output, _ = mrpbench("run", "tiny.yaml", "planner=./bad.py:Bad", "seed=0")
    assert code == 1
    assert ": ValueError: no (bad.py:6)" in output
    assert "results/tiny/logs shows why runs crashed" in output
    assert mrpbench("run", "tiny.yaml", "planner=./bad.py:Bad", "seed=0")[0] == 1


def test_a_frozen_scenario_is_the_one_the_study_draws(mrpbench):
    code, output, _ = mrpbench("scenario", "tiny.yaml", "seed=1", "--write", "frozen.yaml")
    assert code == 0
    mrpbench("run", "tiny.yaml", "seed=1")
    (record,) = records("results/tiny/runs")
    assert record["scenario_id"] in output
    frozen = "scenario={plugin: file, file: frozen.yaml}"
    mrpbench("run", "tiny.yaml", frozen, "seed=1", "--out", "again")
    (again,) = records("again/runs")
    assert again["scenario_id"] == record["scenario_id"]
    assert again["run_id"] != record["run_id"]


def test_the_file_of_init_is_valid_and_is_not_overwritten(mrpbench):
    assert mrpbench("init", "mine")[0] == 0
    code, output, errors = mrpbench("run", "mine.yaml", "--dry-run", "--json")
    assert (code, errors) == (0, "")
    assert len(json.loads(output)) == 6
    before = Path("mine.yaml").read_text()
    code, _, errors = mrpbench("init", "mine.yaml")
    assert (code, errors) == (2, "mine.yaml: exists already (choose another NAME)\n")
    assert Path("mine.yaml").read_text() == before
