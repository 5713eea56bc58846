"""The runs that a study repeats, and those that it keeps."""

import json
import os
import shutil
from pathlib import Path

import pytest

from mrpbench_core import load, run
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.files.yaml import load as load_yaml


def attempts(results):
    return {record["config"]["planner"]["does"]: record["attempt"] for record in results}


def shards():
    return {file.name for file in Path("out/runs").iterdir()}


def test_runs_with_a_record_are_not_repeated(study):
    study["matrix"] = {"seed": "0..2"}
    first = list(run(study, out="out"))
    before = shards()
    assert list(run(study, out="out")) == first
    assert shards() == before
    study["matrix"] = {"seed": "0..4"}
    assert [record["seed"] for record in run(study, out="out")] == [0, 1, 2, 3, 4]
    assert len(shards()) == 2


def test_only_the_studys_own_runs_are_returned(study):
    run(study | {"seed": 7}, out="out")
    assert [record["seed"] for record in run(study | {"seed": 8}, out="out")] == [8]
    assert len(load("out")) == 2


def test_failed_runs_are_done_again_as_the_next_attempt_when_asked(study):
    study["matrix"] = {"planner.does": ["nothing", "exit"]}
    assert attempts(run(study, out="out")) == {"nothing": 1, "exit": 1}
    assert attempts(run(study, out="out", rerun="failed")) == {"nothing": 1, "exit": 2}
    assert attempts(run(study, out="out", rerun="all")) == {"nothing": 2, "exit": 3}
    assert sum(len(file.read_text().splitlines()) for file in Path("out/runs").iterdir()) == 5


@pytest.mark.parametrize("does", ["nothing", "exit"])
def test_the_recording_of_an_earlier_attempt_does_not_pass_for_that_of_the_last(study, does):
    study["planner"]["does"] = does
    (record,) = run(study, out="out")
    stale = [Path(f"out/recordings/{record['run_id']}.zip"), Path(f"out/exports/{record['run_id']}/bag")]
    for file in stale:
        file.parent.mkdir(exist_ok=True)
        file.touch()
    run(study, out="out")
    assert all(file.exists() for file in stale)
    run(study, out="out", rerun="all")
    assert not any(file.exists() for file in stale)


def test_a_folder_in_the_place_of_a_file_costs_its_own_run_only(study):
    study["matrix"] = {"seed": "0..1"}
    first, second = (record["run_id"] for record in run(study, out="first"))
    in_the_way = Path(f"out/recordings/{first}.zip/precious")
    in_the_way.mkdir(parents=True)
    Path("out/runs").mkdir()
    os.mkfifo("out/runs/1.jsonl")
    os.mkfifo(f"out/recordings/{second}.zip")
    with pytest.raises(InputErrors, match=f"{first}.zip: is in the way of a file of a run: Is a directory"):
        run(study, out="out")
    assert [record["run_id"] for record in load("out")] == [second]
    assert in_the_way.exists()


def test_a_changed_local_source_is_noticed(study):
    study["planner"]["does"] = "nothing"
    run(study, out="out")
    source = Path("odd.py")
    source.write_text(source.read_text() + "\n# another thought\n")
    assert attempts(run(study, out="out")) == {"nothing": 1}
    assert attempts(run(study, out="out", rerun="changed")) == {"nothing": 2}


def test_a_shards_records_count_when_they_are_copied_to_another_folder(study):
    study["matrix"] = {"seed": "0..19"}  # not few: the shard of a run depends on its identity, and all might be in one
    part = {record["run_id"] for record in run(study, out="part", shard="0/2")}
    assert 0 < len(part) < 20
    shutil.copytree("part", "out")
    assert len(run(study, out="out")) == 20
    newest = max(Path("out/runs").iterdir(), key=lambda file: file.stat().st_mtime)
    done = {json.loads(line)["run_id"] for line in newest.read_text().splitlines()}
    assert done == {record["run_id"] for record in load("out")} - part


def test_an_invocation_keeps_the_files_that_repeat_it(study):
    run(study, "seed=0..1", out="out")
    (file,) = Path("out/invocations").iterdir()
    facts = load_yaml(file).data
    assert facts["study"] == study
    assert facts["overrides"] == ["seed=0..1"]
    assert "mrpbench-core" in facts["versions"]
    assert load_yaml("out/study.yaml").data == study
    assert f"{facts['invocation']}.jsonl" in shards()


def test_records_survive_a_round_trip_through_json_and_are_complete(study):
    (record,) = run(study, out="out")
    assert json.loads(json.dumps(record, allow_nan=False)) == record
    keys = "run_id scenario_id attempt config seed repeat status metrics timing provenance error plan"
    assert list(record) == keys.split()
    assert set(record["provenance"]) == {"components", "versions", "machine", "live", "files"}


@pytest.mark.parametrize(
    ("options", "what"),
    [
        ({"workers": 0}, "workers: at least 1, got 0"),
        ({"shard": "3/3"}, "--shard 3/3: not i/n"),
        ({"shard": "half"}, "--shard half: not i/n"),
        ({"executor": "proceses"}, "did you mean 'processes'"),
        ({"executor": {"plugin": "processes", "speed": 1}}, "executor.speed: unknown option of 'processes'"),
    ],
)
def test_a_wrong_request_is_refused_before_anything_is_written(study, options, what):
    with pytest.raises((InputError, InputErrors), match=what):
        run(study, out="out", **options)
    assert not Path("out").exists()
