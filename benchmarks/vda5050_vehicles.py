"""Measure a large fleet of VDA 5050 vehicles with bodies, all of which drive, at pace 1.

    python benchmarks/vda5050_vehicles.py --vehicles 1000 --seconds 60
    python benchmarks/vda5050_vehicles.py --vehicles 100 --lidar

Three processes share this machine: the vehicles (`interface: vda5050` on the simulator `planar`), `mosquitto`, and a
fleet control that does nothing but send each vehicle to and fro on a lane of its own, and look at each state. With
`--lidar` the vehicles have a lidar and drive by `dwb`.

Prints the states a second, the median and the 99th percentile of their age when they are received (the clock when
they were made is that of this machine, too), the longest time between two states of a vehicle, gaps in header ids,
nodes passed, the 99th percentile of the lag of the run behind the clock and the largest one, and the processors that
the vehicles and the broker use; all after a start of some seconds. The figures of times are those of this machine,
which should have nothing else to do. `--profile` prints the functions that take the most time.
"""

import argparse
import cProfile
import json
import multiprocessing
import os
import pstats
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from datetime import datetime
from multiprocessing.queues import Queue
from pathlib import Path
from typing import Any

import numpy as np
import psutil
from mrpbench_live.fleet.pace import Pace
from mrpbench_live.vda5050.messages import Headers
from mrpbench_live.vda5050.names import VERSIONS
from mrpbench_live.vda5050.wire import Broker, Client, Wire

from mrpbench_core.api.hooks import hookimpl
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.plugins.hooks import Hooks
from mrpbench_core.store.paths import RunPaths

LANE, ACROSS = 12, 10
"""Cells of the lane of each vehicle, of 1 m, and lanes side by side."""
WARM_UP_S = 8.0
"""Seconds after the first order that do not count."""
ROBOT: dict[str, Any] = {
    "name": "amr",
    "footprint": [[0.35, 0.25], [-0.35, 0.25], [-0.35, -0.25], [0.35, -0.25]],
    "max_speed": 1.5,
    "max_turn_rate": 2.0,
    "acceleration": 1.0,
    "turn_acceleration": 4.0,
}
LIDAR = {"beams": 360, "range": 10.0, "min_range": 0.12, "rate": 5, "mount": [0.0, 0.0, 0.18]}


def lane_of(vehicle: int) -> tuple[float, float]:
    """The first place of the lane of a vehicle, x, y in metres; it is 9 m long."""
    return LANE * (vehicle % ACROSS) + 1.5, vehicle // ACROSS + 0.5


