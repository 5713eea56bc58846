"""Measure the errors of localizers in runs of the whole engine, and their costs.

Errors are over four robots and three scenarios of 60 simulated seconds on each built-in world, with noisy lidars and
odometry. Costs are of one thread: the time of a whole session divided by the filter updates that it made. The cost of
`slam` is the CPU time of a session on the odometry and the scans of recorded runs, with the maps that it would record,
as a share of that of `amcl` on the same.
"""

import argparse
import tempfile
import time
from pathlib import Path

import numpy as np
from mrpbench_localizers_amcl import Amcl
from mrpbench_localizers_slam import Slam
from mrpbench_simulators_planar import Planar
from mrpbench_worlds_standard.shipped import Office

import mrpbench_core
from mrpbench_core.api import Localizer
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.common.poses import wrapped
from mrpbench_core.model.execution.observation import Odometry, ScanBatch
from mrpbench_core.model.execution.state import Inputs
from mrpbench_core.store.recording import Recording

NOISE = {"lidar": 0.01, "lidar_dropout": 0.02, "odometry": 0.005, "odometry_bias": 0.002}
ALPHAS = {f"alpha{index}": 0.02 for index in range(1, 5)}
LOCALIZERS = {
    "odometry": "odometry",
    "amcl, Nav2's defaults": "amcl",
    "amcl, alphas 0.02": {"plugin": "amcl", **ALPHAS},
    "amcl, likelihood_field_prob, alphas 0.02": {
        "plugin": "amcl",
        "laser_model_type": "likelihood_field_prob",
        **ALPHAS,
    },
    "slam": "slam",
    "slam, without loops": {"plugin": "slam", "do_loop_closing": False},
}


def errors(world: str, localizer: object) -> np.ndarray:
    """Errors of estimates f8[k,3] in metres and radians."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        study = {
            "world": world,
            "scenario": {"plugin": "random", "robots": 4},
            "assigner": "identity",
            "planner": "prioritized",
            "simulator": "planar",
            "localizer": localizer,
            "noise": NOISE,
            "metrics": [],
            "limits": {"execution": "60 s"},
            "matrix": {"seed": "0..2"},
        }
        mrpbench_core.run(study, out=folder)
        for file in Path(folder).rglob("recordings/*.zip"):
            recording = Recording(file)
            off = recording.channel("estimate") - recording.channel("truth")
            recording.close()
            found.append(off.reshape(-1, 3))
    off = np.concatenate(found)
    off[:, 2] = wrapped(off[:, 2])
    return off


def cost(robots: int, localizer: Amcl, seconds: float = 20.0, period: float = 0.05) -> float:
    """Microseconds per filter update of robots that turn on the spot in the office."""
    fleet, world = Fleet(robots=(load_robot("turtlebot3_burger"),) * robots), Office().load()
    places = np.array([(vertex.x, vertex.y, 0.0) for vertex in world.vertices])
    starts = places[np.arange(robots) % len(places)]
    starts = starts + np.random.default_rng(0).uniform(-0.1, 0.1, starts.shape)
    session = localizer.start(fleet, world, starts, 0)
    steps = []
    with Planar().open(world, fleet, starts, 0, period) as simulation:
        for _ in range(round(seconds / period)):
            state = simulation.step(Inputs(twist=np.tile((0.0, 1.01), (robots, 1))))
            steps.append((Odometry(pose=state.pose, twist=state.twist), simulation.scans()))
    spent = 0.0
    for step, (odometry, scans) in enumerate(steps):
        began = time.process_time()
        session.update(step * period, odometry, scans, None)
        spent += time.process_time() - began
    updates = sum(len(batch.robot) for _, scans in steps for batch in scans)  # 1.01 rad/s: every scan at 5 Hz counts
    return spent / updates * 1e6


def spent(recording: Recording, localizer: Localizer) -> float:
    """CPU seconds of a session on the odometry and scans of a recorded run."""
    context = recording.first_context()
    session = localizer.start(context.fleet, context.world, recording.channel("truth")[0], 0)
    time_s, rows = recording.channel("time"), recording.channel("odometry")
    robot, ranges = recording.channel("scan_robot"), recording.channel("scan_ranges").astype(float)
    first = np.searchsorted(recording.channel("scan_time"), [-1.0, *(time_s + 1e-9)])
    total = 0.0
    for step, now in enumerate(time_s.tolist()):
        new = slice(first[step], first[step + 1])
        scans = [ScanBatch(stamp=now, robot=robot[new].astype(np.int32), ranges=ranges[new])] if len(robot[new]) else []
        odometry = Odometry(pose=rows[step, :, :3].copy(), twist=rows[step, :, 3:].copy())
        began = time.process_time()
        session.update(now, odometry, scans, None)
        session.map_changes(now, step == len(time_s) - 1)
        total += time.process_time() - began
    return total


def share(world: str, rounds: int = 3) -> float:
    """CPU time of `slam` as a share of that of `amcl`, both with their defaults, in turns on the same runs."""
    with tempfile.TemporaryDirectory() as folder:
        study = {
            "world": world,
            "scenario": {"plugin": "random", "robots": 6},
            "assigner": "identity",
            "planner": "prioritized",
            "simulator": "planar",
            "localizer": "amcl",
            "noise": NOISE,
            "metrics": [],
            "recording": {"scans": True, "rate": 20},
            "matrix": {"seed": "0..2"},
        }
        mrpbench_core.run(study, out=folder)
        totals = np.zeros(2)
        for file in sorted(Path(folder).rglob("recordings/*.zip")) * rounds:
            recording = Recording(file)
            totals += [spent(recording, Slam()), spent(recording, Amcl())]
            recording.close()
    return float(totals[0] / totals[1])


def main() -> None:
    """Measure the rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("worlds", nargs="*", default=["office", "warehouse"])
    options = parser.parse_args()
    for world in options.worlds:
        for name, localizer in LOCALIZERS.items():
            off = errors(world, localizer)
            distance = np.hypot(off[:, 0], off[:, 1])
            rms, turn, tail = (
                np.sqrt((distance**2).mean()),
                np.sqrt((off[:, 2] ** 2).mean()),
                np.quantile(distance, 0.95),
            )
            shown = f"rms {rms:.3f} m  95 % {tail:.3f}  most {distance.max():.3f}  yaw rms {turn:.3f} rad"
            print(f"{world:<10} {name:<42} {shown}", flush=True)
    for name, localizer in (
        ("500 to 2000 particles", Amcl()),
        ("likelihood_field_prob", Amcl(laser_model_type="likelihood_field_prob")),
        ("always 2000 particles", Amcl(min_particles=2000)),
    ):
        shown = ", ".join(f"{cost(robots, localizer):.0f} µs with {robots}" for robots in (1, 9, 100))
        print(f"one update, {name}: {shown} robots")
    for world in options.worlds:
        print(f"{world:<10} CPU time of slam / amcl: {share(world):.2f}")


if __name__ == "__main__":
    main()
