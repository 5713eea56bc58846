"""Measure fleets of next-generation Open-RMF over DDS: robots with bodies, and a plan server and executor, at pace 1.

    python benchmarks/rmf_traffic.py --robots 10 50 100 200 500 --planners pibt lacam prioritized --seconds 180

Each row is two runs in two processes that only share a DDS domain on this machine: a fleet on the `planar` simulator
(`interface: rmf`), and `planner: rmf` with `dispatcher: rmf`, which plan for it and release. The building is the
default `generated_warehouse` with cells of 1 m; robots are 0.7 by 0.5 m and drive 1.5 m/s. Each robot always has a
destination: when it has come to one, it gets another one that is drawn from the free cells.

Prints for each row the calls of the planner and the 95th percentile of their wall time; the robots to which a plan was
posted, since it changed for them, on average; messages a second over the wire
(sent by both); the processors that each process uses; tasks an hour in the last two thirds of the run; the longest
standstill of the whole fleet, and the robots that stood for a minute on the way to a destination; contacts and the
least distance between robots, both of the simulator; the 99th percentile of the lag of both processes behind the clock;
and how many processes of the machine want to run.
`--profile` prints the functions of each process that take the most time.
"""

import argparse
import cProfile
import json
import math
import multiprocessing
import os
import pstats
import queue
import sys
import tempfile
import time
from multiprocessing.queues import Queue
from pathlib import Path
from typing import Any

import numpy as np
from mrpbench_live.fleet.pace import Pace
from mrpbench_live.rmf.messages import messages_of
from mrpbench_live.rmf.wire import Wire

from mrpbench_core.api.hooks import hookimpl
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.runs.status import Stage
from mrpbench_core.plugins.hooks import Hooks
from mrpbench_core.store.paths import RunPaths

LOOPBACK = (
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name='lo'/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General><Discovery><Peers><Peer address='127.0.0.1'/></Peers>"
    "<ParticipantIndex>auto</ParticipantIndex></Discovery></Domain></CycloneDDS>"
)
PLANNERS: dict[str, Any] = {
    "pibt": {"plugin": "rolling_horizon", "planner": "pibt"},
    "lacam": {"plugin": "rolling_horizon", "planner": "lacam"},
    "prioritized": "prioritized",
    "pbs": "pbs",
    "eecbs": "eecbs",
}
ROBOT = """
name: amr
footprint: [[0.35, 0.25], [-0.35, 0.25], [-0.35, -0.25], [0.35, -0.25]]
max_speed: 1.5
max_turn_rate: 2.0
acceleration: 1.0
turn_acceleration: 4.0
"""
THERE = 0.15
"""Metres from a destination at which a robot has come to it."""
STUCK_S, STUCK_M = 60.0, 0.1
PACKAGE = "rmf_prototype_msgs/"


def config(options: argparse.Namespace, robots: int, part: str, planner: str, domain: int) -> dict[str, Any]:
    """One of the two runs."""
    run: dict[str, Any] = {
        "name": part,
        "world": {"plugin": "generated_warehouse", "resolution": 1.0},
        "roadmap": "grid",
        "scenario": {"plugin": "random", "robots": robots},
        "fleet": "amr.yaml",
        "tasks": "live",
        "control_rate": options.control_rate,
        "limits": {"execution": options.seconds, "planning": "10 s", "iterations": 100},
        "recording": {"rate": options.control_rate},
    }
    if part == "robots":
        interface = {"plugin": "rmf", "domain": domain, "obeys": "release", "rate": options.rate}
        dispatcher = {"plugin": "live", "pace": options.pace, "interface": interface}
        return run | {
            "simulator": "planar",
            "planner": "live",
            "dispatcher": dispatcher,
            "metrics": ["execution", "deadlock"],
        }
    return run | {
        "simulator": {"plugin": "rmf", "domain": domain, "pace": options.pace, "patience": 120.0},
        "navigator": "rmf",
        "localizer": "ground_truth",
        "planner": {"plugin": "rmf", "planner": PLANNERS[planner]},
        "dispatcher": {"plugin": "rmf", "dispatcher": "adg"},
        "metrics": [],
    }


