"""A study disturbed again and again ends with the records, recordings and bags of one that was left alone.

No process and no temporary folder of it is left after a disturbance.

`make soak` runs it; `python soak_disturbances.py COUNT SEED [KIND ...]` prints each disturbance, and, in the end, what
differs. The kinds are the functions below, such as `kill`.
"""

import os
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path

import psutil
from test_kills import essence

from mrpbench_core import load
from mrpbench_core.store.invocation import write_document

RUNS = 40
STUDY = {
    "name": "disturbed",
    "world": "office",
    "scenario": {"plugin": "random", "robots": 3},
    "planner": "prioritized",
    "dispatcher": "adg",
    "controller": "pure_pursuit",
    "simulator": "kinematic",
    "recording": {"keep": "all"},
    "matrix": {"seed": f"0..{RUNS - 1}"},
}
TASKS = {
    "roadmap": "graph",
    "tasks": {"plugin": "poisson", "rate": 12},
    "planner": {"plugin": "rolling_horizon", "planner": "prioritized"},
    "limits": {"execution": 40, "iterations": 5},
}
"""With even seeds, tasks keep coming."""


def invoke(out: Path) -> psutil.Popen:
    """Run the study, or what is left of it, with two workers."""
    command = [sys.executable, "-m", "mrpbench_core.cli.main", "run", "study.yaml", "--out", str(out), "--workers", "2"]
    temporary = temporary_folder(out)
    temporary.mkdir(exist_ok=True)
    environment = os.environ | {"TMPDIR": str(temporary)}
    streams = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE}
    heard = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)  # also where this runs in a shell's background
    return psutil.Popen(command, cwd=out.parent, env=environment, text=True, preexec_fn=heard, **streams)


def temporary_folder(out: Path) -> Path:
    """The folder of temporary files of the invocations on a results folder; it also marks their processes."""
    return out.with_name(f"{out.name}-temporary")


def left_behind(out: Path) -> list[str]:
    """The processes and temporary files that are left soon after an invocation has ended."""
    temporary, deadline = temporary_folder(out), time.monotonic() + 10
    while True:
        left = [file.name for file in temporary.iterdir()]
        for process in psutil.process_iter():
            with suppress(psutil.Error):
                if process.environ().get("TMPDIR") == str(temporary):
                    left.append(" ".join(process.cmdline()))
        if not left or time.monotonic() > deadline:
            return left
        time.sleep(0.1)


def kill(process: psutil.Process) -> None:
    """Kill like `kill -9`, or like the kernel when memory runs out."""
    process.kill()


def terminate(process: psutil.Process) -> None:
    """Terminate like a batch system at the end of the allowed time."""
    process.terminate()


def interrupt(process: psutil.Process) -> None:
    """Interrupt like Ctrl-C."""
    process.send_signal(signal.SIGINT)


def fill_disk(process: psutil.Process) -> None:
    """No file may grow beyond what is written already: every write fails from now on, as on a full disk."""
    largest = random.randrange(20_000)
    process.rlimit(resource.RLIMIT_FSIZE, (largest, largest))


DISTURBANCES: tuple[Callable[[psutil.Process], None], ...] = (kill, terminate, interrupt, fill_disk)


def disturb(study: psutil.Popen, chance: random.Random, acts: Sequence[Callable[[psutil.Process], None]]) -> str:
    """Disturb the invoking process or a worker, and return a description."""
    workers = study.children(recursive=True)
    victim = chance.choice(workers) if workers and chance.random() < 0.5 else study
    act = chance.choice(acts)
    with suppress(psutil.NoSuchProcess):  # it has just ended of its own
        act(victim)
    return f"{act.__name__} {'the invoker' if victim is study else 'a worker'}"


def recorded(out: Path) -> int:
    """The number of runs that have a record."""
    return len(load(out)) if Path(out, "runs").is_dir() else 0


def contents(folder: Path) -> dict[str, bytes | int]:
    """Every recording byte by byte, and every exported file by its size: bags hold the time of writing."""
    return {named(file, folder): file.read_bytes() for file in folder.glob("recordings/*")} | {
        named(file, folder): len(file.read_bytes()) for file in folder.glob("exports/**/*") if file.is_file()
    }


def named(file: Path, folder: Path) -> str:
    """The name of a file in a results folder, without the number of the attempt."""
    return re.sub(r"^(recordings|exports)/([0-9a-f]+)-\d+", r"\1/\2", str(file.relative_to(folder)))


def differences(one: Path, other: Path) -> list[str]:
    """The records and files that differ between two results folders."""
    pairs = (essence(one), essence(other)), (contents(one), contents(other))
    return [key for left, right in pairs for key in left.keys() | right.keys() if left.get(key) != right.get(key)]


def main(count: int, seed: int, kinds: Sequence[str]) -> int:
    """Print what differs or is left behind; the number of differences and of what is left."""
    acts = [act for act in DISTURBANCES if not kinds or act.__name__ in kinds]
    chance, done, rounds, wrong = random.Random(seed), 0, 0, 0
    with tempfile.TemporaryDirectory() as name:
        alone = Path(name, "alone")
        export = {"plugin": "rosbag2", "storage": ("mcap", "sqlite3")[seed % 2]}
        settings = STUDY | {"export": [export]} | (TASKS if seed % 2 == 0 else {})
        write_document(Path(name, "study.yaml"), settings)
        assert invoke(alone).wait() == 0
        while done < count:
            rounds += 1
            out = Path(name, f"disturbed-{rounds}")
            while recorded(out) < RUNS and done < count:
                study = invoke(out)
                more = recorded(out) + chance.randrange(6)
                while study.poll() is None and recorded(out) < more:
                    time.sleep(0.1)
                time.sleep(chance.uniform(0.0, 2.0))
                if study.poll() is None:
                    done += 1
                    print(f"{done:3}: {disturb(study, chance, acts)}", end="", flush=True)
                    with suppress(psutil.TimeoutExpired):
                        study.wait(chance.uniform(0.0, 8.0))
                with suppress(psutil.NoSuchProcess):
                    study.send_signal(signal.SIGINT)
                errors = study.communicate()[1]
                left = left_behind(out)
                wrong += len(left)
                print(f"; left behind: {left}" if left else "", end="")
                print(f"; exit {study.returncode}, {recorded(out)} of {RUNS} runs recorded; {errors.strip()}")
            assert invoke(out).wait() == 0
            differing = differences(alone, out)
            wrong += len(differing)
            print(f"study {rounds}: different from the undisturbed one: {differing or 'nothing'}")
    return wrong


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3:]) > 0)