def write_site(folder: Path, vehicles: int, lidar: bool) -> None:
    """Write the world, the places of the vehicles, and their model."""
    rows = -(-vehicles // ACROSS)
    lines = ["." * (LANE * ACROSS)] * rows
    (folder / "hall.map").write_text(
        f"type octile\nheight {rows}\nwidth {LANE * ACROSS}\nmap\n" + "\n".join(lines) + "\n"
    )
    robots = [{"x": x, "y": y, "yaw": 0.0} for x, y in map(lane_of, range(vehicles))]
    (folder / "starts.yaml").write_text(json.dumps({"mrpbench_scenario": 1, "robots": robots, "tasks": []}))
    (folder / "amr.yaml").write_text(json.dumps(ROBOT | ({"lidar": LIDAR} if lidar else {})))


class Clock:
    """Notes how far a run is behind the clock, and the processor time that it uses, while it is measured."""

    def __init__(self, measuring: Any) -> None:
        self._measuring, lags = measuring, list[float]()
        self.lags, self._began = lags, (0.0, 0.0)
        self.cpu = 0.0
        change = Pace.change

        def watched(pace: Pace, now: float) -> str | None:
            if measuring.is_set():
                lags.append(max(0.0, time.monotonic() - pace.due(now)))
            return change(pace, now)

        Pace.change = watched  # type: ignore[method-assign]

    @hookimpl
    def mrpbench_stepped(self) -> None:
        """Measure."""
        if self._measuring.is_set():
            now = time.monotonic(), time.process_time()
            self._began = now if self._began[0] == 0.0 else self._began
            wall = now[0] - self._began[0]
            self.cpu = (now[1] - self._began[1]) / wall if wall else 0.0


def drive(options: argparse.Namespace, folder: str, url: str, measuring: Any, results: "Queue[Any]") -> None:
    """Be the vehicles, in this process."""
    os.chdir(folder)
    write_site(Path(), options.vehicles, options.lidar)
    interface = {"plugin": "vda5050", "url": url, "state_interval": 1.0}
    config = {
        "name": "vehicles",
        "world": {"plugin": "movingai", "file": "hall.map"},
        "roadmap": "grid",
        "scenario": {"plugin": "file", "file": "starts.yaml"},
        "fleet": "amr.yaml",
        "simulator": "planar",
        "planner": "live",
        "dispatcher": {"plugin": "live", "pace": options.pace, "interface": interface},
        "tasks": "live",
        "control_rate": options.control_rate,
        "limits": {"execution": options.pace * (options.seconds + 2 * WARM_UP_S)},
        "recording": {"rate": 1},
        "metrics": ["execution"],
    }
    config |= {"controller": "dwb"} if options.lidar else {}
    clock, hooks, profile = Clock(measuring), Hooks(), cProfile.Profile(time.process_time)
    hooks.register(clock, "clock")
    (point,) = load_study(config).runs
    paths = RunPaths(recording=Path("run.zip").absolute(), exports=Path("exports").absolute())
    if options.profile:
        profile.enable()
    record = execute(point.config, "vehicles", paths, hooks=hooks)
    profile.disable()
    if options.profile:
        pstats.Stats(profile).sort_stats("tottime").print_stats(options.profile)
    lags = np.array(clock.lags or [np.nan])
    results.put(
        {
            "lag": 1e3 * np.percentile(lags, 99),
            "lag_max": 1e3 * lags.max(),
            "cpu": clock.cpu,
            "contacts": record.metrics.get("execution.robot_contacts"),
            "error": str(record.error or ""),
        }
    )


class Control:
    """Sends vehicles to and fro, and looks at their states."""

    def __init__(self, url: str, vehicles: int) -> None:
        self._names = VERSIONS["3.0"]
        self._prefix = f"{self._names.topics}/mrpbench/"
        self._headers = [Headers(self._names.version, "mrpbench", f"robot_{it}") for it in range(vehicles)]
        self._vehicles = {f"robot_{it}": it for it in range(vehicles)}
        self._sent = [0] * vehicles
        self._number = [-1] * vehicles
        self._came = [0.0] * vehicles
        self._node = [0] * vehicles
        self.wire = Wire(Broker.of(url))
        self._client = Client(self.wire, "control", None, (self._prefix + "+/state",), lambda: None, self._take)
        self.wire.add(self._client)
        self.clear()

    def clear(self) -> None:
        """Begin to count."""
        self.ages: list[float] = []
        self.gaps = self.nodes = 0
        self.longest = 0.0
        self._came = [time.time()] * len(self._sent)

    @property
    def all_here(self) -> bool:
        """All vehicles have sent a state."""
        return min(self._number) >= 0

    def end(self) -> None:
        """Count the time since the last state of each vehicle, too."""
        self.longest = max(self.longest, time.time() - min(self._came))

    def _take(self, topic: str, payload: bytes) -> None:
        now, vehicle = time.time(), self._vehicles[topic.split("/")[-2]]
        state = json.loads(payload)
        self.ages.append(now - datetime.fromisoformat(state["timestamp"]).timestamp())
        number = state["headerId"]
        self.gaps += self._number[vehicle] >= 0 and number != self._number[vehicle] + 1
        self._number[vehicle] = number
        self.longest, self._came[vehicle] = max(self.longest, now - self._came[vehicle]), now
        if state["lastNodeSequenceId"] != self._node[vehicle]:
            self._node[vehicle] = state["lastNodeSequenceId"]
            self.nodes += 1
        known = state["orderId"] == (str(self._sent[vehicle]) if self._sent[vehicle] else "")
        if known and not state["nodeStates"] and not state["driving"]:
            self._order(vehicle, state)

    def _order(self, vehicle: int, state: dict[str, Any]) -> None:
        (x, y), here = lane_of(vehicle), state["mobileRobotPosition"]
        way = [x + step for step in range(10)]
        if here["x"] > x + 4.5:
            way.reverse()
        self._sent[vehicle] += 1
        nodes = [
            {
                "nodeId": f"{place:g}",
                "sequenceId": 2 * number,
                "released": True,
                "nodePosition": {"x": place, "y": y, "mapId": here["mapId"]},
                "actions": [],
            }
            for number, place in enumerate(way)
        ]
        edges = [
            {"edgeId": f"{it}", "sequenceId": 2 * it + 1, "released": True, "actions": []} for it in range(len(way) - 1)
        ]
        order = {"orderId": str(self._sent[vehicle]), "orderUpdateId": 0, "nodes": nodes, "edges": edges}
        message = {**self._headers[vehicle].next("order"), **order}
        self._client.publish(f"{self._prefix}robot_{vehicle}/order", json.dumps(message).encode())


def start_broker(folder: Path) -> tuple[str, "subprocess.Popen[bytes]"]:
    """Start `mosquitto` on a free port."""
    program = shutil.which("mosquitto", path="/usr/sbin:/usr/bin:/usr/local/sbin:/usr/local/bin")
    if program is None:
        sys.exit("mosquitto is not installed: apt-get install mosquitto")
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        port = found.getsockname()[1]
    (folder / "mosquitto.conf").write_text(
        f"listener {port} 127.0.0.1\nallow_anonymous true\nset_tcp_nodelay true\nmax_queued_messages 0\n"
    )
    broker = subprocess.Popen([program, "-c", str(folder / "mosquitto.conf")], stderr=subprocess.DEVNULL)
    while True:
        try:
            socket.create_connection(("127.0.0.1", port), 1).close()
        except OSError:
            time.sleep(0.05)
        else:
            return f"mqtt://127.0.0.1:{port}", broker


def measure(options: argparse.Namespace, folder: Path) -> dict[str, Any]:
    """Measure one fleet."""
    url, broker = start_broker(folder)
    spawn = multiprocessing.get_context("spawn")
    results, measuring = spawn.Queue(), spawn.Event()
    vehicles = spawn.Process(target=drive, args=(options, str(folder), url, measuring, results))
    vehicles.start()
    try:
        control = Control(url, options.vehicles)
        while not control.all_here:
            control.wire.serve(time.monotonic() + 0.05)
            if vehicles.exitcode is not None:
                sys.exit(1)
        control.wire.serve(time.monotonic() + WARM_UP_S)
        control.clear()
        used, began = psutil.Process(broker.pid).cpu_times(), time.monotonic()
        measuring.set()
        control.wire.serve(began + options.seconds)
        measuring.clear()
        wall, after = time.monotonic() - began, psutil.Process(broker.pid).cpu_times()
        control.end()
        ages = 1e3 * np.array(control.ages)
        while results.empty():  # orders go on until the run ends
            control.wire.serve(time.monotonic() + 0.1)
            if vehicles.exitcode:
                sys.exit(1)
        found: dict[str, Any] = results.get()
        vehicles.join()
        control.wire.close()
    finally:
        vehicles.kill()
        broker.kill()
    return found | {
        "states": len(ages) / wall,
        "age_p50": np.percentile(ages, 50),
        "age": np.percentile(ages, 99),
        "longest": control.longest,
        "gaps": control.gaps,
        "nodes": control.nodes / wall,
        "broker": (after.user + after.system - used.user - used.system) / wall,
    }


def main() -> None:
    """Measure, and print a line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--vehicles", type=int, default=1000)
    parser.add_argument("--seconds", type=float, default=60.0, help="wall time that counts")
    parser.add_argument("--pace", type=float, default=1.0)
    parser.add_argument("--control-rate", type=float, default=10.0)
    parser.add_argument("--lidar", action="store_true", help="vehicles have a lidar and drive by dwb")
    parser.add_argument("--profile", type=int, default=0, metavar="N", help="print the N most expensive functions")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        found = measure(options, Path(folder))
    print(
        f"{options.vehicles} vehicles: {found['states']:.0f} states/s, age p50 {found['age_p50']:.0f} ms, "
        f"p99 {found['age']:.0f} ms, longest pause {found['longest']:.2f} s, {found['gaps']} gaps, "
        f"{found['nodes']:.0f} nodes/s, {found['contacts']} contacts, lag p99 {found['lag']:.0f} ms, "
        f"max {found['lag_max']:.0f} ms, CPU {found['cpu']:.2f}, broker {found['broker']:.2f}; "
        f"load {os.getloadavg()[0]:.1f} {found['error']}"
    )


if __name__ == "__main__":
    main()