class Clocks:
    """Notes the lag behind the clock, the use of processors and the calls of the planner of one process."""

    def __init__(self) -> None:
        lags = self.lags = list[float]()
        wires = self._wires = list[Wire]()
        posted = self._posted = list[str]()
        self.calls: list[float] = []
        self._asked_at = 0.0
        self._began: tuple[float, float, int] | None = None

        change, connect, publish = Pace.change, Wire.__init__, Wire.publish

        def watched_change(pace: Pace, now: float) -> str | None:
            lags.append(max(0.0, time.monotonic() - pace.due(now)))
            return change(pace, now)

        def watched_connect(wire: Wire, *arguments: Any) -> None:
            connect(wire, *arguments)
            wires.append(wire)

        def watched_publish(wire: Wire, topic: str, message: Any) -> None:
            publish(wire, topic, message)
            if topic.endswith("/plan"):
                posted.append(topic)

        Pace.change, Wire.__init__ = watched_change, watched_connect  # type: ignore[method-assign]
        Wire.publish = watched_publish  # type: ignore[method-assign]

    def announce(self, stage: Stage, facts: Any) -> None:
        """Time a call of the planner."""
        del facts
        if stage == Stage.REPLANNING:
            self._asked_at = time.perf_counter()
        elif self._asked_at:
            self.calls.append(time.perf_counter() - self._asked_at)
            self._asked_at = 0.0

    @hookimpl
    def mrpbench_stepped(self) -> None:
        """Begin to measure after the first control period."""
        if self._began is None:
            self._began = time.monotonic(), time.process_time(), self._sent

    @property
    def _sent(self) -> int:
        return sum(wire.sent for wire in self._wires)

    def measured(self) -> dict[str, Any]:
        """What was measured so far."""
        assert self._began is not None
        wall, cpu, sent = self._began
        seconds = time.monotonic() - wall
        return {
            "cpu": (time.process_time() - cpu) / seconds,
            "sent": (self._sent - sent) / seconds,
            "lag": float(np.percentile(self.lags, 99)),
            "lag_max": max(self.lags),
            "calls": len(self.calls),
            "posted": len(self._posted) / max(1, len(self.calls)),
            "plan": float(np.percentile(self.calls, 95)) if self.calls else math.nan,
        }


class Destinations:
    """Posts a destination for each robot, and another one when it has come there."""

    def __init__(self, seed: int, domain: int, seconds: float) -> None:
        self._random, self._domain, self._warm_up = np.random.default_rng(seed), domain, seconds / 3
        self._seconds = seconds
        self._sessions = 0
        self._wire: Wire | None = None
        self.done = 0
        """Destinations that robots came to after the warm-up."""
        self.stuck: set[int] = set()

    @hookimpl
    def mrpbench_executing(self, context: RunContext) -> None:
        """Read where robots can go."""
        self._names, self._places = context.fleet.names, context.problem.roadmap.position
        self._goal = np.full(len(self._names), -1)
        self._messages = messages_of("")
        self._wire = Wire(self._messages, self._domain)
        for name in self._names:
            self._wire.advertise(f"{name}/destination")
        self._stood_at = np.full((len(self._names), 2), np.inf)
        self._since = np.zeros(len(self._names))

    @hookimpl
    def mrpbench_stepped(self, now: float, state: Any) -> None:
        """Look who has come to its destination."""
        place = state.pose[:, :2]
        goal = self._places[np.maximum(self._goal, 0)]
        there = (self._goal >= 0) & (np.hypot(*(place - goal).T) <= THERE)
        self.done += int(there.sum()) if now > self._warm_up else 0
        moved = (np.hypot(*(place - self._stood_at).T) > STUCK_M) | there
        self._stood_at[moved], self._since[moved] = place[moved], now
        self.stuck |= set(np.flatnonzero(now - self._since >= STUCK_S).tolist())
        if now > 3.0:  # both processes have begun
            for robot in np.flatnonzero(there | (self._goal < 0)).tolist():
                self._post(robot)

    def _post(self, robot: int) -> None:
        assert self._wire is not None
        taken = set(self._goal.tolist())
        while (vertex := int(self._random.integers(len(self._places)))) in taken:
            pass
        self._goal[robot], self._sessions = vertex, self._sessions + 1
        new = self._messages.new
        region = new(PACKAGE + "Region", points=self._places[vertex].tolist(), hint=1)
        target = new(PACKAGE + "TargetRegion", region=region, tolerance=0.3)
        constraints = new(PACKAGE + "DestinationConstraints", regions=[target])
        session = new("unique_identifier_msgs/UUID", uuid=list(self._sessions.to_bytes(16)))
        message = new(PACKAGE + "Destination", constraints=constraints, session=session)
        self._wire.publish(f"{self._names[robot]}/destination", message)

    def measured(self) -> dict[str, Any]:
        """What was counted."""
        return {"tasks": 3600 * self.done / (self._seconds - self._warm_up), "stuck": len(self.stuck)}


