"""Hunts for three planted faults and counts the runs until each is found, with several seeds of the search.

    python plugins/search/tests/hunting/soak_hunt.py 5      # searches for each fault
    python plugins/search/tests/hunting/soak_hunt.py 5 200  # also random seeds for the two faults of executions

The fault of the planner is compared with `RANDOM` of `test_hunt.py`, others with as many random seeds as are stated.
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

from test_hunt import HALL, RANDOM, STUDY  # noqa: E402

EXECUTED = """\
name: {name}
world: {{plugin: movingai, file: hall.map, resolution: {cell}}}
roadmap: grid
scenario: {{plugin: random, robots: {robots}}}
assigner: identity
planner: example
control_rate: 10
recording: {{rate: 5}}
metrics: [planning, execution, people]
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
STUDIES = {
    "planner": (STUDY, "invalid"),
    "dispatcher": (EXECUTED.format(name="dispatcher", cell=0.5, robots=4) + DISPATCHER, "contact"),
    "controller": (EXECUTED.format(name="controller", cell=1, robots=2) + CONTROLLER, "contact"),
}
BUDGET = "250runs"
CONTACTS = ("execution.robot_contacts", "execution.wall_contacts", "people.contacts_per_robot_h")


def main(searches: int, seeds: int) -> None:
    """Print one row for each fault."""
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        shutil.copy(HERE / "faulty.py", folder)
        Path("hall.map").write_text(f"type octile\nheight 9\nwidth 12\nmap\n{HALL}")
        for name, (study, kind) in STUDIES.items():
            Path(f"{name}.yaml").write_text(study)
            found = [hunt(name, kind, seed) for seed in range(searches)]
            after = [each["found_after"] if each else 250 for each in found]
            robots = statistics.median(each["robots"] for each in found if each)
            again = [f"{each['again']}/{each['repeats']}" for each in found if each]
            needed = f"1 of {RANDOM}" if name == "planner" else random_seeds(name, seeds)
            print(f"{name}: found after {after} cases, median {statistics.median(after):g}", flush=True)
            print(f"  shrunk to {robots:g} robots (median), again {again}, random seeds {needed}", flush=True)


def hunt(name: str, kind: str, seed: int) -> dict[str, int] | None:
    """Return the failure of one search, None if it finds none."""
    words = ("--for", kind, "--most", "1", "--budget", BUDGET, "--seed", seed, "--out", f"{name}-{seed}", "--json")
    answer = json.loads(mrpbench("hunt", f"{name}.yaml", *words))
    return next(iter(answer["failures"]), None)


def random_seeds(name: str, count: int) -> str:
    """Say how many of so many random seeds show the fault."""
    if not count:
        return "not run"
    mrpbench("run", f"{name}.yaml", f"seed=0..{count - 1}", "--out", f"{name}-random")
    lines = [line for file in Path(f"{name}-random", "runs").iterdir() for line in file.read_text().splitlines()]
    metrics = [json.loads(line)["metrics"] for line in lines]
    return f"{sum(any(each.get(column) for column in CONTACTS) for each in metrics)} of {count}"


def mrpbench(*words: object) -> str:
    """Run a command and return its output."""
    command = [sys.executable, "-m", "mrpbench_core.cli.main", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0)
