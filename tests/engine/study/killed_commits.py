"""A program of `test_commits.py`: stores a second attempt of a run, and is killed before each step that changes files.

It prints what is wrong after each kill, and in the end the number of kills.
"""

import os
import shutil
import signal
import sys
import tempfile
import types
from pathlib import Path

from mrpbench_core.engine.processes.job import JobOutcome
from mrpbench_core.engine.record import RunRecord
from mrpbench_core.engine.study.commits import Commits, EndedRun
from mrpbench_core.files.jsonl import Writer
from mrpbench_core.files.output import create_file
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.results import Results
from mrpbench_core.store.run_files import check_recording, digest, seal

MEMORY = "/dev/shm" if Path("/dev/shm").is_dir() else None
STEPS = (
    (os, "fsync"),
    (os, "write"),
    (os, "unlink"),
    (os, "replace"),
    (os, "rename"),
    (os, "open"),
    (shutil, "rmtree"),
)


def store(folder, attempt):
    """Store an attempt as a run and the invoking process do, one after the other."""
    folder.forget("ab", attempt)
    paths = folder.run("ab", attempt)
    with create_file(paths.partial) as stream:
        stream.write(b"attempt %d" % attempt)
    paths.partial.replace(paths.recording)
    paths.exports.mkdir()
    (paths.exports / "bag").write_text(f"bag {attempt}")
    record = RunRecord(run_id="ab", executed=True, files=seal(paths))
    canonical = {"seed": 0, "repeat": 0}
    point = types.SimpleNamespace(run_id="ab", canonical=canonical, code={}, live=False)
    with Writer(folder.shard(str(attempt)), exclusive=True) as shard:
        commits = Commits(folder=folder, shard=shard, invocation="", workers=1)
        commits.add(
            [EndedRun(point=point, attempt=attempt, outcome=JobOutcome(run_id="ab", record=record, machine={}))]
        )
        commits.close()


def kill_before(step):
    """Let this process kill itself before the step with this number."""
    left = [step]

    def counted(act):
        def acting(*arguments, **options):
            if left[0] == 0:
                os.kill(os.getpid(), signal.SIGKILL)
            left[0] -= 1
            return act(*arguments, **options)

        return acting

    for module, name in STEPS:
        setattr(module, name, counted(getattr(module, name)))


def faults(folder, finished):
    """What is wrong after a kill."""
    found = []
    for swept in (False, True):
        results = Results(folder)
        if swept:
            folder.sweep()
            results.remove_superseded()
        (record,) = results
        paths = results.paths("ab")
        check_recording(record, paths.recording)
        content = f"attempt {record['attempt']}".encode()
        if paths.recording.read_bytes() != content or (paths.exports / "bag").read_text() != f"bag {record['attempt']}":
            found.append(f"the files are not those of attempt {record['attempt']}")
        for line in record["provenance"]["files"]:
            expected, _, name = line.partition("  ")
            if digest(folder.path / name) != expected:
                found.append(f"{name} is not as in the record")
    left = sorted(file.name for part in ("recordings", "exports") for file in (folder.path / part).iterdir())
    if left != sorted(path.name for path in (paths.recording, paths.exports)):
        found.append(f"after sweeping there are {left}")
    if finished and record["attempt"] != 2:
        found.append("the record of a finished commit is missing")
    return found


def main():
    """Kill at every step."""
    step, finished = 0, False
    while not finished:
        with tempfile.TemporaryDirectory(dir=MEMORY) as name:
            folder = ResultsFolder(Path(name))
            folder.create()
            store(folder, 1)
            pid = os.fork()
            if pid == 0:
                kill_before(step)
                store(folder, 2)
                os._exit(0)
            finished = os.waitpid(pid, 0)[1] == 0
            for fault in faults(folder, finished):
                print(f"killed before step {step}: {fault}")
        step += not finished
    print(f"{step} kills")


if __name__ == "__main__":
    sys.exit(main())
