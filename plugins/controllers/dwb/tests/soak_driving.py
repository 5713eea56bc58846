"""Drives robots in many worlds with `dwb` and finds those that stand although nothing is in their way.

    python plugins/controllers/dwb/tests/soak_driving.py RUNS SEED [--workers 1] [--keep FOLDER]

Each run draws its world, number of robots, dispatcher, parameters of `dwb` and noise from its seed. Prints one line per
run that did not succeed and a table of causes. The exit code is 1 if a robot stood with free space ahead.
"""

import argparse
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import attrs
import numpy as np
from mrpbench_metrics_standard.progress import progress
from mrpbench_navigators_waypoints.obstructions import obstruction

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.runs.status import PLANNED, RunStatus
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

WORLDS: dict[str, tuple[dict[str, Any], int]] = {
    "office": ({"world": "office"}, 9),
    "warehouse": ({"world": "warehouse"}, 20),
    "airport": ({"world": "airport", "limits": {"execution": "15 min", "planning": "20 s"}}, 12),
    "random": ({"world": "generated_random", "roadmap": "grid"}, 12),
    "rooms": ({"world": "generated_rooms", "roadmap": "grid"}, 12),
    "shelves": ({"world": "generated_warehouse", "roadmap": "grid"}, 20),
}
"""Worlds, and the largest number of robots in each."""
SHARES = (0.24, 0.19, 0.04, 0.19, 0.19, 0.15)
"""Share of the runs in each; those in the airport take long."""
NAV2 = Path(__file__).with_name("nav2_params.yaml")
MOVED = 0.05
"""metres along its path by which a robot must move so that it does not stand."""
STANDS = "STANDS with free space ahead"


@attrs.frozen
class Standing:
    """A robot that did not arrive."""

    robot: int
    since: float
    """Simulated second of its last progress."""
    cause: str
    detail: str


@attrs.frozen
class RunOutcome:
    """The outcome of a run."""

    seed: int
    name: str
    status: str
    error: str
    standing: tuple[Standing, ...]
    touched: tuple[str, ...]
    """What robots touched: `robot`, `wall`, or both."""


def config(seed: int) -> dict[str, Any]:
    """The configuration of one run."""
    random = np.random.default_rng(seed)
    name = str(random.choice(list(WORLDS), p=SHARES))
    world, most = WORLDS[name]
    noisy = bool(random.integers(2))
    noise = {"lidar": 0.01, "lidar_dropout": 0.01, "odometry": 0.01, "actuation": 0.05, "start_jitter": 2.0}
    return {
        "name": name,
        "limits": {"execution": "5 min", "planning": "20 s"},
        **world,
        "scenario": {"plugin": "random", "robots": int(random.integers(5, most + 1))},
        "planner": str(random.choice(["prioritized", "ecbs"])),
        "dispatcher": str(random.choice(["adg", "adg", "timed"])),
        "controller": {"plugin": "dwb", **({"nav2": str(NAV2)} if random.integers(2) else {})},
        "simulator": "planar",
        **({"noise": noise} if noisy else {}),
        "metrics": [],
        "seed": seed,
    }


def label(settings: dict[str, Any]) -> str:
    """The drawn settings of a run in a few words."""
    nav2, noise = "nav2" in settings["controller"], "noise" in settings
    words = [settings["name"], str(settings["scenario"]["robots"]), settings["planner"], settings["dispatcher"]]
    return " ".join([*words, *["nav2"] * nav2, *["noise"] * noise])


