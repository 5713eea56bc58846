"""A broker for tests, a small site, and a vehicle on it that moves when a test says so."""

import json
import shutil
import socket
import subprocess
import sys
import time

import numpy as np
import pytest
from mrpbench_live.fleet.paths import FleetPaths
from mrpbench_live.fleet.site import Site
from mrpbench_live.vda5050.battery import Battery
from mrpbench_live.vda5050.condition import Here
from mrpbench_live.vda5050.instant import InstantActions
from mrpbench_live.vda5050.messages import state_of
from mrpbench_live.vda5050.names import VERSIONS
from mrpbench_live.vda5050.schemas import validator
from mrpbench_live.vda5050.track import Track
from mrpbench_live.vda5050.vehicle import Vehicle

from mrpbench_core.api import Fleet, Level, Roadmap, RobotModel, Vertex, World
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.recording import Recording
from mrpbench_core.store.results import Results

ROBOT = RobotModel(
    name="box", footprint=[(0.2, 0.15), (-0.2, 0.15), (-0.2, -0.15), (0.2, -0.15)], max_speed=1.0, max_turn_rate=1.0
)


CODE = "import sys; from mrpbench_core.cli.main import main; sys.exit(main(sys.argv[1:]))"
MAP = "type octile\nheight 10\nwidth 12\nmap\n" + "............\n" * 10
STUDY = {
    "name": "live",
    "world": {"plugin": "movingai", "file": "free.map"},
    "roadmap": "grid",
    "scenario": {"plugin": "random", "robots": 3},
    "simulator": "planar",
    "planner": "prioritized",
    "control_rate": "10 Hz",
    "metrics": ["execution"],
}

CORRIDOR = "type octile\nheight 2\nwidth 7\nmap\n@@@.@@@\n.......\n"
BOX = """
name: box
footprint: [[0.2, 0.15], [-0.2, 0.15], [-0.2, -0.15], [0.2, -0.15]]
max_speed: 1.0
max_turn_rate: 2.0
acceleration: 1.0
turn_acceleration: 4.0
"""
STARTS = """
mrpbench_scenario: 1
robots: [{x: 0.5, y: 0.5, yaw: 0}, {x: 6.5, y: 0.5, yaw: 3.1416}]
tasks: [{goals: [{x: 6.5, y: 0.5}]}, {goals: [{x: 0.5, y: 0.5}]}]
"""
SWAP = {
    "name": "live",
    "world": {"plugin": "movingai", "file": "corridor.map"},
    "roadmap": "grid",
    "scenario": {"plugin": "file", "file": "starts.yaml"},
    "fleet": "box.yaml",
    "assigner": "identity",
    "simulator": "planar",
    "planner": "cbs",
    "control_rate": "10 Hz",
    "metrics": ["execution"],
    "limits": {"execution": "60 s"},
}


def free_port():
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


class Mosquitto:
    """A broker on a port of its own that can be stopped and started again."""

    def __init__(self, program, folder):
        self.port = free_port()
        self.url = f"mqtt://127.0.0.1:{self.port}"
        self._program, self._config = program, folder / "mosquitto.conf"
        self._config.write_text(f"listener {self.port} 127.0.0.1\nallow_anonymous true\nset_tcp_nodelay true\n")

    def start(self):
        self._process = subprocess.Popen([self._program, "-c", self._config], stderr=subprocess.DEVNULL)
        until = time.monotonic() + 10
        while True:
            try:
                socket.create_connection(("127.0.0.1", self.port), 1).close()
            except OSError:
                assert time.monotonic() < until
                time.sleep(0.02)
            else:
                return

    def stop(self):
        self._process.kill()
        self._process.wait()


@pytest.fixture
def broker(tmp_path):
    program = shutil.which("mosquitto", path="/usr/sbin:/usr/bin:/usr/local/sbin:/usr/local/bin")
    if program is None:
        pytest.skip("mosquitto is not installed: apt-get install mosquitto")
    found = Mosquitto(program, tmp_path)
    found.start()
    yield found
    found.stop()


def line(length=10, levels=2):
    """A roadmap of vertices a metre apart on a line on level 0, and one vertex that no edge leads to, on level 1."""
    pairs = [(i, i + 1) for i in range(length - 1)]
    return Roadmap(
        position=[(float(i), 0.0) for i in range(length)] + [(0.0, 0.0)] * (levels - 1),
        level=[0] * length + list(range(1, levels)),
        heading=np.full(length + levels - 1, np.nan),
        edges=pairs + [(head, tail) for tail, head in pairs],
        duration=[[10] * (2 * len(pairs))],
        tick=0.1,
        place=[0, length - 1],
    )


