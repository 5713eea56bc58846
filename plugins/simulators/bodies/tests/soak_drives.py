"""Drives drawn robots of URDFs through buildings, as rigid bodies, and finds those that do not arrive.

    python plugins/simulators/bodies/tests/soak_drives.py RUNS SEED [--simulator mujoco] [--buildings FOLDER]
        [--keep FOLDER]

Each run draws a robot and a world from its seed: where its axle is, its wheels, its casters, its mass, and whether its
body is a box, a cylinder or a mesh, in a link of its own. The worlds are built-in and generated ones, and the building
files below a folder. One robot drives with `dwb` from a place to another. A robot that jumps or is in a wall ends a run
as `contract_broken`, and one that falls or sinks does not arrive. Prints a line for each run that does not succeed; the
exit code is 1 if there is one.
"""

import argparse
import json
import shutil
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

from mrpbench_core.api import InputError
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_core.store.paths import RunPaths

WORLDS: tuple[dict[str, Any], ...] = (
    {"world": "office"},
    {"world": "warehouse"},
    {"world": "generated_rooms", "roadmap": "grid"},
    {"world": "generated_warehouse", "roadmap": "grid"},
)


class Robot:
    """A drawn robot: the footprint and the elements of its URDF. x is ahead, and the axle is at x = 0."""

    def __init__(self, random: np.random.Generator) -> None:
        self.radius = random.uniform(0.03, 0.08)
        self.length, self.width = random.uniform(0.25, 0.45), random.uniform(0.2, 0.35)
        self.separation = self.width + random.uniform(0.02, 0.06)
        self.ahead = self.length * random.uniform(-0.35, 0.35)
        """Where the centre of the body is, ahead of the axle."""
        self.height = random.uniform(0.06, 0.3)
        self.mass = random.uniform(2, 40)
        self.lift = random.uniform(0.01, self.radius)
        """Height of the floor of the body."""
        self.kind = str(random.choice(["box", "cylinder", "mesh"]))
        if self.kind == "cylinder":
            self.length = self.width = self.separation = max(self.length, self.width)
            self.ahead = 0.0
        self.wheel = str(random.choice(["cylinder", "sphere", "cylinder turned by its link"]))
        self.footprint_link = bool(random.integers(2))
        self.speed = random.uniform(0.2, 0.8)

    def footprint(self) -> list[list[float]]:
        """Return the corners of a rectangle around body and wheels, for a cylinder of a polygon."""
        half = self.separation / 2 + (self.radius if self.wheel == "sphere" else 0.015)
        if self.kind == "cylinder":
            reach = 1.03 * max(self.length / 2, float(np.hypot(self.radius, half)))
            angles = np.arange(16) * np.pi / 8
            return [[round(reach * np.cos(it), 4), round(reach * np.sin(it), 4)] for it in angles.tolist()]
        front = max(self.ahead + self.length / 2, self.radius)
        back = min(self.ahead - self.length / 2, -self.radius)
        return [[round(x, 4), round(y, 4)] for x, y in ((front, -half), (front, half), (back, half), (back, -half))]

    def casters(self) -> list[float]:
        """Where casters are, ahead of the axle: on each side on which the body reaches beyond it."""
        ends = (self.ahead - 0.42 * self.length, self.ahead + 0.42 * self.length)
        return [end for end in ends if abs(end) > 0.3 * self.length]

    def write(self, folder: Path) -> Path:
        """Write the URDF, its mesh and the robot file, and return the latter."""
        (folder / "robot.urdf").write_text(self._urdf())
        if self.kind == "mesh":
            (folder / "body.obj").write_text(self._mesh())
        robot = {
            "name": "drawn",
            "footprint": self.footprint(),
            "max_speed": round(self.speed, 3),
            "max_turn_rate": round(4 * self.speed, 3),
            "height": round(self.lift + self.height, 3),
            "urdf": {"file": "robot.urdf", "wheels": ["left", "right"]},
            "lidar": {
                "beams": 180,
                "range": 3.5,
                "min_range": 0.05,
                "mount": [0, 0, round(self.lift + self.height, 3)],
            },
        }
        (folder / "robot.yaml").write_text(json.dumps(robot))
        return folder / "robot.yaml"

    def _urdf(self) -> str:
        base = self.radius  # of the link on the axle, above the floor
        z = self.lift + self.height / 2 - base
        shape = {
            "box": f'<box size="{self.length} {self.width} {self.height}"/>',
            "cylinder": f'<cylinder radius="{self.length / 2}" length="{self.height}"/>',
            "mesh": '<mesh filename="body.obj" scale="0.001 0.001 0.001"/>',
        }[self.kind]
        parts = [
            self._link(
                "base_link", f'<inertial><mass value="{self.mass / 2}"/>{self._inertia(self.mass / 2)}</inertial>'
            )
        ]
        weight = f'<inertial><mass value="{self.mass / 2}"/>{self._inertia(self.mass / 2)}</inertial>'
        parts.append(self._link("body", f"{weight}<collision><geometry>{shape}</geometry></collision>"))
        parts.append(self._joint("body_joint", "fixed", "base_link", "body", f"{self.ahead} 0 {z}"))
        turned = self.wheel == "cylinder turned by its link"
        solid = '<sphere radius="{0}"/>' if self.wheel == "sphere" else '<cylinder radius="{0}" length="0.02"/>'
        rpy = "0 0 0" if turned else "1.570796 0 0"
        for name, side in (("left", 1), ("right", -1)):
            geometry = f'<origin rpy="{rpy}"/><geometry>{solid.format(self.radius)}</geometry>'
            inertia = f'<inertial><mass value="0.3"/>{self._inertia(0.3, self.radius)}</inertial>'
            parts.append(self._link(f"{name}_wheel", f"{inertia}<collision>{geometry}</collision>"))
            place = f"0 {side * self.separation / 2} 0"
            axis, roll = ("0 0 1", "-1.570796 0 0") if turned else ("0 1 0", "0 0 0")
            parts.append(self._joint(name, "continuous", "base_link", f"{name}_wheel", place, axis, roll))
        for number, x in enumerate(self.casters()):
            size = min(self.lift, self.radius, 0.15 * self.length) / 2
            parts.append(
                self._link(f"caster_{number}", f'<collision><geometry><sphere radius="{size}"/></geometry></collision>')
            )
            place = f"{x} 0 {size - base}"
            parts.append(self._joint(f"caster_joint_{number}", "fixed", "base_link", f"caster_{number}", place))
        if self.footprint_link:
            parts.insert(0, self._link("base_footprint", ""))
            parts.append(self._joint("base_joint", "fixed", "base_footprint", "base_link", f"0 0 {base}"))
        return '<robot name="drawn">\n' + "\n".join(parts) + "\n</robot>\n"

    def _mesh(self) -> str:
        """A box with bevelled edges, in millimetres."""
        x, y, z = 500 * self.length, 500 * self.width, 500 * self.height
        outline = [(x, 0.7 * y), (0.8 * x, y), (-0.8 * x, y), (-x, 0.7 * y)]
        outline += [(-px, -py) for px, py in outline]
        lines = [f"v {px} {py} {pz}" for pz in (-z, z) for px, py in outline]
        count = len(outline)
        for corner in range(count):
            after = (corner + 1) % count
            lines.append(f"f {corner + 1} {after + 1} {count + after + 1} {count + corner + 1}")
        lines += [
            "f " + " ".join(map(str, range(count, 0, -1))),
            "f " + " ".join(map(str, range(count + 1, 2 * count + 1))),
        ]
        return "\n".join(lines) + "\n"

    def _inertia(self, mass: float, size: float = 0.2) -> str:
        moment = mass * size**2 / 2
        return f'<inertia ixx="{moment}" iyy="{moment}" izz="{moment}" ixy="0" ixz="0" iyz="0"/>'

    def _link(self, name: str, content: str) -> str:
        return f'<link name="{name}">{content}</link>'

    def _joint(
        self, name: str, kind: str, parent: str, child: str, place: str, axis: str = "0 1 0", rpy: str = "0 0 0"
    ) -> str:
        ends = f'<parent link="{parent}"/><child link="{child}"/>'
        return (
            f'<joint name="{name}" type="{kind}">{ends}<origin xyz="{place}" rpy="{rpy}"/><axis xyz="{axis}"/></joint>'
        )


