"""An executor is a plugin: what it returns is required to be about the run that it was given."""

import re
import threading
import time
import types
from concurrent.futures import Executor, Future
from pathlib import Path

import attrs
import pytest

from mrpbench_core import load
from mrpbench_core.api.executor import ExecutorSource
from mrpbench_core.engine.processes.job import Failure, Job, JobOutcome
from mrpbench_core.engine.record import RunRecord
from mrpbench_core.engine.study import calls
from mrpbench_core.engine.study.calls import Calls, opened
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.invocation import write_document

RUN = RunRecord(run_id="ab")
FAILURE = Failure(status=RunStatus.CRASHED, stage=Stage.WORKER, message="", seconds=0.0)
SUM = 64 * "0"


class UnspeakableError(Exception):
    def __str__(self):
        raise SystemExit


@attrs.frozen(kw_only=True)
class Given(ExecutorSource):
    """Opens what it is given."""

    executor: object = None

    def open(self, workers):
        return self.executor


@pytest.fixture
def judged(tmp_path):
    """Return a function: what is made of an outcome, or of an exception, that an executor returns for the run `ab`."""
    paths = ResultsFolder(tmp_path).run("ab")
    paths.recording.parent.mkdir()
    paths.recording.touch()
    job = Job(
        run_id="ab", parcel={}, facts={}, keep="all", paths=paths, log=tmp_path / "log", wall_s=1.0, memory_bytes=1
    )

    def judge(returned):
        future = Future()
        if isinstance(returned, BaseException):
            future.set_exception(returned)
        else:
            future.set_result(returned)
        return Calls(executor=Executor(), source=Given(), slots="").outcome(future, job)

    return judge


@pytest.mark.parametrize(
    "part", [{"record": RUN}, {"record": attrs.evolve(RUN, files=[f"{SUM}  recordings/ab.zip"])}, {"failure": FAILURE}]
)
def test_outcomes_of_runs_go_through(judged, part):
    outcome = JobOutcome(run_id="ab", **part)
    assert judged(outcome) is outcome


@pytest.mark.parametrize(
    ("returned", "said"),
    [
        (None, "returned for the run ab NoneType"),
        ({"run_id": "ab"}, "returned for the run ab dict"),
        (JobOutcome(run_id="ab"), "neither a record nor a failure"),
        (JobOutcome(run_id="ab", record=RUN, failure=FAILURE), "or several of them"),
        (JobOutcome(run_id="ab", mistake=5), "a mistake that is not text"),
        (JobOutcome(run_id="cd", failure=FAILURE), "the outcome of 'cd'"),
        (JobOutcome(run_id="ab", record=RunRecord(run_id="cd")), "the outcome of 'cd'"),
        (JobOutcome(run_id="ab", record="succeeded"), "not an outcome of a run"),
        (JobOutcome(run_id="ab", record=attrs.evolve(RUN, status="great")), "not an outcome of a run"),
        (JobOutcome(run_id="ab", record=attrs.evolve(RUN, timing=None)), "not an outcome of a run"),
        (JobOutcome(run_id="ab", failure="bad"), "not an outcome of a run"),
        (JobOutcome(run_id="ab", record=attrs.evolve(RUN, files=[f"{SUM}  recordings/cd.zip"])), "of something else"),
        (JobOutcome(run_id="ab", record=attrs.evolve(RUN, files=[f"{SUM}  exports/ab/../x"])), "of something else"),
        (JobOutcome(run_id="ab", record=attrs.evolve(RUN, files=[f"{SUM}  exports/ab/x"])), "not there: 'ab/x'"),
        (RuntimeError("no\nroom"), "raised RuntimeError: no room"),
        (SystemExit(0), "raised SystemExit: 0"),
        (UnspeakableError(), "raised UnspeakableError"),
    ],
)
def test_anything_else_is_the_fault_of_the_executor_by_name(judged, returned, said):
    with pytest.raises(InputError, match=f"^the executor '.*Given' .*{re.escape(said)}"):
        judged(returned)


@pytest.mark.parametrize("executor", [None, 5, types.SimpleNamespace(submit=print)])
def test_what_is_opened_must_be_an_executor(executor):
    refused = pytest.raises(InputError, match=r"instead of a concurrent\.futures\.Executor")
    with refused, opened(Given(executor=executor), 1, ""):
        raise AssertionError


LOSING = """
from concurrent.futures import ThreadPoolExecutor
import attrs
from mrpbench_core.api import ExecutorSource

class Pool(ThreadPoolExecutor):
    def submit(self, *call):
        if getattr(self, "full", False):
            raise ValueError("no room")
        self.full = True
        return super().submit(*call)

@attrs.frozen(kw_only=True)
class Losing(ExecutorSource):
    def open(self, workers):
        return Pool(workers)
"""


def test_a_study_whose_executor_fails_keeps_what_is_finished_and_ends_in_one_line(study, publish, command):
    publish("acme-executor", "[mrpbench.executors]\nlosing = acme_executor:Losing\n", LOSING)
    write_document(Path("odd.yaml"), study | {"matrix": {"seed": [0, 1]}})
    done = command("run", "odd.yaml", "--out", "out", "--executor", "losing")
    assert done.returncode == 2
    assert done.stderr == "the executor 'losing' of acme-executor 1.0 raised ValueError: no room\n"
    assert len(load("out")) == 1


def test_a_call_that_takes_long_and_a_thread_that_stays_are_told_by_the_name_of_the_executor(monkeypatch, caplog):
    monkeypatch.setattr(calls, "PATIENCE_S", 0.01)
    ended = threading.Event()

    class Slow(Executor):
        def shutdown(self, wait=True, *, cancel_futures=False):
            threading.Thread(target=ended.wait, name="stays").start()
            time.sleep(0.1)

    with opened(Given(executor=Slow()), 1, ""):
        pass
    ended.set()
    late, left = (record.getMessage() for record in caplog.records)
    assert re.fullmatch(r"the executor .*Given' has not returned from shutdown after 0.01 s \(Ctrl-C ends it\)", late)
    assert re.fullmatch(r"the executor .*Given' left the thread 'stays', without whose end no command ends", left)
