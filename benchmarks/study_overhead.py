"""Measure the overhead of a run: processes, messages, record.

Prints milliseconds per run for a minimal run, in a study and alone in this process: wall time, and CPU time and page
faults of all processes. A busy machine lengthens wall time much and CPU time somewhat; page faults stay.
"""

import argparse
import resource
import tempfile
import time
from pathlib import Path
from typing import Any

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.engine.run import execute
from mrpbench_core.engine.study.options import StudyOptions
from mrpbench_core.engine.study.reading import read_study
from mrpbench_core.engine.study.study import run_study
from mrpbench_core.store.paths import RunPaths

FEW = 10
"""Runs of the study whose time is taken off: that of reading it and of starting workers."""


def main() -> None:
    """Measure the rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=1000, help="(default: %(default)s)")
    parser.add_argument("--workers", type=int, default=1, help="(default: %(default)s)")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "tiny.map").write_text("type octile\nheight 3\nwidth 3\nmap\n...\n...\n...\n")
        start, few, fewer = studied(folder, FEW, given.workers)
        wall, cpu, faults = studied(folder, FEW + given.runs, given.workers)
        alone = executed(folder, given.runs)
    wall, cpu = (wall - start) / given.runs * 1e3, (cpu - few) / given.runs * 1e3
    print(f"{wall:.2f} ms of wall time and {cpu:.2f} ms of CPU in a study with {given.workers} workers")
    print(f"{(faults - fewer) / given.runs:.0f} page faults")
    print(f"{alone * 1e3:.2f} ms of CPU alone: {cpu - alone * 1e3:.2f} ms of CPU a run")
    print(f"{start:.2f} s to read a study, to start its workers and to do {FEW} runs")


def described(folder: Path, runs: int) -> dict[str, Any]:
    """A study of minimal runs."""
    return {
        "world": {"plugin": "movingai", "file": str(folder / "tiny.map")},
        "roadmap": "grid",
        "scenario": {"plugin": "random", "robots": 1},
        "assigner": "identity",
        "planner": "example",
        "simulator": "none",
        "metrics": [],
        "matrix": {"seed": f"0..{runs - 1}"},
    }


def studied(folder: Path, runs: int, workers: int) -> tuple[float, float, int]:
    """Wall and CPU seconds and page faults of a study, with its processes."""
    began, (used, faulted) = time.perf_counter(), usage()
    with slots_of_this_process() as slots:
        study = read_study(described(folder, runs))
        run_study(study, StudyOptions(out=folder / f"{runs}", workers=workers), slots)
    cpu, faults = usage()
    return time.perf_counter() - began, cpu - used, faults - faulted


def executed(folder: Path, runs: int) -> float:
    """CPU seconds of a run in this process."""
    paths = RunPaths(recording=folder / "none.zip", exports=folder / "none")
    points = load_study(described(folder, runs)).runs
    began = time.process_time()
    for point in points:
        execute(point.config, point.run_id, paths)
    return (time.process_time() - began) / runs


def usage() -> tuple[float, int]:
    """CPU seconds and page faults of this process and of those that it has waited for."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used), sum(each.ru_minflt for each in used)


if __name__ == "__main__":
    main()
