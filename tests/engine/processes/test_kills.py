"""`kill -9` of any process loses and doubles no record, leaves no process running and changes no record."""

import os
import random
import signal
import subprocess
import sys
import time
from contextlib import suppress
from functools import partial
from pathlib import Path

import psutil
import pytest

from mrpbench_core import load, run
from mrpbench_core.store.invocation import write_document

RUNS = 10
UNDISTURBED = {}


@pytest.fixture
def slow_study(study):
    """Runs of 0.15 s each, in a file."""
    study["planner"] = {"plugin": "./odd.py:Odd", "does": "slow"}
    write_document(Path("odd.yaml"), study | {"matrix": {"seed": f"0..{RUNS - 1}"}})
    return study


def invoke(*words):
    command = [sys.executable, "-m", "mrpbench_core.cli.main", "run", "odd.yaml", "--out", "out", *words]
    heard = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)  # also where the tests run in a shell's background
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, preexec_fn=heard)


def finish(process, timeout=30):
    """Exit code and what it wrote."""
    output, errors = process.communicate(timeout=timeout)
    return process.returncode, output, errors


def children(process):
    return psutil.Process(process.pid).children(recursive=True)


def wait_for_records(count, deadline_s=30):
    deadline = time.monotonic() + deadline_s
    while sum(file.read_bytes().count(b"\n") for file in Path("out/runs").glob("*.jsonl")) < count:
        assert time.monotonic() < deadline
        time.sleep(0.02)


def essence(folder):
    """Records without what may differ between two executions of the same study."""
    return {
        record["run_id"]: {
            key: value for key, value in record.items() if key not in ("timing", "provenance", "attempt")
        }
        for record in load(folder)
    }


@pytest.fixture
def undisturbed(slow_study):
    """The records of the undisturbed study; computed once, because they do not depend on the folder."""
    if not UNDISTURBED:
        run("odd.yaml", out="undisturbed", workers=2)
        UNDISTURBED.update(essence("undisturbed"))
        assert len(UNDISTURBED) == RUNS
    return UNDISTURBED


def gone(processes):
    return not [process for process in psutil.wait_procs(processes, timeout=5)[1] if process.is_running()]


def test_a_killed_invoker_leaves_no_orphan_and_is_resumed(undisturbed):
    process = invoke("--workers", "2")
    wait_for_records(3)
    workers = children(process)
    assert len(workers) >= 2
    process.kill()
    finish(process)
    assert gone(workers)
    kept = essence("out")
    assert 3 <= len(kept) < RUNS
    code, output, _ = finish(invoke("--workers", "2"))
    assert code == 0
    assert f"{RUNS - len(kept)} of {RUNS} runs to do, {len(kept)} recorded" in output
    assert essence("out") == undisturbed
    assert {record["attempt"] for record in load("out")} == {1}


def names(process):
    found = set()
    for worker in children(process):
        with suppress(psutil.NoSuchProcess):  # one that ends meanwhile
            found.add(worker.name())
    return found


def test_a_killed_invoker_leaves_no_orphan_even_in_native_code_with_helpers(study):
    write_document(
        Path("odd.yaml"), study | {"limits": {}, "matrix": {"planner.does": ["hang_with_gil", "hang_with_helper"]}}
    )
    process = invoke("--workers", "2")
    deadline = time.monotonic() + 30
    while "sleep" not in names(process):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    time.sleep(0.3)
    workers = children(process)
    process.kill()
    finish(process)
    assert gone(workers)


def test_runs_whose_worker_was_killed_are_done_again_and_it_is_said(undisturbed):
    process = invoke("--workers", "2")
    chance = random.Random(1)
    for count, number in ((1, signal.SIGKILL), (3, signal.SIGINT), (5, signal.SIGTERM)):
        wait_for_records(count)
        chance.choice(children(process)).send_signal(number)
    code, output, errors = finish(process)
    assert (code, errors) == (0, "")
    assert output.count("process was ended by SIG") >= 1
    assert essence("out") == undisturbed
    assert sum(record["attempt"] - 1 for record in load("out")) == output.count("is repeated")


def test_an_interrupted_study_keeps_finished_runs_and_continues(undisturbed):
    for number, records in ((signal.SIGINT, 2), (signal.SIGTERM, 5)):
        process = invoke("--workers", "2")
        wait_for_records(records)
        workers = children(process)
        process.send_signal(number)
        code, _, errors = finish(process)
        assert code == 130
        assert errors == "interrupted; finished runs are in out, and the same command continues\n"
        assert gone(workers)
        assert records <= len(load("out")) < RUNS
    run("odd.yaml", out="out", workers=2)
    assert essence("out") == undisturbed


def test_two_invocations_on_one_folder(undisturbed):
    first = invoke()
    wait_for_records(1)
    first.send_signal(signal.SIGSTOP)  # or it might be done before the second has begun
    code, _, errors = finish(invoke())
    first.send_signal(signal.SIGCONT)
    assert code == 2
    assert errors.count("\n") == 1
    assert f"another invocation is working in this folder (process {first.pid} on {os.uname().nodename})" in errors
    assert finish(first)[0] == 0
    assert essence("out") == undisturbed


def test_a_full_disk_ends_in_one_line_and_is_resumed(undisturbed):
    limited = (
        "import resource, signal, sys; from mrpbench_core.cli.main import main\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (5000, 5000))\n"
        "sys.exit(main(['run', 'odd.yaml', '--out', 'out']))"
    )
    process = subprocess.run([sys.executable, "-c", limited], capture_output=True, text=True, timeout=30)
    assert process.returncode == 2
    assert process.stderr.count("\n") == 1
    assert "cannot be written: File too large" in process.stderr
    assert 1 <= len(load("out")) < RUNS
    run("odd.yaml", out="out", workers=2)
    assert essence("out") == undisturbed


def test_modules_in_the_working_directory_are_not_executed(study):
    for name in ("mrpbench_core", "json", "numpy"):
        Path(f"{name}.py").write_text("open('executed', 'w')")
    run(study, out="out")
    assert not Path("executed").exists()