class Bench:
    """A vehicle on the line, and what it says; nothing else moves it."""

    def __init__(self, version):
        self.names = VERSIONS[version]
        world = World(
            name="line",
            levels=(Level(name="ground"), Level(name="upper")),
            vertices=(Vertex(name="dock", x=0.0, y=0.0), Vertex(name="end", x=9.0, y=0.0)),
        )
        self.site = Site(world, line(), Fleet(robots=(ROBOT,)))
        self.paths = FleetPaths(self.site.roadmap, np.array([0]))
        self.events = []
        track = Track(self.site, self.paths, 0)
        note = lambda kind, detail: self.events.append((kind, detail))  # noqa: E731
        self.vehicle = Vehicle(track, self.names, Battery(), 2.0, note)
        self.vehicle.last_node = "dock"
        self._faults = {topic: validator(version, topic) for topic in ("order", "instantActions", "state")}
        zones = validator(version, "zoneSet") if self.names.zones else None
        self.instant = InstantActions(self.vehicle, track, self.names, note, zones)
        self.now, self._headers = 0.0, 0
        self.step()

    def _header(self):
        self._headers += 1
        return {
            "headerId": self._headers,
            "timestamp": "2026-01-01T00:00:00.000Z",
            "version": self.names.version,
            "manufacturer": "mrpbench",
            "serialNumber": "robot_0",
        }

    def order(self, places, base, update=0, first=0, id="o1", **parts):
        """An order along places (x in metres), of which the first `base` nodes are released.

        `parts` are fields of single nodes and edges by sequence id, such as `s2={...}`.
        """
        nodes = [
            {
                "nodeId": f"n{x:g}",
                "sequenceId": first + 2 * i,
                "released": i < base,
                "nodePosition": {"x": x, "y": 0.0, "mapId": "ground"},
                "actions": [],
            }
            for i, x in enumerate(places)
        ]
        edges = [
            {
                "edgeId": f"e{i}",
                "sequenceId": first + 2 * i + 1,
                "released": i + 1 < base,
                "actions": [],
                **({} if self.names.single else {"startNodeId": f"n{places[i]:g}", "endNodeId": f"n{places[i + 1]:g}"}),
            }
            for i in range(len(places) - 1)
        ]
        for part in (*nodes, *edges):
            part.update(parts.get(f"s{part['sequenceId']}", {}))
        return {**self._header(), "orderId": id, "orderUpdateId": update, "nodes": nodes, "edges": edges}

    def action(self, type, id="a1", blocking="HARD", **parameters):
        pairs = [{"key": key, "value": value} for key, value in parameters.items()]
        return {"actionType": type, "actionId": id, "blockingType": blocking, "actionParameters": pairs}

    def take(self, order):
        self.vehicle.take_order(order, self._faults["order"](order))
        return self.step(0.0)

    def act(self, *actions):
        message = {**self._header(), "actions": list(actions)}
        self.instant.take(message, self._faults["instantActions"](message))
        return self.step(0.0)

    def step(self, seconds=0.1, driving=False, x=None, gave_up=False):
        """Let time pass; return the state, which is always valid."""
        self.now += seconds
        here = (self.x if x is None else x, 0.0, 0.0)
        self.instant.advance()
        self.vehicle.advance(Here(now=self.now, pose=here, level=0, driving=driving, gave_up=gave_up))
        return self.state()

    def state(self):
        """What the vehicle reports, which is always valid."""
        found = {**self._header(), **state_of(self.vehicle, self.site.levels, self.names)}
        assert self._faults["state"](found) is None
        return found

    @property
    def x(self):
        """Where the vehicle is by the moves that it has made, all of them to the right."""
        return float(self.paths.passed[0])

    def drive(self, moves=1, released=None):
        """Make some moves, and stand."""
        for _ in range(moves):
            assert self.paths.passed[0] < self.paths.allowed[0], "the vehicle may not drive"
            self.paths.released[0] = max(self.paths.released[0], self.paths.passed[0] + 1)
            self.step(driving=True)
            self.paths.passed[0] += 1
            self.step(driving=True)
        return self.step()

    @property
    def may_drive(self):
        return int(self.paths.allowed[0] - self.paths.passed[0])


@pytest.fixture(params=["2.1", "3.0"])
def bench(request):
    pytest.importorskip("fastjsonschema", reason="mrpbench-live[vda5050] is not installed")
    return Bench(request.param)


@pytest.fixture
def bench3():
    pytest.importorskip("fastjsonschema", reason="mrpbench-live[vda5050] is not installed")
    return Bench("3.0")


@pytest.fixture
def swap_study(tmp_path):
    """Write `study.yaml`, in which two robots swap places in a corridor with a bay."""

    def write():
        for name, text in (("corridor.map", CORRIDOR), ("box.yaml", BOX), ("starts.yaml", STARTS)):
            (tmp_path / name).write_text(text)
        (tmp_path / "study.yaml").write_text(json.dumps(SWAP))
        return tmp_path

    return write


@pytest.fixture
def command():
    """The beginning of a command line."""
    return sys.executable, "-c", CODE


@pytest.fixture
def serve(tmp_path, broker):
    """Serve the study in a process of its own; returns its record and recording when it has ended."""
    (tmp_path / "free.map").write_text(MAP)
    (tmp_path / "study.yaml").write_text(json.dumps(STUDY))
    running = []

    def start(seconds, version, pace, *options):
        words = ["serve", "study.yaml", "--vda5050", broker.url, "--version", version, "--pace", str(pace)]
        command = [sys.executable, "-c", CODE, *words, "--duration", f"{seconds} s", *options]
        running.append(subprocess.Popen(command, cwd=tmp_path))
        return running[-1]

    def result(folder="results/live"):
        assert running[0].wait(60) == 0
        folder = Results(ResultsFolder(tmp_path / folder))
        (record,) = folder
        found = Recording(folder.folder.run(record["run_id"]).recording)
        columns = (found.channels[f"event_{key}"]().tolist() for key in ("kind", "robot", "detail"))
        events = list(zip(*columns, strict=True))
        found.close()
        return record, events

    def mrpbench(*words):
        """Run another command beside it; its output can be read."""
        command = [sys.executable, "-c", CODE, *words]
        running.append(
            subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        )
        return running[-1]

    yield start, result, mrpbench
    for process in running:
        process.kill()
        process.communicate()
