"""How many times faster than real time whole executions are on one core, and where the time goes.

Everything is on: lidars of 360 beams at 5 Hz, for every robot a costmap and Nav2's DWB with seven critics at 20 Hz,
recoveries, the dispatcher `adg`, the recording. Robots cross a generated warehouse by plans of `prioritized`. The last
row is a thousand robots with pure pursuit and no lidars. CPU time of the execution is counted, from its first control
period to its last, so that a busy machine matters less; of several rounds the fastest counts.
"""

import argparse
import cProfile
import pstats
import tempfile
import time
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.pipeline import Observers, execute
from mrpbench_core.store.paths import RunPaths

PARTS = {
    "simulator": ("simulation.py", "step"),
    "scans": ("simulation.py", "_take_scans"),
    "controller": ("session.py", "command"),
    "pure_pursuit": ("pure_pursuit.py", "command"),
    "navigator": ("waypoints.py", "step"),
    "dispatcher": ("adg.py", "update"),
    "localizer": ("ground_truth.py", "update"),
    "checks": ("answers.py", ""),
    "recorder": ("recorder.py", ""),
}
"""File and function of each part of the loop; without a function, all of the file's that the loop calls."""


@attrs.frozen
class Case:
    """One row of the table."""

    simulator: str
    robots: int
    controller: str = "dwb"
    seconds: float = 20.0
    options: dict[str, Any] = attrs.field(factory=dict)

    @property
    def config(self) -> dict[str, Any]:
        """One run."""
        side = max(4, round((self.robots / 3) ** 0.5))
        robot = (
            {"robot": "turtlebot3_burger"}
            if self.controller == "dwb"
            else {"robot": "turtlebot3_burger", "lidar": "none"}
        )
        return {
            "name": "speed",
            "world": {
                "plugin": "generated_warehouse",
                "shelf_rows": 2 * side,
                "shelf_columns": side,
                "shelf_length": 5,
                "cell_size": 0.4,
            },
            "roadmap": "grid",
            "scenario": {"plugin": "random", "robots": self.robots},
            "fleet": [robot],
            "assigner": "identity",
            "planner": "prioritized",
            "controller": {"plugin": self.controller, **self.options},
            "simulator": self.simulator,
            "metrics": [],
            "limits": {"execution": self.seconds, "planning": "10 min"},
        }


class Clock:
    """CPU seconds of the control periods of one execution."""

    def __init__(self) -> None:
        self.began: float | None = None
        self.simulated = self.spent = 0.0

    def stepped(self, *, now: float, **_: object) -> None:
        """Take note of a period that has ended."""
        if self.began is None:
            self.began = time.process_time()
        self.simulated, self.spent = now, time.process_time() - self.began


def run(case: Case, profile: cProfile.Profile | None = None) -> float:
    """Simulated seconds per CPU second."""
    (point,) = load_study(case.config).runs
    clock = Clock()
    with tempfile.TemporaryDirectory() as name:
        paths = RunPaths(recording=Path(name) / "run.zip", exports=Path(name) / "exports")
        if profile is not None:
            profile.enable()
        record = execute(point.config, "speed", paths, lambda *_: None, Observers(stepped=clock.stepped))
        if profile is not None:
            profile.disable()
    if record["status"] not in ("succeeded", "goals_missed"):
        raise SystemExit(f"{case}: {record['status']}: {record.get('error')}")
    return clock.simulated / clock.spent


def shares(case: Case) -> dict[str, float]:
    """Milliseconds per simulated second of each part of the loop, with the profiler's own weight on it."""
    profile = cProfile.Profile(time.process_time)
    run(case, profile)
    found = dict.fromkeys(PARTS, 0.0)
    stats: Any = pstats.Stats(profile)
    for (file, _, function), (_, _, _, cumulative, callers) in stats.stats.items():
        for part, (module, wanted) in PARTS.items():
            if Path(file).name != module or (wanted and function != wanted):
                continue
            called = [spent for (caller, *_), (*_, spent) in callers.items() if Path(caller).name != module]
            found[part] += sum(called) if not wanted else cumulative
    found["navigator"] -= found["controller"] + found["pure_pursuit"]
    found["simulator"] -= found["scans"]
    return {part: 1000 * spent / case.seconds for part, spent in found.items() if spent > 0}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("robots", nargs="*", type=int, default=[9, 100, 400], help="numbers of robots with dwb")
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--seconds", type=float, default=20.0, help="simulated, of each execution")
    parser.add_argument("--threads", type=int, default=1, help="of dwb")
    options = parser.parse_args()
    threads = {"threads": options.threads}
    cases = [Case("planar", robots, seconds=options.seconds, options=threads) for robots in options.robots]
    if find_spec("pybullet") is not None:
        cases += [Case("pybullet", 9, seconds=options.seconds, options=threads)]
    cases += [Case("planar", 1000, "pure_pursuit", options.seconds)]
    print(
        "simulator  robots controller     x real time   milliseconds per simulated second, with the profiler's weight"
    )
    for case in cases:
        best = max(run(case) for _ in range(options.rounds))
        parts = ", ".join(f"{part} {spent:.1f}" for part, spent in sorted(shares(case).items(), key=lambda it: -it[1]))
        print(f"{case.simulator:<10} {case.robots:>6} {case.controller:<13} {best:>10.1f}x   {parts}", flush=True)


if __name__ == "__main__":
    main()
