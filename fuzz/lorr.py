"""Problems and outputs of the League of Robot Runners."""

import json
from pathlib import Path

from mrpbench_league.files.output import read_output
from mrpbench_league.files.problem import read_problem
from mrpbench_league.scoring.rescore import rescore

FILES = {
    "m.map": "type octile\nheight 2\nwidth 3\nmap\n.@.\n...\n",
    "a.agents": "2\n0\n5\n",
    "goals.tasks": "3\n3\n2\n5\n",
    "t.tasks": "3\n3,4\n2\n5,0\n",
}
HEAD = {"mapFile": "m.map", "agentFile": "a.agents", "taskFile": "t.tasks", "teamSize": 2, "numTasksReveal": 1.5}
DELAYS = {"minDelay": 2, "maxDelay": 9, "eventModel": "poisson", "pDelay": 0.1, "durationModel": "uniform"}
PROBLEMS = {
    2023: HEAD | {"numTasksReveal": 1, "taskFile": "goals.tasks", "taskAssignmentStrategy": "roundrobin"},
    2024: HEAD | {"version": "2024 LoRR"},
    2026: HEAD | {"version": "2026 LoRR", "agentCounter": 3, "delayConfig": DELAYS},
}
"""By season."""


def problem_beside(file: Path, season: int) -> Path:
    """Write the problem of a season beside a file, which stays as it is."""
    texts = {**FILES, f"{season}.json": json.dumps(PROBLEMS[season])}
    for name, text in texts.items():
        if not (other := file.with_name(name)).exists():
            other.write_text(text)
    return file.with_name(f"{season}.json")


def read_problems(file: Path) -> None:
    """Read a problem."""
    problem_beside(file, 2024)
    read_problem(file)


def read_cells(file: Path) -> None:
    """Read a problem with these tasks."""
    read_problem(problem_beside(file, 2024))


def read_outputs(file: Path) -> None:
    """Score an output from its motion."""
    output = read_output(file)
    rescore(read_problem(problem_beside(file, output.season)), output)


def problems() -> list[bytes]:
    """A problem of each season."""
    return [json.dumps(problem, indent=1).encode() for problem in PROBLEMS.values()]


def outputs() -> list[bytes]:
    """Short outputs of 2023, 2024 and 2026."""
    common = {"actionModel": "MAPF_T", "teamSize": 2, "start": [[0, 0, "E"], [1, 2, "E"]], "errors": []}
    common |= {"numTaskFinished": 1, "plannerTimes": [0.1, 0.1], "plannerPaths": ["R,F", "W,W"]}
    first = common | {"actualPaths": ["R,F", "W,W"], "makespan": 2, "events": [[[0, 0, "assigned"]], []]}
    first |= {"tasks": [[0, 1, 0], [1, 1, 1]]}
    later = common | {"version": "2024 LoRR", "actualPaths": ["R,F", "W,W"], "makespan": 2}
    later |= {"events": [[2, 0, 0, 1]], "tasks": [[0, 0, [1, 0, 1, 1]]], "actualSchedule": ["0:0", "0:-1"]}
    last = later | {"version": "2026 LoRR", "agentMaxCounter": 3, "delayIntervals": [[[1, 3]], []], "makespan": 6}
    last["actualPaths"] = ["[(0,0,0,0,0):(R 3,F 3)]", "[(0,1,2,0,0):(W 6)]"]
    return [json.dumps(data, indent=1).encode() for data in (first, later, last)]
