"""Measure the overhead of a run: worker slot, messages, record.

Prints milliseconds per run for a minimal run, in a study and alone in this process, and their difference.
"""

import tempfile
import time
from pathlib import Path

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.pipeline import execute
from mrpbench_core.engine.study.invoke import prepare
from mrpbench_core.engine.study.study import run_study
from mrpbench_core.store.paths import RunPaths

RUNS = 1000


def main() -> None:
    """Measure the rows and print the table."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "tiny.map").write_text("type octile\nheight 3\nwidth 3\nmap\n...\n...\n...\n")
        study = load_study(
            {
                "world": {"plugin": "movingai", "file": str(folder / "tiny.map")},
                "roadmap": "grid",
                "scenario": {"plugin": "random", "robots": 1},
                "assigner": "identity",
                "planner": "example",
                "simulator": "none",
                "metrics": [],
                "matrix": {"seed": f"0..{RUNS - 1}"},
            }
        )
        warm_up = prepare(study, out=folder / "warm-up", shard=f"0/{RUNS}")
        began = time.perf_counter()
        run_study(study, warm_up)
        start = time.perf_counter() - began
        began = time.perf_counter()
        run_study(study, prepare(study, out=folder / "out"))
        studied = (time.perf_counter() - began - start) / RUNS
        paths = RunPaths(recording=folder / "none.zip", exports=folder / "none")
        began = time.perf_counter()
        for point in study.runs:
            execute(point.config, point.run_id, paths, lambda stage, facts: None)  # noqa: ARG005
        alone = (time.perf_counter() - began) / RUNS
    print(f"{studied * 1e3:.2f} ms in a study, {alone * 1e3:.2f} ms alone: {(studied - alone) * 1e3:.2f} ms a run")
    print(f"{start:.2f} s to start a study and its first worker")


if __name__ == "__main__":
    main()