def run_part(
    options: argparse.Namespace, robots: int, part: str, planner: str, domain: int, results: "Queue[Any]"
) -> None:
    """Do one of the two runs in this process."""
    clocks, hooks, profile = Clocks(), Hooks(), cProfile.Profile(time.process_time)
    hooks.register(clocks, "clocks")
    destinations = Destinations(options.seed, domain, options.seconds)
    if part == "robots":
        hooks.register(destinations, "destinations")
    with tempfile.TemporaryDirectory() as name:
        os.chdir(name)
        Path("amr.yaml").write_text(ROBOT)
        (point,) = load_study(config(options, robots, part, planner, domain)).runs
        paths = RunPaths(recording=Path(name) / "run.zip", exports=Path(name) / "exports")
        if options.profile:
            profile.enable()
        record = execute(point.config, part, paths, announce=clocks.announce, hooks=hooks)
        profile.disable()
    measured = clocks.measured() | {
        "status": str(record.status),
        "error": record.error and str(record.error),
        "metrics": dict(record.metrics),
    }
    measured |= destinations.measured() if part == "robots" else {}
    if options.profile:
        print(part)
        pstats.Stats(profile).sort_stats("tottime").print_stats(options.profile)
    results.put((part, json.loads(json.dumps(measured, default=float))))


def measure(options: argparse.Namespace, robots: int, planner: str) -> dict[str, dict[str, Any]]:
    """Do both runs of one row."""
    spawn, domain = multiprocessing.get_context("spawn"), 1 + os.getpid() % 200
    results = spawn.Queue()
    processes = [
        spawn.Process(target=run_part, args=(options, robots, part, planner, domain, results))
        for part in ("robots", "traffic")
    ]
    for process in processes:
        process.start()
    measured: dict[str, dict[str, Any]] = {}
    while len(measured) < len(processes):
        try:
            measured |= [results.get(timeout=1.0)]
        except queue.Empty:
            if any(process.exitcode for process in processes):  # which has printed why
                for process in processes:
                    process.kill()
                sys.exit(1)
    for process in processes:
        process.join()
    return measured


def main() -> None:
    """Measure all rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=int, nargs="+", default=[10, 50, 100, 200, 500])
    parser.add_argument("--planners", nargs="+", choices=sorted(PLANNERS), default=["pibt", "lacam", "prioritized"])
    parser.add_argument("--seconds", type=float, default=180.0, help="simulated")
    parser.add_argument("--pace", type=float, default=1.0)
    parser.add_argument("--control-rate", type=float, default=10.0)
    parser.add_argument("--rate", type=float, default=10.0, help="odometry and progress of each robot, Hz")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--profile", type=int, default=0, metavar="N", help="print the N most expensive functions")
    options = parser.parse_args()
    os.environ["CYCLONEDDS_URI"] = LOOPBACK
    print(
        f"{'robots':>6} {'planner':12} {'plans':>6} {'p95 ms':>7} {'posted':>6} {'msg/s':>7} {'CPU robots':>10} "
        f"{'traffic':>7} {'tasks/h':>8} {'standstill':>10} {'stuck':>5} {'contacts':>8} {'least m':>7} "
        f"{'lag p99 ms':>10} {'traffic':>7} load"
    )
    for planner in options.planners:
        for robots in options.robots:
            measured = measure(options, robots, planner)
            fleet, traffic = measured["robots"], measured["traffic"]
            metrics = fleet["metrics"]
            clearance = metrics.get("execution.min_clearance_m") or math.nan
            print(
                f"{robots:6} {planner:12} {traffic['calls']:6} {1e3 * traffic['plan']:7.0f} "
                f"{traffic['posted']:6.0f} {fleet['sent'] + traffic['sent']:7.0f} {fleet['cpu']:10.2f} "
                f"{traffic['cpu']:7.2f} {fleet['tasks']:8.0f} {metrics.get('deadlock.longest_s') or 0:10.0f} "
                f"{fleet['stuck']:5} {metrics.get('execution.robot_contacts')!s:>8} {clearance:7.2f} "
                f"{1e3 * fleet['lag']:10.0f} {1e3 * traffic['lag']:7.0f} {os.getloadavg()[0]:.1f}",
                flush=True,
            )
            for name, part in measured.items():
                if part["error"] or part["status"] != "succeeded":
                    print(f"       {name}: {part['status']}: {part['error']}", flush=True)


if __name__ == "__main__":
    main()
