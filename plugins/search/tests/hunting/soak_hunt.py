"""Hunts for planted faults and counts the runs until each is found, with several seeds of the search.

    python plugins/search/tests/hunting/soak_hunt.py 5              # searches for each fault
    python plugins/search/tests/hunting/soak_hunt.py 5 200          # also so many random seeds
    python plugins/search/tests/hunting/soak_hunt.py 5 200 wake_up  # for one fault

The fault of `planner` is compared with `RANDOM` of `test_hunt.py`, others with as many random seeds as are stated.
"""

import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "commands"))

from mrpbench_search.hunting.properties import read_property  # noqa: E402
from test_hunt import HALL, RANDOM, STUDY  # noqa: E402

EXECUTED = """\
name: {name}
world: {{plugin: movingai, file: hall.map, resolution: {cell}}}
roadmap: grid
scenario: {{plugin: random, robots: {robots}}}
control_rate: 10
recording: {{rate: 5}}
metrics: [planning, execution, people]
"""
ONCE = """\
assigner: identity
planner: example
"""
DISPATCHER = """\
fleet: {robot: turtlebot3_burger, lidar: none}
dispatcher: {plugin: "./faulty.py:ReleasesEarly"}
limits: {execution: 60 s}
"""
CONTROLLER = """\
controller: {plugin: "./faulty.py:BlindLeft"}
limits: {execution: 120 s}
faults: {events: [{kind: blocked, at: 1 s}], patience: 10 s}
"""
WAKE_UP = DISPATCHER.replace("faulty.py:ReleasesEarly", "other_faults.py:LosesWakeUp") + "seed: 1  # 0 shows it\n"
SAME_GOAL = """\
fleet: {robot: turtlebot3_burger, lidar: none}
tasks: {plugin: poisson, rate: 3}
assigner: {plugin: "./other_faults.py:KeyedByGoal"}
planner: {plugin: rolling_horizon, planner: pibt}
limits: {execution: 60 s}
"""
STUDIES = {
    "planner": (STUDY, "invalid"),
    "dispatcher": (EXECUTED.format(name="dispatcher", cell=0.5, robots=4) + ONCE + DISPATCHER, "contact"),
    "controller": (EXECUTED.format(name="controller", cell=1, robots=2) + ONCE + CONTROLLER, "contact"),
    "parked": (STUDY.replace("faulty.py:SwapsAtJunctions", "other_faults.py:ForgetsParked"), "invalid"),
    "wake_up": (EXECUTED.format(name="wake_up", cell=0.5, robots=5) + ONCE + WAKE_UP, "failure"),
    "same_goal": (EXECUTED.format(name="same_goal", cell=0.5, robots=3) + SAME_GOAL, "crash"),
}
BUDGET = "250runs"


def main(searches: int, seeds: int, names: list[str]) -> None:
    """Print two lines for each fault."""
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for file in ("faulty.py", "other_faults.py"):
            shutil.copy(HERE / file, folder)
        Path("hall.map").write_text(f"type octile\nheight 9\nwidth 12\nmap\n{HALL}")
        for name in names or STUDIES:
            study, kind = STUDIES[name]
            Path(f"{name}.yaml").write_text(study)
            found = [hunt(name, kind, seed) for seed in range(searches)]
            after = [each["found_after"] if each else 250 for each in found]
            robots = statistics.median([each["robots"] for each in found if each] or [0])
            again = [f"{each['again']}/{each['repeats']}" for each in found if each]
            needed = f"1 of {RANDOM}" if name == "planner" else random_seeds(name, kind, seeds)
            print(f"{name}: found after {after} cases, median {statistics.median(after):g}", flush=True)
            print(f"  shrunk to {robots:g} robots (median), again {again}, random seeds {needed}", flush=True)


def hunt(name: str, kind: str, seed: int) -> dict[str, int] | None:
    """Return the failure of one search, None if it finds none."""
    words = ("--for", kind, "--most", "1", "--budget", BUDGET, "--seed", seed, "--out", f"{name}-{seed}", "--json")
    answer = json.loads(mrpbench("hunt", f"{name}.yaml", *words))
    return next(iter(answer["failures"]), None)


def random_seeds(name: str, kind: str, count: int) -> str:
    """Say how many of so many random seeds show the fault."""
    if not count:
        return "not run"
    mrpbench("run", f"{name}.yaml", f"seed=0..{count - 1}", "--out", f"{name}-random")
    lines = [line for file in Path(f"{name}-random", "runs").iterdir() for line in file.read_text().splitlines()]
    tried = read_property(kind, ("",), {}, None)
    return f"{sum(bool(tried.judge([json.loads(line)]).failures) for line in lines)} of {count}"


def mrpbench(*words: object) -> str:
    """Run a command and return its output."""
    command = [sys.executable, "-m", "mrpbench_core.cli.main", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0, sys.argv[3:])
