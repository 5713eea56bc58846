"""Compare the tasks that a fleet does over VDA 5050 with those that it does in one process.

    python benchmarks/vda5050_control.py --robots 6 12 --seeds 0 1 2 --pace 4 --seconds 600

The study is the same: robots of 0.6 by 0.4 m in an open hall of 12 by 10 cells of 1 m get transports from one place to
another, more than they can serve; `rolling_horizon` with `pibt` plans, and `adg` releases. Once the robots are
simulated in the process that plans, once they are vehicles of VDA 5050 (`mrpbench serve`) that `mrpbench control`
drives over a broker on this machine, both at `--pace`. Six robots have room, and twelve meet all the time.

Prints tasks an hour of both, the share that is left over the wire, and the wall seconds that the two ends were behind
the clock at most; and the share of all seeds. Which robot comes first somewhere changes all that follows, so single
seeds differ by a tenth and more either way. `--once` executes one plan instead, which is the same on both sides, and
compares how long that takes. Both ends and the broker need processors of their own: on a busy machine the share is
that of what it left them. Options after `--` go to `serve`, such as `-- dispatcher.interval=0.1`.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from vda5050_vehicles import start_broker

from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.results import Results

STUDY: dict[str, Any] = {
    "name": "hall",
    "world": {"plugin": "movingai", "file": "hall.map"},
    "roadmap": "grid",
    "fleet": "cart.yaml",
    "simulator": "planar",
    "planner": {"plugin": "rolling_horizon", "planner": "pibt"},
    "dispatcher": "adg",
    "tasks": {"plugin": "closed_pool", "errands": 2, "service": "2 s"},
    "control_rate": "10 Hz",
    "metrics": ["tasks", "execution"],
}
ONCE: dict[str, Any] = {"tasks": None, "planner": "lacam", "metrics": ["execution"]}
CART = """
name: cart
footprint: [[0.3, 0.2], [-0.3, 0.2], [-0.3, -0.2], [0.3, -0.2]]
max_speed: 1.0
max_turn_rate: 2.0
acceleration: 1.0
turn_acceleration: 4.0
"""
COMMAND = (sys.executable, "-c", "import sys; from mrpbench_core.cli.main import main; sys.exit(main(sys.argv[1:]))")
GRACE_S = 20.0
"""Wall seconds for which vehicles are there longer than their fleet control needs them."""


def record_of(folder: Path) -> dict[str, Any]:
    """The record of the only run in a folder of results."""
    (record,) = Results(ResultsFolder(folder))
    if record["status"] != "succeeded":
        print(f"       {folder.name}: {record['status']}: {record['error']}", flush=True)
    found: dict[str, Any] = record["metrics"]
    return found


def behind(said: str) -> float:
    """The most wall seconds that a process said it was behind its clock."""
    return max(map(float, re.findall(r"([\d.]+) s behind (?:the clock|it)", said)), default=0.0)


def measure(robots: int, seed: int, options: argparse.Namespace, folder: Path) -> tuple[float, float]:
    """Do the study in process and over the wire, and print a row; return how much is done in an hour by both."""
    (folder / "hall.map").write_text("type octile\nheight 10\nwidth 12\nmap\n" + "............\n" * 10)
    (folder / "cart.yaml").write_text(CART)
    study = STUDY | {"scenario": {"plugin": "random", "robots": robots}} | (ONCE if options.once else {})
    (folder / "study.yaml").write_text(json.dumps({key: value for key, value in study.items() if value is not None}))

    def start(*words: str) -> "subprocess.Popen[str]":
        return subprocess.Popen(
            [*COMMAND, *words], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )

    chosen = f"seed={seed}"
    limit = f"limits.execution={options.seconds} s"
    start("run", "study.yaml", chosen, limit, "--out", "process").wait()
    alone = record_of(folder / "process")
    url, broker = start_broker(folder)
    wire = ("--vda5050", url, "--pace", str(options.pace))
    grace = f"{options.seconds + options.pace * GRACE_S} s"
    often = "dispatcher.interface.visualization_interval=0.1"
    serve = start("serve", "study.yaml", chosen, often, *options.serve, *wire, "--duration", grace, "--out", "served")
    control = start("control", "study.yaml", chosen, *wire, "--duration", f"{options.seconds} s", "--out", "control")
    control_said = control.communicate()[1]
    if options.once:  # which ends when all have arrived
        serve.terminate()
    serve_said = serve.communicate()[1]
    broker.kill()
    over = record_of(folder / "control")
    contacts = over["execution.robot_contacts"]
    if not options.once:
        contacts = max(contacts, record_of(folder / "served")["execution.robot_contacts"])
    done = [3600 / it["execution.duration_s"] if options.once else it["tasks.per_hour"] for it in (alone, over)]
    print(
        f"{robots:6} {seed:5} {done[0]:12.0f} {done[1]:8.0f} {done[1] / done[0]:6.3f} {contacts:8} "
        f"{behind(control_said):8.2f} {behind(serve_said):8.2f} {os.getloadavg()[0]:5.1f}",
        flush=True,
    )
    return done[0], done[1]


def main() -> None:
    """Measure, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=int, nargs="+", default=[6, 12])
    parser.add_argument("--pace", type=float, default=4.0)
    parser.add_argument("--seconds", type=float, default=600.0, help="simulated")
    parser.add_argument("--seeds", type=int, nargs="+", default=[0, 1, 2])
    parser.add_argument("--once", action="store_true", help="execute one plan; figures are plans an hour")
    parser.add_argument("serve", nargs="*", help="overrides for the vehicles")
    options = parser.parse_args()
    print("robots  seed in process/h   wire/h  share contacts behind s: control, vehicles  load", flush=True)
    for robots in options.robots:
        done = []
        for seed in options.seeds:
            with tempfile.TemporaryDirectory() as folder:
                done.append(measure(robots, seed, options, Path(folder)))
        alone, over = (sum(it) for it in zip(*done, strict=True))
        print(f"{robots:6} {'all':>5} {alone:12.0f} {over:8.0f} {over / alone:6.3f}", flush=True)


if __name__ == "__main__":
    main()
