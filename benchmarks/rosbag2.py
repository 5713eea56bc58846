"""Measure how many messages per second the format `rosbag2` writes on one core, by number of robots.

Everything a run has, at 20 Hz (scans of 360 random beams at 5 Hz), from the first message to the finished bag. Fleets
are done in turn, in rounds, and the fastest round counts. Prints messages and megabytes a second of CPU time, and how
many times faster than real time that is.
"""

import argparse
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import attrs
import numpy as np
from mrpbench_exporters_rosbag2 import Rosbag2

from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet, Lidar
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.worlds.world import Level, World

RATE, SCAN_RATE, BEAMS, SIDE = 20, 5, 360, 50.0
ROBOT_SECONDS = 2000
"""Simulated, for each fleet."""


def context(robots: int) -> RunContext:
    """Robots that go nowhere in an empty hall."""
    robot = attrs.evolve(load_robot("turtlebot3_burger"), lidar=Lidar(beams=BEAMS, range=3.5, rate=SCAN_RATE))
    walls = [[0, 0, SIDE, 0], [SIDE, 0, SIDE, SIDE], [SIDE, SIDE, 0, SIDE], [0, SIDE, 0, 0]]
    places = np.random.default_rng(0).uniform(1, SIDE - 1, (robots, 2))
    start = np.column_stack([places, np.zeros(robots)])
    index = np.arange(robots)
    roadmap = Roadmap(
        position=places,
        level=np.zeros(robots),
        heading=np.full(robots, np.nan),
        edges=np.empty((0, 2)),
        duration=np.empty((1, 0)),
        tick=1.0,
    )
    return RunContext(
        run_id="0",
        world=World(name="hall", levels=(Level(name="L1", walls=walls),)),
        fleet=Fleet(robots=(robot,) * robots),
        scenario=Scenario(
            start=start, start_level=np.zeros(robots), tasks=tuple(Task(goals=pose[None]) for pose in start)
        ),
        problem=Problem(
            roadmap=roadmap,
            profile=np.zeros(robots),
            radius=np.full(robots, robot.radius),
            start=index,
            ready=np.zeros(robots),
            goals=tuple(((int(vertex),),) for vertex in index),
        ),
        result=PlanResult(status=PlanStatus.UNKNOWN),
        routes=tuple(Route(waypoint=pose[None], level=[0], speed=[]) for pose in start),
        goal=tuple((float(x), float(y), 0.0) for x, y in places),
        assigned=tuple(index.tolist()),
    )


def chunks(robots: int, seconds: float) -> Iterator[Chunk]:
    """Chunks like those of the recorder: 256 samples, or 4096 scans."""
    random = np.random.default_rng(0)
    samples = max(RATE // SCAN_RATE, min(256, 4096 * RATE // SCAN_RATE // robots))
    steps = int(seconds * RATE)
    for first in range(0, steps, samples):
        step = np.arange(first, min(steps, first + samples))
        now, pose = step / RATE, random.uniform(0, SIDE, (len(step), robots, 3))
        seen = now[step % (RATE // SCAN_RATE) == 0]
        counts = np.zeros((len(step), robots), "i4")
        yield {
            "time": now,
            "truth": pose,
            "truth_twist": pose[..., :2],
            "estimate": pose,
            "odometry": np.concatenate([pose, pose[..., :2]], axis=2),
            "command": pose[..., :2],
            "level": counts.astype("i2"),
            **dict.fromkeys(("released", "reached", "cleared"), counts),
            "mode": counts.astype("u1"),
            "scan_time": np.repeat(seen, robots),
            "scan_robot": np.tile(np.arange(robots, dtype="i4"), len(seen)),
            "scan_ranges": random.uniform(0.1, 3.5, (len(seen) * robots, BEAMS)).astype("f4"),
        }


def measure(robots: int, storage: str) -> tuple[float, float, float]:
    """Messages a second, megabytes a second, and times real time."""
    seconds = max(5.0, ROBOT_SECONDS / robots)
    place, said = context(robots), list(chunks(robots, seconds))
    with tempfile.TemporaryDirectory() as folder:
        began = time.process_time()
        session = Rosbag2(storage=storage).open(place, Path(folder) / "bag")
        for chunk in said:
            session.write(chunk)
        bag = session.bag
        session.close()
        spent = time.process_time() - began
        count = sum(bag.writer.counts.values()) if bag else 0
        size = sum(file.stat().st_size for file in (Path(folder) / "bag").iterdir())
    return count / spent, size / 1e6 / spent, seconds / spent


def main() -> None:
    """Measure the rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--robots", type=int, nargs="+", default=[1, 9, 100, 1000])
    arguments = parser.parse_args()
    cases = [(robots, storage) for robots in arguments.robots for storage in ("mcap", "sqlite3")]
    best = dict.fromkeys(cases, (0.0, 0.0, 0.0))
    for _ in range(arguments.rounds):
        for case in cases:
            best[case] = max(best[case], measure(*case))
    print(f"{'robots':>6} {'storage':>8} {'messages/s':>10} {'MB/s':>6} {'× real time':>11}")
    for (robots, storage), (messages, size, factor) in best.items():
        print(f"{robots:6} {storage:>8} {messages:10,.0f} {size:6.1f} {factor:11.2f}")


if __name__ == "__main__":
    main()
