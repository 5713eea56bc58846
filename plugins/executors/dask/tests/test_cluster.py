"""A scheduler and two worker processes on loopback: nothing lost, nothing done twice in silence."""

import json
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import psutil
import pytest
from mrpbench_executors_dask import Dask

from mrpbench_core import load, run
from mrpbench_core.api.executor import WorkerLost
from mrpbench_core.engine.study.progress import StudyProgress
from mrpbench_core.files.errors import InputError
from mrpbench_core.store.invocation import write_document
from mrpbench_core.testing.suites.executor import ExecutorConformance

WORLD = "type octile\nheight 4\nwidth 4\nmap\n....\n....\n....\n....\n"
PLANNER = '''
"""A planner that takes its time, and leaves a mark whenever it is asked."""

import os
import time
from pathlib import Path

import attrs

from mrpbench_core.api import Planner, option
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus


@attrs.frozen(kw_only=True)
class Slow(Planner):
    """Finds nothing."""

    marks: str = option(help="folder for marks")

    def plan(self, problem, budget):
        Path(self.marks, f"{time.monotonic_ns()}-{os.getpid()}").touch()
        time.sleep(0.6)
        return PlanResult(status=PlanStatus.UNSOLVABLE)
'''


class Heard(StudyProgress):
    """Remembers which runs were lost."""

    def __init__(self):
        self.losses = []

    def lost(self, point, message):
        self.losses.append((point.run_id, message))


class LocalCluster:
    """One scheduler and worker processes, each of them started as on any machine."""

    def __init__(self, folder, size=2):
        self.folder, self.size = folder, size
        self.file = folder / "scheduler.json"
        self.processes = []
        self.start("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--no-show")
        deadline = time.monotonic() + 60
        while not self.file.exists():
            assert time.monotonic() < deadline
            time.sleep(0.05)
        self.workers = []
        self.complete()

    def complete(self):
        """Start workers in place of those that were killed."""
        self.workers = [worker for worker in self.workers if worker.poll() is None]
        while len(self.workers) < self.size:
            self.workers.append(self.start("worker", "--no-nanny", "--nthreads", "1", "--no-dashboard"))

    def start(self, what, *words):
        command = [sys.executable, "-m", "distributed.cli.dask_" + what, "--scheduler-file", str(self.file), *words]
        with (self.folder / f"{what}-{len(self.processes)}.log").open("w") as log:
            process = subprocess.Popen(command, stdout=log, stderr=log, cwd=self.folder)
        self.processes.append(process)
        return process

    @property
    def address(self):
        return json.loads(self.file.read_text())["address"]

    def close(self):
        for process in reversed(self.processes):
            process.kill()
            process.wait(timeout=30)


@pytest.fixture(scope="module")
def scheduler(tmp_path_factory):
    """Return a cluster whose scheduler lasts."""
    made = LocalCluster(tmp_path_factory.mktemp("cluster"))
    yield made
    made.close()


@pytest.fixture
def cluster(scheduler):
    """Return it with two workers, which a test may kill."""
    scheduler.complete()
    return scheduler


@pytest.fixture
def doomed(tmp_path):
    """Return a cluster that a test may kill as a whole."""
    made = LocalCluster(tmp_path, size=1)
    yield made
    made.close()


@pytest.fixture
def study(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "slow.py").write_text(PLANNER)
    (tmp_path / "small.map").write_text(WORLD)
    (tmp_path / "marks").mkdir()
    document = {
        "name": "slow",
        "world": {"plugin": "movingai", "file": "small.map"},
        "roadmap": "grid",
        "scenario": {"plugin": "random", "robots": 2},
        "assigner": "identity",
        "planner": {"plugin": "./slow.py:Slow", "marks": str(tmp_path / "marks")},
        "simulator": "none",
        "metrics": [],
        "matrix": {"seed": "0..7"},
    }
    write_document(Path("slow.yaml"), document)
    return "slow.yaml"


def essence(folder):
    return {
        record["run_id"]: {k: v for k, v in record.items() if k not in ("timing", "provenance", "attempt")}
        for record in load(folder)
    }


def kill_a_worker_at_work(marks):
    """Kill a worker whose child has just begun a run, which lasts a while."""
    deadline = time.monotonic() + 90
    while len(names := sorted(mark.name for mark in marks.iterdir())) < 3:
        assert time.monotonic() < deadline
        time.sleep(0.02)
    _, _, worker, *_ = psutil.Process(int(names[-1].split("-")[1])).parents()  # above fork server and supervisor
    worker.kill()


def test_a_study_survives_the_loss_of_a_worker_and_names_the_repeated_runs(cluster, study, tmp_path):
    run(study, out="here", workers=2)
    undisturbed = essence("here")
    for mark in (tmp_path / "marks").iterdir():
        mark.unlink()
    killer = threading.Thread(target=kill_a_worker_at_work, args=(tmp_path / "marks",))
    killer.start()
    heard = Heard()
    results = run(
        study, out="there", workers=2, executor={"plugin": "dask", "scheduler": cluster.address}, progress=heard
    )
    killer.join()
    assert len(results) == 8
    assert essence("there") == undisturbed
    assert len(heard.losses) == 1
    assert "worker that executed it was lost" in heard.losses[0][1]
    attempts = {record["run_id"]: record["attempt"] for record in load("there")}
    assert attempts.pop(heard.losses[0][0]) == 2
    assert set(attempts.values()) == {1}
    # each attempt was executed once: no run was repeated without a record of it
    assert len(list((tmp_path / "marks").iterdir())) == 9
    (left,) = [worker for worker in cluster.workers if worker.poll() is None]
    assert not psutil.Process(left.pid).children(recursive=True)  # the cluster is left as it was


def test_a_call_that_dask_repeats_says_so_instead(cluster):
    with Dask(scheduler=cluster.address).open(2) as executor:
        assert executor.submit(divmod, 9, 2).result(timeout=60) == (4, 1)
        with pytest.raises(WorkerLost):
            executor.submit(_end_the_worker).result(timeout=60)


def _end_the_worker():
    os._exit(1)


def test_a_lost_scheduler_ends_the_study_in_one_line_and_it_can_go_on(doomed, study, tmp_path):
    def kill_the_scheduler():
        while len(list((tmp_path / "marks").iterdir())) < 3:
            time.sleep(0.02)
        doomed.processes[0].kill()

    killer = threading.Thread(target=kill_the_scheduler)
    killer.start()
    with pytest.raises(InputError, match="the Dask scheduler was lost"):
        run(study, out="there", workers=2, executor={"plugin": "dask", "scheduler": doomed.address})
    killer.join()
    kept = len(load("there"))
    assert kept < 8
    run(study, out="there", workers=2)
    assert len(load("there")) == 8


def test_no_scheduler_is_one_line():
    with pytest.raises(InputError, match="no Dask scheduler answers") as caught:
        Dask(scheduler="tcp://127.0.0.1:9", timeout=1).open(1)
    assert "\n" not in str(caught.value)


class TestConformance(ExecutorConformance):
    @pytest.fixture(autouse=True)
    def _use(self, cluster):
        self.address = cluster.address

    def make(self):
        return Dask(scheduler=self.address)
