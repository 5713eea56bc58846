"""Measure how many times faster than real time whole executions are on one core, and the share of each part.

Everything is on: lidars of 360 beams at 5 Hz, for every robot a costmap and Nav2's DWB with seven critics at 20 Hz (or
MPPI, or RPP), recoveries, the dispatcher `adg`, the recording. Robots cross a generated warehouse by plans of
`prioritized`, in one row among people who walk by social forces. The last row is a thousand robots with pure pursuit
and no lidars. The target is simulated seconds per second on one core; CPU time counts less of what else a machine does
than wall time. From the first control period to the last; of several rounds the fastest.
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

from mrpbench_core.api.hooks import hookimpl
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_core.plugins.hooks import Hooks
from mrpbench_core.store.paths import RunPaths

PARTS = {
    "simulator": ("simulation.py", "step"),
    "scans": ("simulation.py", "_take_scans"),
    "crowd": ("mrpbench_crowds_walking/session.py", "step"),
    "controller": ("session.py", "command"),
    "pure_pursuit": ("pure_pursuit.py", "command"),
    "navigator": ("mrpbench_navigators_waypoints/session.py", "step"),
    "dispatcher": ("order_keeping.py", "update"),
    "localizer": ("ground_truth.py", "update"),
    "checks": ("contract_checks.py", ""),
    "recorder": ("recorder.py", ""),
}
"""File and function of each part of the loop; without a function, all of the file's that the loop calls."""
COSTMAPS = ("dwb", "mppi", "rpp")
"""Controllers that work by scans, and share the robots among threads."""


@attrs.frozen
class Case:
    """One row of the table."""

    simulator: str | dict[str, Any]
    robots: int
    controller: str = "dwb"
    people: int = 0
    seconds: float = 20.0
    threads: int = 1

    @property
    def simulator_name(self) -> str:
        """The name of the plugin of the simulator."""
        return self.simulator if isinstance(self.simulator, str) else str(self.simulator["plugin"])

    @property
    def config(self) -> dict[str, Any]:
        """One run."""
        side = max(4, round((self.robots / 3) ** 0.5))
        robot = (
            {"robot": "turtlebot3_burger"}
            if self.controller in COSTMAPS
            else {"robot": "turtlebot3_burger", "lidar": "none"}
        )
        return {
            "name": "speed",
            "world": {
                "plugin": "generated_warehouse",
                "shelf_rows": 2 * side,
                "shelf_columns": side,
                "shelf_length": 5,
                "resolution": 0.4,
            },
            "roadmap": "grid",
            "scenario": {"plugin": "random", "robots": self.robots},
            "fleet": [robot],
            "assigner": "identity",
            "planner": "prioritized",
            "controller": {
                "plugin": self.controller,
                **({"threads": self.threads} if self.controller in COSTMAPS else {}),
            },
            "simulator": {"plugin": "planar", "threads": self.threads}
            if self.simulator == "planar"
            else self.simulator,
            **({"crowds": {"plugin": "social_force", "people": self.people}} if self.people else {}),
            "metrics": [],
            "limits": {"execution": self.seconds, "planning": "10 min"},
        }


ROWS = {
    "planar-9": (Case("planar", 9), 150),
    "planar-100": (Case("planar", 100), 25),
    "planar-400": (Case("planar", 400), 7),
    "planar-100-people": (Case("planar", 100, people=100), 12),
    "planar-9-mppi": (Case("planar", 9, "mppi"), 40),
    "planar-100-mppi": (Case("planar", 100, "mppi"), 3),
    "planar-100-rpp": (Case("planar", 100, "rpp"), 30),
    "wheels-9": (Case("pybullet", 9), 12),
    "bodies-9": (Case({"plugin": "pybullet", "model": "body"}, 9), 60),
    "planar-1000-pure_pursuit": (Case("planar", 1000, "pure_pursuit"), 20),
}
"""Rows of the table, and how many times faster than real time each is to be."""


class Clock:
    """CPU and wall seconds of one execution, from the end of its first control period to the end of its last."""

    def __init__(self) -> None:
        self.simulated = 0.0
        self._began: tuple[float, float] | None = None

    @hookimpl
    def mrpbench_stepped(self, now: float) -> None:
        """Take note of a period that has ended."""
        if self._began is None:
            self._began = time.process_time(), time.perf_counter()
        self.simulated = now

    @hookimpl
    def mrpbench_executed(self) -> None:
        """Take note of the end."""
        assert self._began is not None
        cpu, wall = self._began
        self.cpu, self.wall = time.process_time() - cpu, time.perf_counter() - wall


def run(case: Case, profile: cProfile.Profile | None = None) -> Clock:
    """Execute the case once."""
    (point,) = load_study(case.config).runs
    clock = Clock()
    with tempfile.TemporaryDirectory() as name:
        paths = RunPaths(recording=Path(name) / "run.zip", exports=Path(name) / "exports")
        if profile is not None:
            profile.enable()
        hooks = Hooks()
        hooks.register(clock, "clock")
        record = execute(point.config, "speed", paths, hooks=hooks)
        if profile is not None:
            profile.disable()
    if record.status not in (RunStatus.SUCCEEDED, RunStatus.GOALS_MISSED):
        raise SystemExit(f"{case}: {record.status}: {record.error}")
    return clock


def shares(case: Case) -> dict[str, float]:
    """Milliseconds per simulated second of each part of the loop, with the profiler's own weight on it."""
    profile = cProfile.Profile(time.process_time)
    run(case, profile)
    found = dict.fromkeys(PARTS, 0.0)
    stats: Any = pstats.Stats(profile)
    for (file, _, function), (_, _, _, cumulative, callers) in stats.stats.items():
        for part, (module, wanted) in PARTS.items():
            if not Path(file).match(module) or (wanted and function != wanted):
                continue
            called = [spent for (caller, *_), (*_, spent) in callers.items() if Path(caller).name != module]
            found[part] += sum(called) if not wanted else cumulative
    found["navigator"] -= found["controller"] + found["pure_pursuit"]
    found["simulator"] -= found["scans"]
    return {part: 1000 * spent / case.seconds for part, spent in found.items() if spent > 0}


def main() -> None:
    """Measure the rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rows", nargs="*", default=list(ROWS), help=f"of {', '.join(ROWS)} (default: all)")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=20.0, help="simulated, of each execution")
    parser.add_argument("--threads", type=int, default=1, help="of lidars, and of controllers with a costmap")
    options = parser.parse_args()
    if unknown := set(options.rows) - set(ROWS):
        parser.error(f"no such row: {', '.join(sorted(unknown))}")
    print(f"{'':26}  x real time by")
    print(
        f"{'':26} {'asked':>6} {'CPU':>6} {'wall':>6}   milliseconds per simulated second, with the profiler's weight"
    )
    for name in options.rows:
        case, asked = ROWS[name]
        if case.simulator_name == "pybullet" and find_spec("pybullet") is None:
            print(f"{name:<26} {asked:>5}x   no PyBullet here")
            continue
        case = attrs.evolve(case, seconds=options.seconds, threads=options.threads)
        rounds = [run(case) for _ in range(options.rounds)]
        cpu = max(clock.simulated / clock.cpu for clock in rounds)
        wall = max(clock.simulated / clock.wall for clock in rounds)
        parts = ", ".join(f"{part} {spent:.1f}" for part, spent in sorted(shares(case).items(), key=lambda it: -it[1]))
        print(f"{name:<26} {asked:>5}x {cpu:>5.1f}x {wall:>5.1f}x   {parts}", flush=True)


if __name__ == "__main__":
    main()
