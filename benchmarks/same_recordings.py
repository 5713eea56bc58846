"""Compare the recordings of two versions, configuration by configuration, byte by byte.

A change that only makes executions faster changes no channel of a recording. `write FOLDER` executes the
configurations below with the version of the Python that runs this script, which may be that of another checkout;
`compare ONE OTHER` tells which channels differ in two such folders, and ends with 1 if any does.
"""

import argparse
import sys
import zipfile
from pathlib import Path
from typing import Any

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.store.paths import RunPaths

FIRST: dict[str, Any] = {
    "name": "same",
    "world": "office",
    "scenario": {"plugin": "random", "robots": 5},
    "assigner": "identity",
    "planner": "prioritized",
    "metrics": [],
    "limits": {"execution": 25.0},
}
WAREHOUSE = {"plugin": "generated_warehouse", "shelf_rows": 8, "shelf_columns": 4, "shelf_length": 5, "resolution": 0.4}
CROWDED = {"world": WAREHOUSE, "roadmap": "grid", "scenario": {"plugin": "random", "robots": 30}}
STOP = {"plugin": "waypoints", "waypoints": "stop"}
TASKS = {"plugin": "poisson", "rate": 0.2}
FAULTS = [
    {"kind": "stop", "robot": 0, "at": 4.0, "lasts": 6.0},
    {"kind": "silent", "robot": 1, "at": 5.0, "lasts": 4.0},
]
CASES: dict[str, dict[str, Any]] = {
    "pure_pursuit": {},
    "planar": {"simulator": "planar"},
    "dwb": {"simulator": "planar", "controller": "dwb"},
    "mppi": {"simulator": "planar", "controller": "mppi", "scenario": {"plugin": "random", "robots": 2}},
    "rpp": {"simulator": "planar", "controller": "rpp"},
    "graceful": {"simulator": "planar", "controller": "graceful"},
    "rotation_shim": {
        "simulator": "planar",
        "controller": {"plugin": "rotation_shim", "primary_controller": "dwb"},
    },
    "global_planner": {
        "simulator": "planar",
        "controller": {"plugin": "global_planner", "primary_controller": "dwb"},
    },
    "crowded": CROWDED,
    "crowded_dwb": CROWDED | {"simulator": "planar", "controller": "dwb", "limits": {"execution": 10.0}},
    "crowded_cbs": CROWDED | {"planner": "ecbs"},
    "rotations": CROWDED | {"planner": {"plugin": "pibt"}},
    "stop": {"navigator": STOP},
    "stop_crowded": CROWDED | {"navigator": STOP},
    "turn_ahead": CROWDED | {"navigator": {"plugin": "waypoints", "turn_ahead": True}},
    "release": {
        "navigator": {"plugin": "waypoints", "path_end": "release"},
        "simulator": "planar",
        "controller": "dwb",
    },
    "release_crowded": CROWDED | {"navigator": {"plugin": "waypoints", "path_end": "release"}},
    "planner_tolerance": CROWDED
    | {
        "navigator": {"plugin": "waypoints", "planner_tolerance": 0.5},
        "simulator": "planar",
        "controller": "dwb",
        "limits": {"execution": 10.0},
    },
    "stopped_checker": {"navigator": {"plugin": "waypoints", "goal_checker": "StoppedGoalChecker"}},
    "impatient": CROWDED
    | {"navigator": {"plugin": "waypoints", "movement_time_allowance": 1.5}, "simulator": "planar"},
    "impatient_dwb": {
        "navigator": {"plugin": "waypoints", "movement_time_allowance": 1.0, "failure_tolerance": 0.0},
        "simulator": "planar",
        "controller": "dwb",
        "scenario": {"plugin": "random", "robots": 10},
    },
    "pose_checker": CROWDED
    | {
        "navigator": {
            "plugin": "waypoints",
            "progress_checker": "PoseProgressChecker",
            "movement_time_allowance": 2.0,
        }
    },
    "all_at_once": {"dispatcher": "all_at_once"},
    "timed": {"dispatcher": "timed"},
    "gses": CROWDED | {"dispatcher": "gses"},
    "btpg": CROWDED | {"dispatcher": "btpg"},
    "speed_profiles": CROWDED | {"dispatcher": {"plugin": "adg", "speed_profiles": True}},
    "noise": {
        "simulator": "planar",
        "controller": "dwb",
        "noise": {"lidar": 0.01, "odometry": 0.005, "actuation": 0.05, "start_jitter": 2.0},
        "localizer": "odometry",
    },
    "amcl": {"simulator": "planar", "noise": {"lidar": 0.01, "odometry": 0.005}, "localizer": "amcl"},
    "delays": CROWDED | {"delays": {"p_delay": 0.05, "max_delay": 5}, "replanning": {"delay": 3.0}},
    "replanning": CROWDED | {"replanning": {"period": 2.0, "latency": 0.2}},
    "windows": CROWDED | {"replanning": {"period": 2.0, "window": 5.0}},
    "faults": CROWDED | {"faults": {"events": FAULTS, "reaction": "replan"}},
    "tasks": {"tasks": TASKS, "assigner": "greedy"},
    "doors": {"world": "hospital", "roadmap": "graph"},
    "people": {
        "simulator": "planar",
        "controller": "dwb",
        "crowds": {"plugin": "social_force", "people": 10},
    },
    "trajectories": CROWDED
    | {
        "simulator": "planar",
        "controller": "dwb",
        "recording": {"trajectories": {"robots": [0, 2, 5, 9], "every": 2}},
        "limits": {"execution": 10.0},
    },
    "schedule_only": {"execution": "schedule_only"},
}
"""What differs from `FIRST`, by name."""


def write(folder: Path, names: list[str]) -> None:
    """Execute configurations; their recordings go to the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in names:
        settings = FIRST | CASES[name]
        if settings.get("execution") == "schedule_only":
            settings = settings | {"limits": {"execution": 200.0}}
        (point,) = load_study(settings).runs
        record = execute(point.config, name, RunPaths(recording=folder / f"{name}.zip", exports=folder / "exports"))
        print(f"{name}: {record.status} {record.error or ''}".rstrip(), flush=True)


def differences(one: Path, other: Path) -> list[str]:
    """Return the channels that differ in two recordings, or are missing in one."""
    with zipfile.ZipFile(one) as first, zipfile.ZipFile(other) as second:
        members = sorted({*first.namelist(), *second.namelist()})
        contents = [{name: file.read(name) for name in members if name in file.namelist()} for file in (first, second)]
    return [name for name in members if contents[0].get(name) != contents[1].get(name)]


def main() -> None:
    """Write recordings, or compare two folders of them."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("action", choices=["write", "compare"])
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--only", nargs="*", default=list(CASES), help="names of configurations")
    options = parser.parse_args()
    if options.action == "write":
        write(options.folders[0], options.only)
        return
    one, other = options.folders
    found = {name: differences(one / f"{name}.zip", other / f"{name}.zip") for name in options.only}
    for name, channels in found.items():
        print(f"{name}: {', '.join(channels) or 'the same'}")
    sys.exit(any(found.values()))


if __name__ == "__main__":
    main()
