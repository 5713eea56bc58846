"""Bundles of honest results pass: of failures, of repeated attempts, of shards, of studies that were killed."""

import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from mrpbench_core import load, run
from mrpbench_core.files.errors import InputError


def test_executions_pass_also_when_they_are_repeated(honest, judged):
    assert judged(honest / "tiny.zip", rerun=0.5, seed="3") == {}


def test_the_same_results_give_the_same_bytes(honest, bundle, tmp_path):
    written = bundle(honest / "results", tmp_path / "again.zip", inputs=honest)
    assert (tmp_path / "again.zip").read_bytes() == (honest / "tiny.zip").read_bytes()
    assert written.runs == written.recordings == 4


def test_half_of_the_recordings_are_drawn_by_the_ids(honest, bundle, judged, tmp_path):
    assert bundle(honest / "results", tmp_path / "half.zip", inputs=honest, recordings=0.5).recordings == 2
    assert judged(tmp_path / "half.zip") == {}


@pytest.fixture
def failures(study):
    """Return results of runs that crash, time out, find nothing, and are repeated."""
    study["limits"] = {"planning": 0.3, "wall": 30.0}
    study["matrix"] = {"planner.does": ["nothing", "exit", "hang", "system_exit"], "seed": "0..1"}
    run(study, out="out")
    run(study, out="out", rerun="failed")
    return Path("out")


def test_failures_pass_and_are_equal_when_they_are_repeated(failures, bundle, judged):
    bundle(failures, Path("failures.zip"))
    statuses = load(failures).statuses()
    assert statuses == {"plan_unsolvable": 2, "crashed": 4, "plan_timeout": 2}
    assert judged(Path("failures.zip"), rerun=1.0, seed="1", trusted=True) == {}


def test_plans_that_the_dispatcher_refuses_pass(honest, bundle, judged, tmp_path):
    run(honest / "tiny.yaml", "planner=astar", "scenario.robots=6", "seed=0..3", out=tmp_path / "out")
    assert "execution_aborted" in load(tmp_path / "out").statuses()
    bundle(tmp_path / "out", tmp_path / "refused.zip", inputs=honest)
    assert judged(tmp_path / "refused.zip") == {}


def test_local_plugins_are_not_executed_unless_they_are_trusted(study, bundle, judged):
    run(study, out="out")
    Path("odd.py").write_text(Path("odd.py").read_text())
    bundle(Path("out"), Path("local.zip"))
    Path("odd.py").unlink()
    assert judged(Path("local.zip"), rerun=1.0, seed="1")["study"] == (
        "every run of the study needs local plugins, which are not executed (--trust-sources executes them)",
    )
    assert judged(Path("local.zip"), rerun=1.0, seed="1", trusted=True) == {}


def test_shards_become_one_bundle(honest, bundle, judged, tmp_path):
    for index in range(2):
        run(honest / "tiny.yaml", "simulator=none", "seed=0..3", out=tmp_path / str(index), shard=f"{index}/2")
    with pytest.raises(InputError, match="of 8 of the study have no record"):
        bundle(tmp_path / "0", tmp_path / "shards.zip", inputs=honest)
    folders = [tmp_path / "0", tmp_path / "1"]
    assert bundle(folders, tmp_path / "shards.zip", inputs=honest).runs == 8
    assert judged(tmp_path / "shards.zip", rerun=0.5, seed="1") == {}


def test_a_study_that_was_killed_and_continued_passes(honest, bundle, judged, tmp_path):
    out = tmp_path / "killed"
    words = [str(honest / "tiny.yaml"), "simulator=none", "seed=0..19"]
    command = [sys.executable, "-m", "mrpbench_core.cli.main", "run", *words, "--out", str(out)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as going:
        for line in going.stdout:
            if line.startswith("[1/"):
                going.send_signal(signal.SIGKILL)
    with next((out / "runs").iterdir()).open("a") as shard:
        shard.write('{"run_id": "cut')  # as by a loss of power
    with pytest.raises(InputError, match="the study is unfinished"):
        bundle(out, tmp_path / "killed.zip", inputs=honest)
    run(words[0], *words[1:], out=out)
    bundle(out, tmp_path / "killed.zip", inputs=honest)
    assert judged(tmp_path / "killed.zip") == {}


def test_files_with_full_names_are_part_of_the_bundle(honest, bundle, judged, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shutil.copytree(honest / "maps", tmp_path / "maps")
    study = {
        "world": {"plugin": "movingai", "file": str(tmp_path / "maps" / "tiny.map")},
        "roadmap": "grid",
        "scenario": {"plugin": "random", "robots": 2},
        "assigner": "identity",
        "planner": "cbs",
        "simulator": "none",
    }
    run(study, out="out")
    bundle(tmp_path / "out", tmp_path / "full.zip", inputs=tmp_path)
    shutil.rmtree(tmp_path / "maps")
    assert judged(tmp_path / "full.zip", rerun=1.0, seed="1") == {}
