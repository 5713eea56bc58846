"""Lets robots and people meet for long, and judges where the people are after each control period.

    python plugins/crowds/walking/tests/soak_people.py MINUTES [--robots 200] [--people 200] [--controller pure_pursuit]
        [--crowd social_force] [--seed 1]

Robots with lidars serve orders that keep coming in a warehouse with aisles of 2 m. People may overlap walls, one
another and robots by 1 cm. A robot that drives into a person is not a fault; a person that walks into a robot is.
Prints a line per simulated minute. The exit code is 1 if there are faults, or if the memory of the process grows.
"""

import argparse
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Set
from pathlib import Path
from typing import Any

import attrs
import numpy as np
import psutil

from mrpbench_core.api import Crowd, CrowdSession, CrowdView, Movers
from mrpbench_core.checking.clearance import has_clearance
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.runs.status import PLANNED
from mrpbench_core.model.worlds.world import World
from mrpbench_core.store.paths import RunPaths

ALLOWED = 0.01
"""Metres of overlap."""
WARM_UP = 600.0
"""Simulated seconds after which the memory has its size: recordings are written every 256 s."""
GROWTH = 1.05
"""Largest memory at the end relative to that after the warm-up."""


class Verdict:
    """What was found so far."""

    def __init__(self) -> None:
        self.faults: Counter[str] = Counter()
        self.deepest: dict[str, float] = {}
        self.memory: list[tuple[float, int]] = []
        """Simulated seconds and bytes, once a minute."""

    def note(self, kind: str, depth: Float, now: float) -> None:
        """Count the overlaps of `depth` metres that are not allowed, and print the first of each kind."""
        self.deepest[kind] = max(self.deepest.get(kind, 0.0), float(depth.max(initial=0.0)))
        found = int((depth > ALLOWED).sum())
        if found and not self.faults[kind]:
            print(f"first at {now:.2f} s: {kind}, person {int(depth.argmax())}, {depth.max():.3f} m", flush=True)
        self.faults[kind] += found

    def grew(self) -> bool | None:
        """Tell whether the memory kept growing after the warm-up; None = the run is too short to tell."""
        later = [size for when, size in self.memory if when >= WARM_UP]
        return later[-1] > GROWTH * later[0] if len(later) > 1 else None


@attrs.frozen
class Judged(Crowd):
    """A crowd whose members are judged after each period."""

    crowd: Crowd
    verdict: Verdict

    def start(self, world: World, fleet: Fleet, seed: int, seen: CrowdView) -> CrowdSession:
        """Start the crowd."""
        return _Session(self.crowd.start(world, fleet, seed, seen), world, fleet, self.verdict)


class _Session(CrowdSession):
    def __init__(self, session: CrowdSession, world: World, fleet: Fleet, verdict: Verdict) -> None:
        self._session, self._level, self._verdict = session, world.levels[0], verdict
        self.members = session.members
        self._radius, self._robots = np.array([member.radius for member in self.members]), fleet.radii
        self._now, self._began, self._process = 0.0, time.perf_counter(), psutil.Process()

    @property
    def movers(self) -> Movers:
        return self._session.movers

    def wanted_doors(self) -> Set[str]:
        return self._session.wanted_doors()

    def step(self, dt: float, seen: CrowdView) -> Movers:
        """Let the people walk, and judge them."""
        before = self._session.movers.pose[:, :2]
        after = self._session.step(dt, seen)
        self._now += dt
        self._judge(before, after.pose[:, :2], seen.state.pose[:, :2])
        if self._now % 60 < dt:
            self._report()
        return after

    def _judge(self, before: Float, place: Float, robot: Float) -> None:
        reach = self._radius[:, None] + self._radius
        np.fill_diagonal(reach, -np.inf)
        self._verdict.note("person and person", _overlap(place, place, reach).max(axis=1), self._now)
        radius = float(self._radius[0])  # of all
        touches = ~has_clearance(self._level, place, place, radius - ALLOWED)  # a step is too short to skip a wall
        self._verdict.note("person and wall", np.where(touches, radius, 0.0), self._now)
        reach = self._radius[:, None] + self._robots
        then, now = _overlap(before, robot, reach), _overlap(place, robot, reach)
        deeper = np.where(now > np.maximum(then, 0.0), now, 0.0)
        self._verdict.note("person into robot", deeper.max(axis=1), self._now)

    def _report(self) -> None:
        size = self._process.memory_info().rss
        self._verdict.memory.append((self._now, size))
        speed = self._now / (time.perf_counter() - self._began)
        deepest = ", ".join(f"{kind} {1000 * depth:.1f} mm" for kind, depth in self._verdict.deepest.items())
        print(f"{self._now / 60:.0f} min, {speed:.1f} x real time, {size / 1e6:.0f} MB, {deepest}", flush=True)


def _overlap(place: Float, other: Float, reach: Float) -> Float:
    """Metres f8[m,k] by which discs at f8[m,2] and f8[k,2] overlap; below 0 = apart."""
    offset = place[:, None] - other
    overlap: Float = reach - np.hypot(offset[..., 0], offset[..., 1])
    return overlap


def config(given: argparse.Namespace) -> dict[str, Any]:
    """The configuration of the run."""
    side = max(3, round((given.robots / 3) ** 0.5))
    return {
        "name": "people",
        "world": {
            "plugin": "generated_warehouse",
            "shelf_rows": side,
            "shelf_columns": side,
            "shelf_length": 4,
            "resolution": 1.0,
        },
        "roadmap": "grid",
        "scenario": {"plugin": "random", "robots": given.robots},
        "fleet": {"robot": "turtlebot3_burger"},
        "tasks": {"plugin": "closed_pool", "per_robot": 2},
        "assigner": "greedy",
        "planner": {"plugin": "rolling_horizon", "planner": "pibt"},
        "controller": given.controller,
        "simulator": "planar",
        "crowds": {"plugin": given.crowd, "people": given.people, "places": 60, "group_size": 2},
        "limits": {"execution": f"{given.minutes} min", "planning": "10 min", "iterations": 100},
        "recording": {"keep": "none", "rate": 1, "scans": False},
        "metrics": [],
        "seed": given.seed,
    }


def main() -> int:
    """Run, print what is found."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("minutes", type=float, help="simulated")
    parser.add_argument("--robots", type=int, default=200)
    parser.add_argument("--people", type=int, default=200)
    parser.add_argument("--controller", default="pure_pursuit")
    parser.add_argument("--crowd", default="social_force")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    verdict = Verdict()
    (point,) = load_study(config(given)).runs
    judged = attrs.evolve(point.config, crowds=tuple(Judged(crowd, verdict) for crowd in point.config.crowds))
    with tempfile.TemporaryDirectory() as folder:
        paths = RunPaths(recording=Path(folder) / "run.zip", exports=Path(folder) / "exports")
        record = execute(judged, "soak", paths, lambda *_: None)
    faults = ", ".join(f"{count} x {kind}" for kind, count in verdict.faults.items() if count) or "no faults"
    grew = verdict.grew()
    memory = {True: "grew", False: "flat", None: "not judged"}[grew]
    print(f"{record.status} {record.error or ''}: {faults}, memory {memory}")
    return int(verdict.faults.total() > 0 or bool(grew) or record.status not in PLANNED)


if __name__ == "__main__":
    sys.exit(main())
