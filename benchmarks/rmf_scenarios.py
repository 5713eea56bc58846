"""Run a scenario of next-generation Open-RMF: our robots, and our plan server and executor, over DDS.

    python benchmarks/rmf_scenarios.py swap --seconds 3000
    python benchmarks/rmf_scenarios.py swap --seconds 120 dispatcher.dispatcher=all_at_once
    python benchmarks/rmf_scenarios.py redirect
    python benchmarks/rmf_scenarios.py follow

`redirect` and `follow` are those that next_gen_prototype publishes, `swap` is the patrol of two robots in a corridor
with one lane (rmf_ros2, issue 503). The runs are `studies/rmf/NAME.yaml` and `NAME_traffic.yaml`; `key=value` changes
the latter. This program posts the destinations; in `swap` the robots get new ones as long as the run lasts. Contacts
and distances are those of the recording of the robots.
"""

import argparse
import math
import os
import subprocess
import sys
import tempfile
import time
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
from mrpbench_live.rmf.messages import messages_of
from mrpbench_live.rmf.wire import Wire
from rmf_traffic import LOOPBACK, PACKAGE

from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.results import Results

FOLDER = Path(__file__).parents[1] / "studies" / "rmf"
NAMES = "robot_0", "robot_1"
GOALS = {
    "swap": [[(8.5, 0.5), (0.5, 0.5)], [(0.5, 0.5), (8.5, 0.5)]],
    "redirect": [[(6.5, 5.5), (4.5, 5.5)], [(6.5, 10.5), (4.5, 5.5)]],
    "follow": [[(13.5, 5.5), (14.5, 5.5)]],
}
"""Destinations of both robots, one pair after another."""
REDIRECTED_AT = 3.5
"""Metres: x of the first robot at which it is sent elsewhere."""
THERE = 0.25
"""Metres."""


class Tasks:
    """Posts destinations, and looks where the robots are."""

    def __init__(self, domain: int) -> None:
        self._new = messages_of("").new
        self._wire = Wire(messages_of(""), domain)
        self.places: dict[str, tuple[float, float]] = {}
        for name in NAMES:
            self._wire.advertise(f"{name}/destination")
            self._wire.subscribe(f"{name}/odom", lambda odometry, name=name: self._locate(name, odometry))

    def _locate(self, name: str, odometry: Any) -> None:
        self.places[name] = odometry.pose.pose.position.x, odometry.pose.pose.position.y

    def post(self, name: str, session: int, goal: tuple[float, float]) -> None:
        """Send a robot to a place; with the session of the last time, nothing changes."""
        region = self._new(PACKAGE + "Region", points=list(goal), hint=1)
        target = self._new(PACKAGE + "TargetRegion", region=region, tolerance=THERE)
        constraints = self._new(PACKAGE + "DestinationConstraints", regions=[target])
        uuid = self._new("unique_identifier_msgs/UUID", uuid=list(session.to_bytes(16)))
        message = self._new(PACKAGE + "Destination", constraints=constraints, session=uuid)
        self._wire.publish(f"{name}/destination", message)

    def drive(self, scenario: str, robots: "subprocess.Popen[bytes]") -> int:
        """Send the robots from destination to destination until their run ends; return how many pairs they reached."""
        pairs, done = GOALS[scenario], 0
        sessions, before = [0, 2**32], [(math.nan, 0.0)] * 2
        while robots.poll() is None:
            goals = pairs[done % len(pairs)] if scenario == "swap" else pairs[min(done, len(pairs) - 1)]
            for robot, name in enumerate(NAMES):
                if goals[robot] != before[robot]:
                    sessions[robot], before[robot] = sessions[robot] + 1, goals[robot]
                self.post(name, sessions[robot], goals[robot])  # again, for participants that come later
            self._wire.serve(time.monotonic() + 0.1)
            if len(self.places) < len(NAMES) or (scenario != "swap" and done == len(pairs)):
                continue
            there = [math.dist(self.places[name], goal) <= THERE for name, goal in zip(NAMES, goals, strict=True)]
            redirected = scenario == "redirect" and done == 0 and self.places[NAMES[0]][0] > REDIRECTED_AT
            done += all(there) or redirected
        return done


def main() -> int:
    """Run a scenario, and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenario", choices=sorted(GOALS))
    parser.add_argument("overrides", nargs="*", metavar="key=value", help="of the run that plans")
    parser.add_argument("--seconds", type=float, default=60.0, help="simulated")
    options = parser.parse_intermixed_args()
    os.environ["CYCLONEDDS_URI"] = LOOPBACK
    scenario, domain = options.scenario, 1 + os.getpid() % 200
    words = {
        scenario: [f"dispatcher.interface.domain={domain}"],
        f"{scenario}_traffic": [f"simulator.domain={domain}", *options.overrides],
    }
    with tempfile.TemporaryDirectory() as folder:
        running = []
        for name, overrides in words.items():
            program = str(Path(sys.executable).with_name("mrpbench"))
            command = [
                program,
                "run",
                str(FOLDER / f"{name}.yaml"),
                f"limits.execution={options.seconds} s",
                *overrides,
            ]
            with (Path(folder) / f"{name}.log").open("wb") as log:
                out = ["--out", str(Path(folder) / name)]
                running.append(subprocess.Popen([*command, *out], stdout=log, stderr=log))
        done = Tasks(domain).drive(scenario, running[0])
        for process in running:
            process.wait()
        results = {name: Results(ResultsFolder(Path(folder) / name)) for name in words}
        if not all(list(swaps) for swaps in results.values()):
            print("".join((Path(folder) / f"{name}.log").read_text() for name in words))
            return 1
        (robots,), (traffic,) = results.values()
        with closing(results[scenario].recording(robots["run_id"])) as recording:
            place = recording.channels["truth"]()[..., :2]
    metrics, least = robots["metrics"], np.hypot(*(place[:, 0] - place[:, 1]).T).min()
    print(f"{scenario}: the robots reached {done} pairs of destinations in {options.seconds:g} s")
    print(f"robots: {robots['status']}; plan server and executor: {traffic['status']} {traffic.get('error') or ''}")
    print(f"contacts {metrics['execution.robot_contacts']}, least distance of the centres {least:.2f} m")
    print(f"longest standstill of both {metrics['deadlock.longest_s']:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