def drive(seed: int, keep: Path | None) -> RunOutcome:
    """Execute one run and look for robots that stand."""
    settings = config(seed)
    (point,) = load_study(settings).runs
    with tempfile.TemporaryDirectory() as name:
        paths = RunPaths(recording=Path(name) / "run.zip", exports=Path(name) / "exports")
        record = execute(point.config, str(seed), paths, lambda *_: None)
        found: tuple[Standing, ...] = ()
        touched: tuple[str, ...] = ()
        if record.status in PLANNED and paths.recording.exists():
            recording = Recording(paths.recording)
            found = tuple(standing_robots(recording))
            others = recording.channel("contact")[:, 1]
            touched = ("robot",) * bool((others >= 0).any()) + ("wall",) * bool((others < 0).any())
            recording.close()
            if keep is not None and record.status != RunStatus.SUCCEEDED:
                (keep / f"{seed}.zip").write_bytes(paths.recording.read_bytes())
    return RunOutcome(seed, label(settings), str(record.status), str(record.error or ""), found, touched)


def standing_robots(recording: Recording) -> Iterator[Standing]:
    """Robots that did not arrive, each with the reason for which it stands."""
    context = recording.context()
    time, truth, level, reached, released, mode = (
        recording.channel(name) for name in ("time", "truth", "level", "reached", "released", "mode")
    )
    along = progress(truth, reached, context.routes)
    events = list(zip(*(recording.channel(f"event_{it}") for it in ("time", "kind", "robot", "detail")), strict=True))
    for robot, route in enumerate(context.routes):
        if reached[-1, robot] >= route.last_move:
            continue
        moving = np.flatnonzero(along[:, robot] < along[:, robot].max() - MOVED)
        at = min(int(moving[-1]) + 1, len(time) - 1) if len(moving) else 0
        own = [(float(when), str(kind), str(detail)) for when, kind, who, detail in events if who == robot]
        said = "; ".join(f"{when:.1f} {kind} {detail}" for when, kind, detail in own if when >= time[at])
        if mode[-1, robot] != Mode.ABORTED and released[-1, robot] <= reached[-1, robot]:
            cause = "not released"
        elif mode[-1, robot] != Mode.ABORTED and time[-1] - time[at] < 20:
            cause = "still under way"
        else:
            route_ahead = route.waypoint[reached[at, robot] + 1 :, :2]
            cause = obstruction(context.fleet, context.world, robot, truth[at], level[at], route_ahead) or STANDS
        yield Standing(robot, float(time[at]), cause, said)


def main() -> int:
    """Drive, print what stands and why."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", type=int)
    parser.add_argument("seed", type=int)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--keep", type=Path, help="folder for the recordings of runs that did not succeed")
    given = parser.parse_args()
    if given.keep is not None:
        given.keep.mkdir(parents=True, exist_ok=True)
    statuses: Counter[str] = Counter()
    causes: Counter[str] = Counter()
    contacts: Counter[str] = Counter()
    seeds = range(given.seed, given.seed + given.runs)
    with ProcessPoolExecutor(given.workers) as pool:
        for outcome in pool.map(partial(drive, keep=given.keep), seeds):
            statuses[outcome.status] += 1
            if statuses.total() % 50 == 0:
                print(f"{statuses.total()} runs: {dict(statuses)}, {dict(causes)}", flush=True)
            causes.update({it.cause for it in outcome.standing})
            contacts.update(f"{'adg' if ' adg' in outcome.name else 'timed'}: {it}" for it in outcome.touched)
            if outcome.status != RunStatus.SUCCEEDED:
                print(f"seed {outcome.seed} ({outcome.name}): {outcome.status} {outcome.error}", flush=True)
            for it in outcome.standing:
                print(f"    robot {it.robot} since {it.since:.1f} s: {it.cause}; {it.detail}", flush=True)
    print(f"{given.runs} runs:", ", ".join(f"{count} {status}" for status, count in statuses.most_common()))
    print("runs with robots that:", ", ".join(f"{count} {cause}" for cause, count in causes.most_common()) or "-")
    print("runs with contacts:", ", ".join(f"{count} {kind}" for kind, count in contacts.most_common()) or "-")
    return int(causes[STANDS] > 0)


if __name__ == "__main__":
    sys.exit(main())
