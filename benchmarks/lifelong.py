"""Measure how long an execution of a fleet with tasks that keep coming takes, and whether its memory grows.

By default the case that LSMART publishes: 1,000 robots on the MovingAI map warehouse-10-20-10-2-1, each of which always
has a goal, PIBT asked for a new plan in each simulated second, 600 s, without lidars. Prints for each tenth of the
execution the wall and CPU seconds that it took, the tasks done and the memory of the process (VmRSS), then the calls of
the planner. With `--profile`, the functions that take the most time follow; the profiler's own weight is on them.
"""

import argparse
import cProfile
import pstats
import tempfile
import time
from pathlib import Path
from typing import Any

from mrpbench_core.api.hooks import hookimpl
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.plugins.hooks import Hooks
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording


class Watch:
    """Notes clocks and memory in each tenth of an execution."""

    def __init__(self, seconds: float) -> None:
        self._every = seconds / 10
        self._due = 0.0
        self.rows: list[tuple[float, float, float, float]] = []
        """Simulated, wall and CPU seconds, MiB."""

    @hookimpl
    def mrpbench_stepped(self, now: float) -> None:
        """Take note of a control period."""
        if now >= self._due - 1e-9:
            self._due += self._every
            self.rows.append((now, time.perf_counter(), time.process_time(), resident()))


def resident() -> float:
    """MiB of memory of this process now."""
    (line,) = (line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("VmRSS"))
    return int(line.split()[1]) / 1024


def config(options: argparse.Namespace) -> dict[str, Any]:
    """One run."""
    return {
        "name": "lifelong",
        "world": {"plugin": "movingai", "file": str(options.map.resolve()), "resolution": 0.5},
        "roadmap": "grid",
        "scenario": {"plugin": "random", "robots": options.robots},
        "fleet": {"robot": "turtlebot3_burger", "lidar": "none"},
        "tasks": {"plugin": "closed_pool", "per_robot": 1, "errands": 1, "service": 0},
        "assigner": options.assigner,
        "planner": {"plugin": "rolling_horizon", "planner": "pibt"},
        "dispatcher": {"plugin": "adg", "lookahead": options.lookahead},
        "navigator": {"plugin": "waypoints", "turn_ahead": options.turn_ahead},
        "replanning": {"period": 1, **({"window": options.window} if options.window else {})},
        "simulator": "planar",
        "control_rate": options.control_rate,
        "recording": {"rate": 1},
        "limits": {"execution": options.seconds, "planning": "1 min", "iterations": 1},
        "metrics": [],
    }


def main() -> None:
    """Execute the run once and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("map", type=Path, help="warehouse-10-20-10-2-1.map")
    parser.add_argument("--robots", type=int, default=1000)
    parser.add_argument("--seconds", type=float, default=600.0, help="simulated")
    parser.add_argument("--window", type=float, default=10.0, help="simulated seconds; 0: plans lead to the goals")
    parser.add_argument("--lookahead", type=int, default=1, help="segments released beyond the one under way")
    parser.add_argument("--turn-ahead", action="store_true", help="robots that wait turn to the next waypoint")
    parser.add_argument("--assigner", default="identity")
    parser.add_argument("--control-rate", type=float, default=10.0)
    parser.add_argument("--profile", type=int, default=0, metavar="N", help="print the N most expensive functions")
    options = parser.parse_args()
    (point,) = load_study(config(options)).runs
    watch, profile = Watch(options.seconds), cProfile.Profile(time.process_time)
    with tempfile.TemporaryDirectory() as name:
        paths = RunPaths(recording=Path(name) / "run.zip", exports=Path(name) / "exports")
        if options.profile:
            profile.enable()
        hooks = Hooks()
        hooks.register(watch, "watch")
        record = execute(point.config, "lifelong", paths, hooks=hooks)
        profile.disable()
        recording = Recording(paths.recording)
        size = paths.recording.stat().st_size / 2**20
        done = recording.channel("task_time")[recording.channel("task_event") == "done"]
        failed = int((recording.channel("event_kind") == "replan_failed").sum())
        recording.close()
    print(f"{'simulated s':>12} {'wall s':>8} {'CPU s':>8} {'tasks':>7} {'MiB':>7}")
    for (before, wall, cpu, _), (now, wall_now, cpu_now, memory) in zip(watch.rows, watch.rows[1:], strict=False):
        tasks = int(((done > before) & (done <= now)).sum())
        print(f"{now:>12.0f} {wall_now - wall:>8.2f} {cpu_now - cpu:>8.2f} {tasks:>7} {memory:>7.0f}")
    wall, cpu = (watch.rows[-1][column] - watch.rows[0][column] for column in (1, 2))
    print(
        f"{record.status}: {watch.rows[-1][0]:g} simulated s in {wall:.1f} s of wall time and {cpu:.1f} s of CPU time"
    )
    print(f"{len(done)} tasks done, recording {size:.0f} MiB, {failed} plans not found")
    print({name: value for name, value in record.timing.items() if name.startswith("replanning")})
    if options.profile:
        pstats.Stats(profile).sort_stats("tottime").print_stats(options.profile)


if __name__ == "__main__":
    main()
