"""Measure how many executions without physics a second of CPU time holds, by dispatcher, and the share of each part.

    python benchmarks/draws.py --worlds office --robots 10 25 --dispatchers adg btpg gses

Each plan is that of `prioritized`, with the delays of `studies/late_robots.yaml` at p = 0.01, executed under so many
draws of the delays that they take a second. Counted are the draws after the first one, which is recorded. Shares are
those of a profile, with the profiler's own weight on them; `loop` is what is left: the motion of the robots.
"""

import argparse
import cProfile
import pstats
import tempfile
import time
from pathlib import Path
from typing import Any

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.store.paths import RunPaths

PARTS = {
    "delays": ("delays.py", ""),
    "start": ("", "start"),
    "dispatcher": ("", "update"),
}
"""File and function of each part; without a function, all of the file's that others call, without a file, any of a
dispatcher's."""
DISPATCHERS = "dispatching", "dispatchers", "mrpbench_dispatchers_reordering"
"""Folders of dispatchers."""
LIMIT = 1 << 14


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--worlds", nargs="+", default=["office", "warehouse"])
    parser.add_argument("--robots", type=int, nargs="+", default=[10, 25])
    parser.add_argument("--dispatchers", nargs="+", default=["adg", "btpg", "gses"])
    parser.add_argument("--seconds", type=float, default=1.0, help="CPU seconds that the draws of a row take at least")
    given = parser.parse_args()
    print(f"{'world':10} {'robots':>6} {'dispatcher':10} {'draws':>6} {'a second':>9} {'ms each':>8}  shares")
    for world in given.worlds:
        for robots in given.robots:
            for dispatcher in given.dispatchers:
                draws, spent, first = 4, 0.0, executed(world, robots, dispatcher, 1)
                while spent < given.seconds and draws < LIMIT:
                    draws *= 4
                    spent = executed(world, robots, dispatcher, draws) - first
                each = spent / (draws - 1)
                profile = cProfile.Profile(time.process_time)
                executed(world, robots, dispatcher, draws, profile)
                figures = f"{draws:6} {1 / each:9.1f} {1000 * each:8.3f}"
                print(f"{world:10} {robots:6} {dispatcher:10} {figures}  {shares(profile)}", flush=True)


def executed(world: str, robots: int, dispatcher: str, draws: int, profile: cProfile.Profile | None = None) -> float:
    """CPU seconds of the executions of a run with so many draws."""
    (point,) = load_study(
        {
            "name": "draws",
            "world": world,
            "roadmap": {"plugin": "grid", "cell_size": 0.5},
            "scenario": {"plugin": "random", "robots": robots},
            "assigner": "identity",
            "planner": "prioritized",
            "dispatcher": {"plugin": dispatcher, "lookahead": 1}
            if dispatcher not in ("all_at_once", "timed")
            else dispatcher,
            "execution": "schedule_only",
            "control_rate": "1 Hz",
            "delays": {"p_delay": 0.01, "min_delay": 10, "max_delay": 20, "draws": draws},
            "metrics": [],
            "recording": {"keep": "none", "rate": "0.5 Hz"},
            "limits": {"planning": "60 s", "execution": "2 h"},
        }
    ).runs
    times: dict[Stage, float] = {}

    def announce(stage: Stage, _: object) -> None:
        if profile is not None and stage is Stage.EXECUTION:
            profile.enable()
        times[stage] = time.process_time()
        if profile is not None and stage is Stage.EXPORT:
            profile.disable()

    with tempfile.TemporaryDirectory() as name:
        paths = RunPaths(recording=Path(name) / "run.zip", exports=Path(name) / "exports")
        try:
            record = execute(point.config, "draws", paths, announce)
        except InputError as error:
            raise SystemExit(f"{world}, {robots} robots, {dispatcher}: {error}") from None
    if record.status != RunStatus.SUCCEEDED:
        raise SystemExit(f"{world}, {robots} robots, {dispatcher}: {record.status}: {record.error}")
    return times[Stage.EXPORT] - times[Stage.EXECUTION]


def shares(profile: cProfile.Profile) -> str:
    """The share of each part of the executions."""
    stats: Any = pstats.Stats(profile)
    found = dict.fromkeys(PARTS, 0.0)
    for (file, _, function), (_, _, _, _, callers) in stats.stats.items():
        for part, (module, wanted) in PARTS.items():
            theirs = Path(file).name == module if module else any(folder in Path(file).parts for folder in DISPATCHERS)
            if theirs and wanted in ("", function):
                outside = [spent for (caller, *_), (*_, spent) in callers.items() if not _inside(caller, file, module)]
                found[part] += sum(outside)
    left = stats.total_tt - sum(found.values())
    return ", ".join(f"{part} {spent / stats.total_tt:.0%}" for part, spent in {**found, "loop": left}.items())


def _inside(caller: str, file: str, module: str) -> bool:
    """Tell whether a call is one within the same part."""
    return caller == file if module else any(folder in Path(caller).parts for folder in DISPATCHERS)


if __name__ == "__main__":
    main()
