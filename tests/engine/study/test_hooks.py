"""Hooks of a study are called in a process of each plugin's own."""

from pathlib import Path

import psutil
import pytest

from mrpbench_core import load
from mrpbench_core.engine.study import hooks
from mrpbench_core.plugins.installed import Provider
from mrpbench_core.store.invocation import write_document

OBSERVER = """
import ctypes, os, sys, time
from mrpbench_core.api import hookimpl

def tell(*words):
    with open("events.txt", "a") as file:
        print(*words, file=file)

@hookimpl
def mrpbench_study_started(runs):
    tell("study_started", runs, os.getpid())

@hookimpl
def mrpbench_run_started(run_id):
    tell("run_started")

@hookimpl
def mrpbench_run_finished(record):
    tell("run_finished", record["status"])
    record["status"] = "succeeded"
    {does}

@hookimpl
def mrpbench_study_finished(records):
    tell("study_finished", records, os.getpid())
"""
GROUP = "[mrpbench.hooks]\nwatch = acme_watch\n"


@pytest.fixture
def observed(study, publish, command):
    """Return a function that runs a study of two runs with a hook plugin."""

    def run(code):
        publish("acme-watch", GROUP, code)
        write_document(Path("odd.yaml"), study | {"matrix": {"seed": [0, 1]}})
        return command("run", "odd.yaml", "--out", "out")

    return run


def test_a_plugin_observes_a_whole_study_in_one_process_and_cannot_write_into_records(observed):
    done = observed(OBSERVER.replace("{does}", "print('seen')"))
    assert done.returncode == 0
    assert done.stderr == "seen\nseen\n", "standard output is what the command prints"
    first, *events, last = Path("events.txt").read_text().splitlines()
    assert events[0] == "run_started"
    assert sorted(events) == ["run_finished plan_unsolvable"] * 2 + ["run_started"] * 2
    assert first.startswith("study_started 2 ")
    assert last == f"study_finished 2 {first.split()[-1]}"
    assert {record["status"] for record in load("out")} == {"plan_unsolvable"}


@pytest.mark.parametrize(
    ("does", "said"),
    [
        ("os._exit(3)", "its process ended with exit code 3"),
        ("os.closerange(3, 100)", "its process ended"),
        ("[os.write(fd, b'junk' * 99) for fd in range(3, 9) if os.path.exists(f'/proc/self/fd/{fd}')]", "it wrote to"),
    ],
)
def test_a_hook_that_ends_its_process_costs_no_run(observed, does, said):
    done = observed(OBSERVER.replace("{does}", does))
    assert done.returncode == 0
    (line,) = (line for line in done.stderr.splitlines() if "hook plugin" in line)
    assert line.startswith(f"hook plugin 'watch' is disabled for this study: mrpbench_run_finished: {said}")
    assert len(load("out")) == 2


def test_a_hook_that_does_not_return_is_ended(study, publish, tmp_path, monkeypatch):
    publish("acme-watch", GROUP, OBSERVER.replace("{does}", "time.sleep(1000)"))
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "site"))
    monkeypatch.setattr(hooks, "HOOK_S", 0.2)
    facts = {"name": "watch", "kind": "hook", "group": "mrpbench.hooks", "distribution": "acme-watch", "version": "1.0"}
    observer = hooks.Observer(Provider(**facts, value="acme_watch"))
    try:
        fault = observer.call({"hook": "mrpbench_run_finished", "arguments": {"record": {"status": "x"}}})
    finally:
        observer.close()
    assert fault == "it did not return within 0.2 s"
    assert Path("events.txt").read_text() == "run_finished x\n"


def test_what_a_hook_starts_ends_with_the_study_whatever_session_it_has(observed):
    done = observed(OBSERVER.replace("{does}", STAYS))
    assert (done.returncode, done.stderr) == (0, "")
    pids = [int(pid) for pid in Path("pids.txt").read_text().split()]
    assert len(pids) == 2
    assert not any(map(psutil.pid_exists, pids))


STAYS = """
    if os.fork() == 0:
        os.setsid()
        with open("pids.txt", "a") as file:
            print(os.getpid(), file=file)
        time.sleep(1000)"""


@pytest.mark.parametrize(
    "code",
    [
        "import ctypes\nctypes.string_at(0)",
        "import os\nfrom mrpbench_core.api import hookimpl\n@hookimpl\ndef mrpbench_check(): os._exit(0)",
    ],
)
def test_a_hook_plugin_that_ends_the_process_when_it_is_imported_is_named_before_any_run(observed, code):
    done = observed(code)
    assert done.returncode == 2
    assert "a hook plugin cannot be used (MRPBENCH_DISABLE_PLUGINS can leave it out): while hook 'watch'" in done.stderr
    assert not len(load("out"))
