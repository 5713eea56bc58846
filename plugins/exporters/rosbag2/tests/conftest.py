"""A run made by hand: two robots on a triangle of places in a room with an inner wall."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

from mrpbench_core.model.common.fleet import Fleet, Lidar, RobotModel
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import Plan, PlanResult, PlanStatus, RobotPath
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.worlds.world import Lane, Level, Obstacle, Vertex, World

SECONDS = 4
PERIODIC_RATE, SCAN_RATE = 20, 5
NAN = float("nan")


@pytest.fixture
def context() -> RunContext:
    walls = [[0, 0, 6, 0], [6, 0, 6, 4], [6, 4, 0, 4], [0, 4, 0, 0], [3, 0, 3, 1]]
    crate = Obstacle(name="crate", polygon=[[4.0, 2.0], [5.0, 2.0], [4.5, 3.0]])
    world = World(
        name="room",
        levels=(Level(name="L1", elevation=0.5, walls=walls, obstacles=(crate,)),),
        vertices=(Vertex(name="dock", x=1, y=1), Vertex(name="", x=1, y=3), Vertex(name="shelf", x=2, y=3)),
        lanes=(Lane(start=0, end=1), Lane(start=1, end=2, bidirectional=False)),
    )
    footprint = [[-0.1, -0.08], [0.1, -0.08], [0.1, 0.08], [-0.1, 0.08]]
    robot = RobotModel(
        name="cart",
        footprint=footprint,
        max_speed=0.22,
        max_turn_rate=2.84,
        lidar=Lidar(beams=8, range=3.5, mount=(-0.032, 0.0, 0.182)),
    )
    roadmap = Roadmap(
        position=[[1, 1], [1, 3], [2, 3]],
        level=[0, 0, 0],
        heading=[NAN] * 3,
        edges=[[0, 1], [1, 2]],
        duration=[[2, 1]],
        tick=0.5,
    )
    problem = Problem(
        roadmap=roadmap, profile=[0, 0], radius=[0.13] * 2, start=[0, 2], ready=[0, 0], goals=(((1,),), ((2,),))
    )
    plan = Plan(
        paths=(
            RobotPath(edge=[-1, 0], enter=[0, 1], leave=[1, 3]),
            RobotPath(edge=[], enter=[], leave=[]),
        )
    )
    return RunContext(
        run_id="f00d",
        world=world,
        fleet=Fleet(robots=(robot, robot)),
        scenario=Scenario(
            start=[[1, 1, 0], [2, 3, 0]],
            start_level=[0, 0],
            tasks=(Task(goals=[[1, 3, NAN]]), Task(goals=[[2, 3, 1.0]])),
        ),
        problem=problem,
        result=PlanResult(status=PlanStatus.SOLVED, plan=plan),
        routes=(
            Route(waypoint=[[1, 1, NAN], [1, 1, NAN], [1, 3, NAN]], level=[0, 0, 0], speed=[np.inf] * 2),
            Route(waypoint=[[2, 3, 1.0]], level=[0], speed=[]),
        ),
        goal=((1.0, 3.0, NAN), (2.0, 3.0, 1.0)),
        assigned=(0, 1),
    )


@pytest.fixture
def recording() -> dict[str, np.ndarray]:
    """Robot 0 drives a circle, robot 1 turns on the spot; both believe to be a little beside the truth."""
    time = np.arange(SECONDS * PERIODIC_RATE + 1) / PERIODIC_RATE
    rows = len(time)
    truth = np.zeros((rows, 2, 3))
    truth[:, 0] = np.stack([1 + 0.5 * np.sin(time), 1.5 - 0.5 * np.cos(time), time], axis=1)
    truth[:, 1] = np.stack([np.full(rows, 2.0), np.full(rows, 3.0), -2 * time], axis=1)
    odometry = np.zeros((rows, 2, 5))
    odometry[..., :3] = truth - truth[0] + 0.01 * time[:, None, None]
    odometry[..., 3:] = [[0.5, 1.0], [0.0, -2.0]]
    scan_time = np.repeat(np.arange(SECONDS * SCAN_RATE + 1) / SCAN_RATE, 2)
    ranges = np.random.default_rng(1).uniform(0.12, 3.5, (len(scan_time), 8)).astype("f4")
    ranges[:, 3] = np.inf
    return {
        "time": time,
        "truth": truth,
        "truth_twist": np.broadcast_to([[0.5, 1.0], [0.0, -2.0]], (rows, 2, 2)),
        "estimate": truth + [0.02, -0.03, 0.004],
        "odometry": odometry,
        "command": np.broadcast_to([[0.6, 1.1], [0.0, -2.1]], (rows, 2, 2)),
        "level": np.zeros((rows, 2), "i2"),
        "released": np.zeros((rows, 2), "i4"),
        "reached": np.zeros((rows, 2), "i4"),
        "cleared": np.zeros((rows, 2), "i4"),
        "mode": np.zeros((rows, 2), "u1"),
        "scan_time": scan_time,
        "scan_robot": np.tile(np.array([0, 1], "i4"), len(scan_time) // 2),
        "scan_ranges": ranges,
        "contact_time": np.array([1.0, 1.05, 2.025]),
        "contact": np.array([[0, 1], [0, 1], [1, -1]], "i4"),
        "contact_force": np.array([2.5, 1 / 3, np.nan]),
        "event_time": np.array([0.0, 1.05, 3.999]),
        "event_kind": np.array(["replan", "recovery", "abort"]),
        "event_robot": np.array([-1, 0, 1], "i4"),
        "event_detail": np.array(["", "spin", "no way to place_7"]),
    }


@pytest.fixture
def read():
    """Reads an mcap bag by topic with a reader that shares no code with the writer: (log time, decoded message)."""

    def reading(bag: Path) -> dict[str, list]:
        found: dict[str, list] = {}
        with (bag / f"{bag.name}.mcap").open("rb") as file:
            for _, channel, message, decoded in make_reader(
                file, decoder_factories=[DecoderFactory()]
            ).iter_decoded_messages():
                found.setdefault(channel.topic, []).append((message.log_time, decoded))
        return found

    return reading


@pytest.fixture
def foreign(tmp_path):
    """Begins a bag as another stack would record it; see `foreign.py`."""
    spec = importlib.util.spec_from_file_location("foreign_bags", Path(__file__).with_name("foreign.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return lambda *options: module.Foreign(tmp_path / "foreign", *options)


@pytest.fixture(scope="module", autouse=True)
def _kept(kept_workers):
    """Studies of a module share their worker processes."""
