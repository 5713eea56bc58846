"""Drive robots on every built-in world, and fail if a robot touches another one or anything else.

    python benchmarks/worlds.py [WORLD…] [--seeds 5] [--robots 5] [--planner …] [--controller …] [--simulator planar]

Prints one line per world; exit code 1 if there was a contact, or a run that did not end with all robots at their goals.
"""

import argparse
import tempfile
from pathlib import Path
from typing import Any

import mrpbench_core
from mrpbench_core.model.runs.status import RunStatus

WORLDS: dict[str, dict[str, Any]] = {
    "office": {},
    "warehouse": {},
    "airport": {"limits": {"execution": "40 min"}},
    "household": {},
    "station": {},
    "office_noon": {},
    "hospital_corridor": {"roadmap": "graph"},
    "warehouse_pickers": {},
    "household_graph": {"world": "household", "roadmap": "graph"},
    **{
        f"bottlenecks_{case}": {
            "world": {"plugin": "bottlenecks", "case": case},
            "scenario": {"plugin": "random", "robots": robots},
        }
        for case, robots in (("corridor", 5), ("swap", 3), ("roundabout", 4), ("alcove", 2), ("door", 5))
    },
    **{
        f"generated_{kind}": {"world": f"generated_{kind}", "roadmap": "grid"}
        for kind in ("warehouse", "rooms", "random")
    },
}


def study(name: str, options: argparse.Namespace) -> dict[str, Any]:
    """The configuration of all runs on one world."""
    return {
        "name": name,
        "world": name,
        "scenario": {"plugin": "random", "robots": options.robots},
        "planner": options.planner,
        "dispatcher": "adg",
        "controller": options.controller,
        "simulator": options.simulator,
        "limits": {"execution": "15 min"},
        "recording": {"keep": "none"},
        "matrix": {"seed": f"0..{options.seeds - 1}"},
        **WORLDS[name],
    }


def touches(record: dict[str, Any], kind: str) -> int:
    """Number of contacts of robots with one another and with solid things; 0 if they did not drive, a failure too."""
    counted = record["metrics"].get(f"execution.{kind}_contacts")
    if counted is None and record["status"] == RunStatus.SUCCEEDED:
        raise SystemExit(f"the simulator reports no contacts: {record['run_id']}")
    return int(counted or 0)


def drive(name: str, options: argparse.Namespace) -> bool:
    """Run, print a line, and tell whether nothing went wrong."""
    with tempfile.TemporaryDirectory() as out:
        records = list(mrpbench_core.run(study(name, options), out=Path(out)))
    robots, walls = (sum(touches(record, kind) for record in records) for kind in ("robot", "wall"))
    others = [
        f"seed {record['seed']}: {record['status']}" for record in records if record["status"] != RunStatus.SUCCEEDED
    ]
    arrived = f"{len(records) - len(others)}/{len(records)} arrived"
    contacts = f"{robots} contacts with robots, {walls} with walls"
    print(f"{name:22}", "; ".join([arrived, contacts, *others]), flush=True)
    return not (robots or walls or others)


def main() -> int:
    """Drive on each world."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("worlds", nargs="*", metavar="WORLD", help=f"default: all of {', '.join(WORLDS)}")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--robots", type=int, default=5)
    parser.add_argument("--planner", default="prioritized")
    parser.add_argument("--controller", default="pure_pursuit")
    parser.add_argument("--simulator", default="planar")
    options = parser.parse_args()
    if unknown := [name for name in options.worlds if name not in WORLDS]:
        parser.error(f"no world {', '.join(unknown)}")
    good = [drive(name, options) for name in options.worlds or WORLDS]
    return int(not all(good))


if __name__ == "__main__":
    raise SystemExit(main())
