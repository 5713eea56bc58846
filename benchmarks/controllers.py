"""Measure how many control cycles a second each controller computes on one core.

Burgers with lidars of 360 beams at 5 Hz follow straight paths through a corridor of 2 m at 20 Hz, each from an offset
and a heading of its own. A cycle is the command of one robot with its share of the updates of its costmap. All
controllers have Nav2's defaults: `mppi` has 1,000 samples of 56 steps. CPU time of one thread, the fastest of several
rounds.
"""

import argparse
import time

import numpy as np
from mrpbench_controllers_dwb import Dwb
from mrpbench_controllers_graceful import Graceful
from mrpbench_controllers_mppi import Mppi
from mrpbench_controllers_rotation_shim import RotationShim
from mrpbench_controllers_rpp import Rpp

from mrpbench_core.api import Controller
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.execution.observation import Observations, ScanBatch
from mrpbench_core.model.worlds.world import World
from mrpbench_core.testing.fixtures.room import driven

CONTROLLERS: dict[str, Controller] = {
    "mppi": Mppi(),
    "dwb": Dwb(),
    "rpp": Rpp(),
    "graceful": Graceful(),
    "rotation_shim around rpp": RotationShim(primary_controller=Rpp()),
}
ASKED = {"mppi": 1000}
"""Cycles a second that a controller is to compute."""
ROBOT = load_robot("turtlebot3_burger")
PERIOD = 0.05
SCAN_PERIODS = 4
HALF_WIDTH = 1.0
END = 10.0
"""Where the paths end, metres along the corridor."""


def scans(now: float, pose: Float) -> ScanBatch:
    """Scans of the two walls of the corridor, y = +-1 m."""
    assert ROBOT.lidar is not None
    beam = pose[:, 2:] + np.linspace(0.0, 2 * np.pi, ROBOT.lidar.beams, endpoint=False)
    slope = np.sin(beam)
    with np.errstate(divide="ignore"):
        ranges = (np.copysign(HALF_WIDTH, slope) - pose[:, 1:2]) / slope
    ranges = np.where(ranges <= ROBOT.lidar.range, ranges, np.inf)
    return ScanBatch(stamp=now, robot=np.arange(len(pose), dtype=np.int32), ranges=ranges)


def measure(controller: Controller, robots: int, seconds: float) -> tuple[float, float]:
    """Cycles a second of CPU time, and the mean speed of the robots along the corridor in m/s."""
    session = controller.start_fleet((ROBOT,) * robots, World(name="corridor", levels=()), PERIOD)
    pose = np.random.default_rng(0).uniform((0.0, -0.3, -0.5), (0.0, 0.3, 0.5), (robots, 3))
    twist, every, spent = np.zeros((robots, 2)), np.arange(robots), 0.0
    periods = round(seconds / PERIOD)
    for period in range(periods):
        now, x = period * PERIOD, pose[:, 0]
        batch = (scans(now, pose),) if period % SCAN_PERIODS == 0 else ()
        seen = Observations(
            now=now,
            robot=every,
            pose=pose,
            twist=twist,
            foot=np.column_stack([x, np.zeros(robots)]),
            points=np.tile([END, 0.0], (robots, 1)),
            begin=every,
            end=every + 1,
            yaw=np.full(robots, np.nan),
            speed=np.full(robots, np.inf),
            fleet_pose=pose,
            scans=batch,
        )
        began = time.process_time()
        twist = session.command(seen)
        spent += time.process_time() - began
        twist = np.nan_to_num(twist)
        pose = driven(pose, twist, PERIOD)
    return robots * periods / spent, float(pose[:, 0].mean() / seconds)


def main() -> None:
    """Measure the rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("controllers", nargs="*", default=list(CONTROLLERS), help="default: all")
    parser.add_argument("--robots", type=int, default=9)
    parser.add_argument("--seconds", type=float, default=10.0, help="simulated, of each round")
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    if unknown := set(options.controllers) - set(CONTROLLERS):
        parser.error(f"no such controller: {', '.join(sorted(unknown))}")
    print(f"{'':26} {'asked':>8} {'cycles/s':>9} {'one cycle':>10} {'mean speed':>11}")
    for name in options.controllers:
        rounds = [measure(CONTROLLERS[name], options.robots, options.seconds) for _ in range(options.rounds)]
        rate, speed = max(rounds)
        asked = ASKED.get(name, "")
        print(f"{name:<26} {asked:>8} {rate:>9.0f} {1e6 / rate:>7.1f} µs {speed:>7.2f} m/s", flush=True)


if __name__ == "__main__":
    main()
