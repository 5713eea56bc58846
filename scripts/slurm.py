"""Do what `docs/how-to/clusters.md` says of SLURM, on a cluster of this machine alone: `python scripts/slurm.py`.

Debian's packages `slurm-wlm` and `munge` give the daemons. They run as root, with all files in a temporary folder.
The job of the page is cancelled in the middle and submitted again: nothing may be lost, nothing done twice.
"""

import contextlib
import json
import os
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/how-to/clusters.md"
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scancel")
PARTS = 16
"""Tasks of the page's array."""
RUNS = 8
"""Of the page's study."""
PATIENCE_S = 900.0
CONFIG = """\
ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SwitchType=switch/none
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=2,batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SlurmdParameters=config_overrides
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs=8 RealMemory=32768 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""
"""`config_overrides`: the node claims what the page's job asks for, whatever this machine has."""


def main() -> None:
    if missing := [name for name in PROGRAMS if shutil.which(name, path=_path()) is None]:
        print(f"skipped: {missing[0]} is not installed; on Debian, `apt-get install slurm-wlm munge` installs it")
        return
    if os.geteuid():
        print("skipped: the daemons of SLURM need root")
        return
    with tempfile.TemporaryDirectory(prefix="slurm-") as folder, cluster(Path(folder)):
        work = Path(folder) / "work"
        work.mkdir()
        (work / ".venv").symlink_to(Path(sys.prefix))
        follow(work)


@contextlib.contextmanager
def cluster(folder: Path) -> Iterator[None]:
    """A cluster of one node whose files are in `folder`; the environment of this process points to it."""
    (folder / "state").mkdir()
    (folder / "spool").mkdir()
    key = folder / "munge.key"
    key.write_bytes(os.urandom(1024))
    key.chmod(0o600)
    folder.chmod(0o755)
    config = folder / "slurm.conf"
    config.write_text(CONFIG.format(host=socket.gethostname().partition(".")[0], folder=folder, ports=_free_ports(2)))
    os.environ |= {"PATH": _path(), "SLURM_CONF": str(config)}
    munge = ["munged", "--foreground", "--force", f"--key-file={key}"]
    files = {"socket": "munge.socket", "pid-file": "munged.pid", "log-file": "munged.log", "seed-file": "munge.seed"}
    commands = (
        [*munge, *(f"--{option}={folder / name}" for option, name in files.items())],
        ["slurmctld", "-D", "-c"],
        ["slurmd", "-D"],
    )
    with contextlib.ExitStack() as running:
        for command in commands:
            log = running.enter_context((folder / f"{command[0]}.out").open("w"))
            daemon = subprocess.Popen(command, stdout=log, stderr=log)
            running.callback(daemon.wait)
            running.callback(daemon.terminate)
            time.sleep(1)
        wait_until("the node is idle", lambda: "idle" in run("sinfo", "--noheader", "--format=%t", check=False), folder)
        yield


def follow(work: Path) -> None:
    """Submit the job of the page in the folder `work`, cancel it, submit it again, and merge its parts."""
    study, _, job, merge, expected = blocks()
    (work / "study.yaml").write_text(study)
    (work / "job.sh").write_text(job)
    first = run("sbatch", "--parsable", "job.sh", cwd=work).strip()
    wait_until("a run is recorded", lambda: any(_records(work)), work.parent)
    run("scancel", first)
    wait_until("the job is cancelled", lambda: not _queued(first), work.parent)
    print(f"cancelled with {len(_records(work))} of {RUNS} runs recorded")
    run("sbatch", "--wait", "job.sh", cwd=work)
    done = _records(work)
    assert len(done) == len({record["run_id"] for record in done}) == RUNS, f"{len(done)} records of {RUNS} runs"
    environment = os.environ | {"PATH": f"{Path(sys.prefix) / 'bin'}:{os.environ['PATH']}"}
    output = run("bash", "-euo", "pipefail", "-c", merge, cwd=work, env=environment)
    assert expected.splitlines()[0] in output, f"the page says\n{expected}\nbut this is\n{output}"
    print(f"{RUNS} of {RUNS} runs recorded once by an array of {PARTS} tasks")


def blocks() -> tuple[str, ...]:
    """The code of the page up to Dask: the study, shards of one machine, the job, merging, and its output."""
    text = PAGE.read_text(encoding="utf-8").partition("## Dask")[0]
    found = tuple(re.findall(r"^```\w+\n(.*?)^```$", text, re.MULTILINE | re.DOTALL))
    assert len(found) == 5, f"{PAGE} has {len(found)} blocks of code before Dask"
    assert f"--array=0-{PARTS - 1}" in found[2]
    return found


def wait_until(what: str, holds: Callable[[], bool], folder: Path) -> None:
    """Wait for a condition; if it does not hold in time, print the logs of the daemons."""
    end = time.monotonic() + PATIENCE_S
    while not holds():
        if time.monotonic() > end:
            for log in sorted(folder.glob("*.log")):
                print(f"--- {log.name}", *log.read_text().splitlines()[-20:], sep="\n")
            sys.exit(f"waited {PATIENCE_S:g} s in vain until {what}")
        time.sleep(0.5)


def run(*command: str, check: bool = True, cwd: Path | None = None, env: dict[str, str] | None = None) -> str:
    """The output of a command, which must succeed unless `check` is off."""
    done = subprocess.run(command, capture_output=True, text=True, cwd=cwd, env=env, check=False)
    if check and done.returncode:
        logs = "\n".join(file.read_text() for file in sorted((cwd or Path()).glob("slurm-*.out")))
        sys.exit(f"{' '.join(command)}: exit status {done.returncode}\n{done.stdout}{done.stderr}{logs}")
    return done.stdout


def _queued(job: str) -> str:
    return run("squeue", "--noheader", f"--job={job}", check=False)


def _records(work: Path) -> list[dict[str, object]]:
    files = (work / "results/parts").glob("*/runs/*.jsonl")
    return [json.loads(line) for file in files for line in file.read_text().splitlines()]


def _path() -> str:
    return f"{os.environ['PATH']}:/usr/sbin"


def _free_ports(count: int) -> list[int]:
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]


if __name__ == "__main__":
    main()
