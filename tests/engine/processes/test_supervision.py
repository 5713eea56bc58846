"""Whatever a plugin does, its run has a definite status and its neighbours go on."""

import os
import re
import socket
from pathlib import Path

import psutil
import pytest

from mrpbench_core import load, run
from mrpbench_core.engine.processes.channel import KEY_BYTES, Channel, new_key
from mrpbench_core.engine.processes.output import flush
from mrpbench_core.engine.processes.supervision import Supervision
from mrpbench_core.engine.processes.supervisor import SERVERS
from mrpbench_core.engine.study.progress import StudyProgress
from mrpbench_core.files.errors import InputErrors
from mrpbench_core.model.runs.status import RunStatus

pytestmark = pytest.mark.usefixtures("kept_workers")


def outcomes(study, does, **options):
    """Records of runs that each do one thing, by what they do."""
    results = run(study | {"matrix": {"planner.does": list(does)}}, out="out", **options)
    return {record["config"]["planner"]["does"]: record for record in results}


def test_neighbours_of_misbehaving_plugins_go_on(study):
    study["limits"]["memory"] = "500 MiB"
    does = ["hang", "exit", "nothing", "segfault", "eat", "raise", "system_exit", "eat_at_once", "close_everything"]
    records = outcomes(study, does, workers=2)
    assert {key: record["status"] for key, record in records.items()} == {
        "hang": "plan_timeout",
        "exit": "crashed",
        "nothing": "plan_unsolvable",
        "segfault": "crashed",
        "eat": "out_of_memory",
        "raise": "crashed",
        "system_exit": "crashed",
        "eat_at_once": "out_of_memory",
        "close_everything": "crashed",
    }
    errors = {key: record["error"] for key, record in records.items()}
    assert {error["stage"] for error in errors.values()} == {"planning"}
    assert errors["exit"]["message"] == "the worker process ended with exit code 7"
    assert errors["segfault"]["message"] == "the worker process was ended by SIGSEGV"
    assert errors["raise"]["message"].startswith("ValueError: no way (odd.py:")
    for does in ("eat", "eat_at_once"):
        assert re.search(r"held \d+ MiB.*; the option limits.memory allows 500 MiB", errors[does]["message"])
    assert "SystemExit: farewell" in errors["system_exit"]["message"]
    logs = {key: Path("out/logs", f"{record['run_id']}.txt") for key, record in records.items()}
    assert "Traceback" in logs["raise"].read_text()
    assert "Segmentation fault" in logs["segfault"].read_text()
    assert not logs["nothing"].exists()
    scenario_ids = {record["scenario_id"] for record in records.values()}
    assert len(scenario_ids) == 1
    assert None not in scenario_ids
    assert records["hang"]["timing"]["planning_s"] >= 1.0
    assert records["hang"]["timing"]["clock_bound"] is True
    assert all(record["timing"]["concurrent_workers"] == 2 for record in records.values())


def test_a_run_that_exceeds_the_wall_limit_is_ended_in_any_stage(study):
    study["limits"] = {"planning": 60, "wall": 2.0}
    study["assigner"] = "identity"  # which imports no solver
    record = outcomes(study, ["hang_with_gil"])["hang_with_gil"]
    assert record["status"] == "wall_timeout"
    assert record["error"]["stage"] == "planning"


def test_a_worker_executes_runs_of_more_sets_of_plugins_than_it_keeps_servers_for(study):
    planners = ["example", "astar", "cbs", "pibt", "prioritized", "pbs"]
    assert len(planners) > SERVERS
    records = run(study | {"matrix": {"planner": planners}}, out="out", workers=1)
    assert [record["status"] for record in records] == ["succeeded"] * len(planners)


def test_output_of_plugins_goes_to_the_log_of_their_run(study, capfd):
    records = outcomes(study, ["print", "nothing"])
    log = Path("out/logs", f"{records['print']['run_id']}.txt").read_text()
    assert set(log.splitlines()) == {"from Python", "from a descriptor", "from C", "from a program"}
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("does", ["hang_with_helper", "leave_helper"])
def test_programs_that_a_plugin_starts_end_with_its_run(study, does):
    outcomes(study, [does])
    (mark,) = Path("marks").iterdir()
    assert not any(is_working(int(pid)) for pid in mark.name.split("."))


def test_a_worker_that_is_killed_each_time_counts_as_crashed(study):
    told = Told()
    record = outcomes(study, ["kill_oneself"], progress=told)["kill_oneself"]
    assert (record["status"], record["attempt"]) == ("crashed", 3)
    assert record["error"]["message"] == "the worker process was ended by SIGKILL"
    assert record["error"]["stage"] == "planning"
    assert told.losses == ["the worker process was ended by SIGKILL"] * 2


class Told(StudyProgress):
    def __init__(self):
        self.losses = []

    def lost(self, point, reason):
        self.losses.append(reason)


def test_a_child_serves_many_runs(study):
    study["planner"]["does"] = "print"
    results = run(study | {"matrix": {"seed": "0..3"}}, out="out")
    assert len(results) == 4
    assert all(record["timing"]["planning_s"] > 0 for record in results)


def test_a_mistake_found_only_in_the_run_is_told_and_not_recorded(study):
    study["scenario"]["robots"] = 99
    with pytest.raises(InputErrors):
        run(study, out="out")
    assert len(load("out")) == 0


def is_working(pid):
    try:
        return psutil.Process(pid).status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False


class LateServer:
    """A fork server whose messages are read after those of the process that it forked."""

    pid = os.getpid()

    def __init__(self):
        self.messages = [{"importing": "planner 'odd'"}] * 2
        self.connection = None

    def fileno(self):
        return 0

    def fork(self, connection, instance):
        self.connection = connection.dup()

    def receive(self, timeout_s=None):
        return self.messages.pop()


def test_an_import_that_is_over_is_not_what_a_later_failure_is_attributed_to(tmp_path):
    job = {"log": str(tmp_path / "log"), "wall_s": 60.0, "memory_bytes": 2**40}
    server, (ours, theirs) = LateServer(), socket.socketpair()
    followed = Supervision(job, Channel(ours, new_key()), server, ())
    assert followed._heed() == (None, True)
    assert "while planner 'odd' was imported" in failure_of(followed)
    run = Channel(server.connection, server.connection.recv(KEY_BYTES))
    run.send({"stage": "planning", "at": 0.0})
    assert followed._drain() is None
    assert failure_of(followed) == "it ended"
    assert followed._heed() == (None, True), "an older message of the fork server"
    assert failure_of(followed) == "it ended"
    for connection in (ours, theirs, server.connection, followed._connection):
        connection.close()


def failure_of(followed):
    return followed._failure(RunStatus.CRASHED, "it ended")["failure"]["message"]


@pytest.mark.parametrize("put", [None, object()])
def test_buffers_are_emptied_whatever_a_plugin_put_in_the_place_of_the_output(monkeypatch, put):
    monkeypatch.setattr("sys.stdout", put)
    flush()
