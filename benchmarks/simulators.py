"""Measure how many times faster than real time each simulator is at 20 Hz control, and the time of a scan.

Prints simulated seconds per second of one core by simulator and number of robots, without and with lidars of 360 beams
at 5 Hz, in a hall of 22 × 27 m with 96 shelves. Robots follow commands that change every second, so that they bump into
shelves and each other. All cases run in turn in one process, and in rounds: of several rounds the fastest counts, which
keeps the ratios of the columns fair on a busy machine.
"""

import argparse
import time
from collections.abc import Callable, Iterator
from importlib.util import find_spec

import attrs
import numpy as np
from mrpbench_native.sim import Caster
from mrpbench_simulators_planar import Planar

from mrpbench_core.api import Simulator
from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.builtin.simulators.lidar import scan
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet, Lidar
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.execution.state import Inputs
from mrpbench_core.model.worlds.solids import segments
from mrpbench_core.model.worlds.world import Level, Obstacle, World

PERIOD = 0.05
WIDTH, HEIGHT = 22.0, 27.0
BURGER = load_robot("turtlebot3_burger")
LIMIT = np.array([BURGER.max_speed, BURGER.max_turn_rate])
MOST = {"kinematic": 1000, "mujoco": 100, "pybullet": 100, "pybullet body": 100}
"""Robots; with more, a simulator that was not made for it takes minutes."""
BUDGET = 0.4
"""Seconds of wall time for one measurement."""


def hall() -> World:
    """Shelves of 0.8 × 1.8 m in 12 columns and 8 rows."""
    shelves = [(1.5 + 1.65 * column, 2 + 3.1 * row) for column in range(12) for row in range(8)]
    obstacles = tuple(
        Obstacle(name=f"shelf_{index}", polygon=np.array([(0, 0), (0.8, 0), (0.8, 1.8), (0, 1.8)]) + (x, y))
        for index, (x, y) in enumerate(shelves)
    )
    corners = [(0.0, 0.0), (WIDTH, 0.0), (WIDTH, HEIGHT), (0.0, HEIGHT)]
    walls = np.column_stack([corners, corners[1:] + corners[:1]])
    return World(name="hall", levels=(Level(name="L1", walls=walls, obstacles=obstacles),))


def placements(world: World, robots: int) -> Float:
    """Free places f8[n,3], 1 cm clear of everything."""
    random, outline, places = np.random.default_rng(1), segments(world), np.empty((0, 3))
    radius, shelves = BURGER.radius + 0.01, world.levels[0].obstacles
    while len(places) < robots:
        x, y, yaw = random.uniform([0, 0, -3], [WIDTH, HEIGHT, 3])
        inside = any((it.polygon.min(0) < (x, y)).all() and ((x, y) < it.polygon.max(0)).all() for it in shelves)
        apart = np.hypot(places[:, 0] - x, places[:, 1] - y).min(initial=np.inf) > 2 * radius
        if inside or not apart:
            continue
        if point_segment_distance(np.array([x, y]), outline[:, :2], outline[:, 2:]).min() > radius:
            places = np.vstack([places, (x, y, yaw)])
    return places


def simulators() -> dict[str, Simulator]:
    """Return the simulators whose libraries are installed."""
    found: dict[str, Simulator] = {"planar": Planar(), "kinematic": Kinematic()}
    if find_spec("mujoco") is not None:
        from mrpbench_simulators_mujoco import MuJoCo

        found["mujoco"] = MuJoCo()
    if find_spec("pybullet") is not None:
        from mrpbench_simulators_pybullet import PyBullet

        found["pybullet"] = PyBullet()
        found["pybullet body"] = PyBullet(model="body")
    return found


def drive(simulator: Simulator, world: World, robots: int, lidars: bool) -> Iterator[float]:
    """Simulated seconds per second, measured at each step of the iterator."""
    robot = BURGER if lidars else attrs.evolve(BURGER, lidar=None)
    random, per_second = np.random.default_rng(2), round(1 / PERIOD)
    with simulator.open(world, Fleet(robots=(robot,) * robots), placements(world, robots), 0, PERIOD) as simulation:
        while True:
            began, periods = time.perf_counter(), 0
            while time.perf_counter() < began + BUDGET:
                if periods % per_second == 0:
                    inputs = Inputs(twist=random.uniform((0, -1), (1, 1), (robots, 2)) * LIMIT)
                simulation.step(inputs)
                simulation.scans()
                periods += 1
            yield periods * PERIOD / (time.perf_counter() - began)


def scan_costs(world: World, robots: int) -> tuple[float, float]:
    """Microseconds for one scan by the native caster and by the kinematic simulator's."""
    lidar, solids, pose = BURGER.lidar or Lidar(), segments(world), placements(world, robots)
    radius, movers, scanning = np.full(robots, BURGER.radius), np.empty((0, 2)), np.arange(robots, dtype=np.int32)
    caster = Caster(segments=solids, lidar=lidar)
    near = solids[point_segment_distance(pose[0, :2], solids[:, :2], solids[:, 2:]) < lidar.range + 1]
    native = fastest(lambda: caster.scan(scanning, pose, movers, radius)) / robots
    return native, fastest(lambda: scan(lidar, pose[0], near, pose[1:, :2], radius[1:]))


def fastest(work: Callable[[], object], times: int = 30) -> float:
    """Microseconds."""
    best = np.inf
    for _ in range(times):
        began = time.perf_counter()
        work()
        best = min(best, time.perf_counter() - began)
    return best * 1e6


def main() -> None:
    """Measure the rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("robots", nargs="*", type=int, default=[9, 100, 1000], help="numbers of robots")
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    world, kinds = hall(), simulators()
    print(f"{'robots':>6} {'lidar':>5} " + " ".join(f"{name:>14}" for name in kinds) + "   planar / the others")
    for robots in options.robots:
        for lidars in (False, True):
            cases = {
                name: drive(kind, world, robots, lidars)
                for name, kind in kinds.items()
                if robots <= MOST.get(name, robots)
            }
            best = dict.fromkeys(cases, 0.0)
            for _ in range(options.rounds):
                best = {name: max(best[name], next(case)) for name, case in cases.items()}
            shown = [f"{best[name]:>13.4g}x" if name in best else f"{'-':>14}" for name in kinds]
            ratios = [f"{best['planar'] / best[name]:.0f}" for name in best if name != "planar"]
            print(f"{robots:>6} {'yes' if lidars else 'no':>5} {' '.join(shown)}   {', '.join(ratios)}", flush=True)
    for robots in options.robots:
        native, plain = scan_costs(world, robots)
        print(f"one scan of 360 beams among {robots} robots: {native:.2f} µs native, {plain:.0f} µs kinematic")


if __name__ == "__main__":
    main()
