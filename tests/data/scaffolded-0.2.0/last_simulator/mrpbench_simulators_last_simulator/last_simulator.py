"""LastSimulator: discs that follow their commands exactly and stop on contact."""

import math
from collections.abc import Sequence

import attrs
import numpy as np
from mrpbench_core.api import Simulation, Simulator, option
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.common.fleet import Fleet, Lidar
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.execution.scan_schedule import ScanSchedule
from mrpbench_core.model.execution.state import Inputs, State
from mrpbench_core.model.worlds.solids import segments
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class LastSimulator(Simulator):
    """Robots without inertia on level 0."""

    substeps: int = option(4, help="steps in one control period", validator=attrs.validators.ge(1))

    def open(
        self,
        world: World,
        fleet: Fleet,
        placements: Float,
        seed: int,
        period: float,
        movers: Sequence[float] = (),
        levels: Int16 | None = None,
    ) -> Simulation:
        """Place the robots. Nothing is random; doors and lifts are not supported."""
        del seed, levels
        return LastSimulatorSimulation(self.substeps, segments(world), fleet, placements, period, movers)


class LastSimulatorSimulation(Simulation):
    """Robots and movers in motion."""

    def __init__(
        self, substeps: int, walls: Float, fleet: Fleet, placements: Float, period: float, movers: Sequence[float]
    ) -> None:
        self.walls = walls
        self.limit = np.array([(robot.max_speed, robot.max_turn_rate) for robot in fleet.robots]).reshape(-1, 2)
        self.radius = np.concatenate([fleet.radii, movers])
        self.movers = np.full((len(movers), 2), np.inf)
        stride = float(self.radius.min(initial=1.0)) / 4  # a longer step could cross a wall
        self.substeps = max(substeps, math.ceil(period * float(self.limit[:, 0].max(initial=0.0)) / stride))
        self.period, self.periods = period, 0
        self.schedule = ScanSchedule(fleet, period)
        pose = np.array(placements, float).reshape(-1, 3)
        level, nothing = np.zeros(len(pose), "i2"), np.empty((0, 2), "i4")
        self.now = State(pose=pose, twist=np.zeros((len(pose), 2)), level=level, contacts=nothing)
        self.pending = self.due()

    @property
    def state(self) -> State:
        """The current ground truth."""
        return self.now

    def step(self, inputs: Inputs) -> State:
        """Advance by one control period."""
        twist = np.clip(inputs.twist, -self.limit, self.limit)
        if inputs.movers is not None:
            self.movers = inputs.movers[:, :2]
        pose, driven = self.now.pose.copy(), twist.copy()
        contacts: set[tuple[int, int]] = set()
        dt = self.period / self.substeps
        for _ in range(self.substeps):
            for robot, (speed, turn) in enumerate(twist.tolist()):
                heading = pose[robot, 2] + turn * dt / 2
                target = pose[robot, :2] + speed * dt * np.array([np.cos(heading), np.sin(heading)])
                pose[robot, 2] = math.remainder(pose[robot, 2] + turn * dt, math.tau)
                touched = self.touched(robot, pose, target)
                contacts |= {(min(robot, other), max(robot, other)) if other >= 0 else (robot, -1) for other in touched}
                if touched:
                    driven[robot, 0] = 0.0
                else:
                    pose[robot, :2] = target
        self.now = State(pose=pose, twist=driven, level=self.now.level, contacts=np.array(sorted(contacts), "i4"))
        self.periods += 1
        self.pending += self.due()
        return self.now

    def touched(self, robot: int, pose: Float, target: Float) -> set[int]:
        """Return what a robot would touch at `target` and is approaching: robots, movers after them, -1 for walls."""
        others = np.concatenate([pose[:, :2], self.movers])
        reach = self.radius + self.radius[robot]
        after, before = np.hypot(*(others - target).T), np.hypot(*(others - pose[robot, :2]).T)
        near = set(np.flatnonzero((after < reach) & (after < before)).tolist()) - {robot}
        start, end = self.walls[:, :2], self.walls[:, 2:]
        gap = point_segment_distance(target, start, end)
        closer = gap < point_segment_distance(pose[robot, :2], start, end)
        return near | ({-1} if ((gap < self.radius[robot]) & closer).any() else set())

    def scans(self) -> tuple[ScanBatch, ...]:
        """Scans taken since the last call."""
        taken, self.pending = self.pending, ()
        return taken

    def due(self) -> tuple[ScanBatch, ...]:
        """Return the scans that are due now."""
        return tuple(
            ScanBatch(
                stamp=self.periods * self.period,
                robot=np.array(robots, "i4"),
                ranges=np.array([self.scan(lidar, robot) for robot in robots]),
            )
            for lidar, robots in self.schedule.due(self.periods)
        )

    def scan(self, lidar: Lidar, robot: int) -> Float:
        """Return the ranges f8[beams] of one robot."""
        x, y, yaw = self.now.pose[robot]
        forward, left = lidar.mount[:2]
        here = (x + forward * np.cos(yaw) - left * np.sin(yaw), y + forward * np.sin(yaw) + left * np.cos(yaw))
        angle = yaw + np.arange(lidar.beams) * 2 * np.pi / lidar.beams
        beam = np.stack([np.cos(angle), np.sin(angle)], axis=1)[:, None]
        discs = np.delete(np.concatenate([self.now.pose[:, :2], self.movers]), robot, axis=0)
        radius = np.delete(self.radius, robot)
        hits = np.concatenate([to_walls(beam, self.walls, here), to_discs(beam, discs, radius, here)], axis=1)
        nearest = hits.min(axis=1, initial=np.inf)
        seen: Float = np.where(nearest <= lidar.range, np.maximum(nearest, lidar.min_range), np.inf)
        return seen

    def close(self) -> None:
        """Release nothing, because the simulation holds no resources."""


def to_walls(beam: Float, walls: Float, here: tuple[float, float]) -> Float:
    """Return distances f8[beams,S] along unit vectors f8[beams,1,2] to segments f8[S,4], inf = no hit."""
    offset, along = walls[:, :2] - here, walls[:, 2:] - walls[:, :2]
    across = cross(beam, along)
    parallel = np.abs(across) < 1e-12
    divisor = np.where(parallel, 1.0, across)
    distance, share = cross(offset, along) / divisor, cross(offset, beam) / divisor
    missed = parallel | (distance < 0) | (share < 0) | (share > 1)
    return np.where(missed, np.inf, distance)


def to_discs(beam: Float, discs: Float, radius: Float, here: tuple[float, float]) -> Float:
    """Return distances f8[beams,D] to discs; discs without a position are left out."""
    placed = np.isfinite(discs).all(axis=1)
    offset = discs[placed] - here
    along, across = (beam * offset).sum(axis=2), cross(beam, offset)
    half = radius[placed] ** 2 - across**2
    distance = along - np.sqrt(np.maximum(half, 0.0))
    return np.where((half < 0) | (distance < 0), np.inf, distance)


def cross(one: Float, other: Float) -> Float:
    """Return the z component of the cross product of vectors f8[...,2]."""
    product: Float = one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]
    return product