def drive(seed: int, simulator: str, worlds: list[dict[str, Any]], keep: Path | None) -> tuple[str, str, str | None]:
    """Drive one robot; return what was drawn, the status of the run, and why it failed."""
    random = np.random.default_rng(seed)
    world, robot = worlds[int(random.integers(len(worlds)))], Robot(random)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        settings = {
            **world,
            "name": "drive",
            "fleet": str(robot.write(folder)),
            "scenario": {"plugin": "random", "robots": 1},
            "planner": "astar",
            "controller": "dwb",
            "simulator": simulator,
            "limits": {"execution": "10 min"},
            "seed": seed,
        }
        paths = RunPaths(recording=folder / "run.zip", exports=folder / "exports")
        try:
            record = execute(load_study(settings).runs[0].config, str(seed), paths, lambda *_: None)
            status = str(record.status)
            fault = None if record.status == RunStatus.SUCCEEDED else str(record.error)
        except InputError as error:
            status, fault = "refused", str(error)
        if fault is not None and keep is not None:
            shutil.copytree(folder, keep / str(seed), dirs_exist_ok=True)
    label = (
        f"{world['world']}, {robot.kind}, {robot.wheel}, axle {-robot.ahead / robot.length:+.2f}, {robot.mass:.0f} kg"
    )
    return label, status, fault


def main() -> int:
    """Drive, and print faults."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", type=int)
    parser.add_argument("seed", type=int)
    parser.add_argument("--simulator", default="mujoco")
    parser.add_argument("--buildings", type=Path, help="folder with building files")
    parser.add_argument("--keep", type=Path, help="folder for the robots and recordings of runs with faults")
    given = parser.parse_args()
    files = sorted(given.buildings.rglob("*.building.yaml")) if given.buildings else []
    worlds = [*WORLDS, *({"world": str(file), "roadmap": "graph"} for file in files)]
    statuses: Counter[str] = Counter()
    for seed in range(given.seed, given.seed + given.runs):
        label, status, fault = drive(seed, given.simulator, worlds, given.keep)
        statuses[status] += 1
        if fault is not None:
            print(f"seed {seed} ({label}): {status}: {fault}", flush=True)
    print(f"{given.runs} drives with {given.simulator}: {dict(statuses)}")
    return int(statuses[RunStatus.SUCCEEDED] < given.runs)


if __name__ == "__main__":
    sys.exit(main())
