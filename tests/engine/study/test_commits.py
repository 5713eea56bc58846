"""A run and its files are stored together, or not at all."""

import os
import resource
import shutil
import subprocess
import sys
import types
from pathlib import Path

import pytest

from mrpbench_core.engine.processes.job import Failure, JobOutcome
from mrpbench_core.engine.record import RunRecord
from mrpbench_core.engine.study.commits import Commits, EndedRun
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.jsonl import Writer
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.results import Results

FAILURE = Failure(status=RunStatus.CRASHED, stage=Stage.WORKER, message="x", seconds=0.0)


@pytest.fixture
def folder(tmp_path):
    made = ResultsFolder(tmp_path)
    made.create()
    return made


@pytest.fixture
def commits(folder):
    with Writer(folder.shard("1"), exclusive=True) as shard:
        yield Commits(folder=folder, shard=shard, invocation="0f  invocations/1.yaml", workers=1)


def ended(run_id, attempt=1, failure=None):
    point = types.SimpleNamespace(run_id=run_id, canonical={"seed": 0, "repeat": 0}, code={}, live=False)
    record = None if failure else RunRecord(run_id=run_id)
    return EndedRun(
        point=point, attempt=attempt, outcome=JobOutcome(run_id=run_id, record=record, failure=failure, machine={})
    )


def test_a_kill_at_any_step_leaves_one_whole_attempt():
    program = Path(__file__).with_name("killed_commits.py")
    found = subprocess.run([sys.executable, program], capture_output=True, text=True, timeout=120)
    assert (found.returncode, found.stderr) == (0, "")
    assert found.stdout.endswith(" kills\n")
    assert found.stdout.count("\n") == 1, found.stdout
    assert int(found.stdout.split()[0]) >= 10


def test_runs_that_end_while_the_disk_is_busy_are_stored_together(commits, monkeypatch):
    synced = []
    monkeypatch.setattr(os, "fsync", synced.append)
    monkeypatch.setattr(commits._disk, "submit", Later)
    commits.add([ended("a")])
    commits.add([ended("b")])
    commits.add([ended("c")])
    assert [entry.point.run_id for entry, _ in commits.stored()] == ["a"]
    assert [entry.point.run_id for entry, _ in commits.stored()] == ["b", "c"]
    assert commits.going is None
    assert len(synced) == 2


class Later:
    """A future whose work is done when its result is needed."""

    def __init__(self, work, batch):
        self.work, self.batch = work, batch

    def result(self):
        return self.work(self.batch)


def test_a_run_that_was_ended_while_it_was_measured_keeps_its_recording_and_others_keep_none(commits, folder):
    for run_id, stage in (("a", Stage.METRICS), ("b", Stage.EXECUTION)):
        folder.run(run_id).recording.write_bytes(b"recording")
        folder.run(run_id).exports.mkdir()
        with (folder.run(run_id).exports / "bag").open("wb") as sparse:
            sparse.truncate(2**42)  # whose sum takes hours
        failure = Failure(status=RunStatus.WALL_TIMEOUT, stage=stage, message="late", seconds=1.0)
        commits.add([ended(run_id, failure=failure)])
    commits.close()
    files = {record["run_id"]: record["provenance"]["files"] for record in Results(folder)}
    assert [line.split("  ")[1] for line in files["a"]] == ["recordings/a.zip", "invocations/1.yaml"]
    assert [line.split("  ")[1] for line in files["b"]] == ["invocations/1.yaml"]
    assert not folder.run("b").recording.exists()
    assert not folder.run("a").exports.exists()


def test_a_full_disk_is_one_line_and_keeps_the_records_before(commits, folder):
    commits.add([ended("a")])
    commits.stored()
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (folder.shard("1").stat().st_size + 20, before[1]))
    try:
        commits.add([ended("b")])
        with pytest.raises(InputError, match=r"1\.jsonl: cannot be written: File too large$"):
            commits.close()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert folder.shard("1").read_bytes().count(b"\n") == 1
    assert [record["run_id"] for record in Results(folder)] == ["a"]


@pytest.mark.parametrize(
    "act",
    [
        lambda shard: shard.write_text(""),
        Path.unlink,
        lambda shard: shutil.rmtree(shard.parent),
        lambda shard: shard.write_text(shard.read_text().replace("crashed", "succeed")),
        lambda shard: shard.with_name("9.jsonl").write_text("{}\n"),
    ],
)
def test_a_file_of_records_that_something_else_writes_is_reported_and_loses_no_later_record(
    folder, commits, caplog, act
):
    commits.add([ended("ab", failure=FAILURE)])
    commits.stored()
    act(folder.shard("1"))
    commits.add([ended("cd", failure=FAILURE)])
    commits.close()
    (warning,) = caplog.messages
    assert "was changed while runs were executed, by one of their plugins" in warning
    assert "cd" in Results(folder)


@pytest.mark.parametrize("metrics", [{"x": float("nan")}, {"x": 2**24 * "x"}, {"x": object()}])
def test_a_record_that_could_not_be_read_again_is_a_crash_of_its_run_and_not_repeated(folder, commits, metrics):
    run = ended("ab")
    run.outcome.record.metrics = metrics
    commits.add([run])
    commits.close()
    (record,) = Results(folder)
    assert record["status"] == "crashed"
    assert record["error"]["message"].startswith("the record of the run cannot be stored: ")
