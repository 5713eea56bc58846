"""Measure the overhead of a run: processes, messages, record.

Prints milliseconds per run for a minimal run, in a study and alone in this process, and their difference.
"""

import tempfile
import time
from pathlib import Path

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.pipeline import execute
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.engine.study.options import StudyOptions
from mrpbench_core.engine.study.reading import read_study
from mrpbench_core.engine.study.study import run_study
from mrpbench_core.store.paths import RunPaths

RUNS = 1000


def main() -> None:
    """Measure the rows and print the table."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "tiny.map").write_text("type octile\nheight 3\nwidth 3\nmap\n...\n...\n...\n")
        described = {
            "world": {"plugin": "movingai", "file": str(folder / "tiny.map")},
            "roadmap": "grid",
            "scenario": {"plugin": "random", "robots": 1},
            "assigner": "identity",
            "planner": "example",
            "simulator": "none",
            "metrics": [],
            "matrix": {"seed": f"0..{RUNS - 1}"},
        }
        with slots_of_this_process() as slots:
            began = time.perf_counter()
            study = read_study(described)
            run_study(study, StudyOptions(out=folder / "warm-up", shard=f"0/{RUNS}"), slots)
            start = time.perf_counter() - began
            began = time.perf_counter()
            run_study(study, StudyOptions(out=folder / "out"), slots)
            studied = (time.perf_counter() - began) / RUNS
        paths = RunPaths(recording=folder / "none.zip", exports=folder / "none")
        points = load_study(described).runs
        began = time.perf_counter()
        for point in points:
            execute(point.config, point.run_id, paths, lambda stage, facts: None)  # noqa: ARG005
        alone = (time.perf_counter() - began) / RUNS
    print(f"{studied * 1e3:.2f} ms in a study, {alone * 1e3:.2f} ms alone: {(studied - alone) * 1e3:.2f} ms a run")
    print(f"{start:.2f} s to read a study and to start its first worker")


if __name__ == "__main__":
    main()
