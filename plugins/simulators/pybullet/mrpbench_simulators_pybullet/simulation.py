"""A PyBullet world in motion."""

import math
from collections.abc import Mapping, Sequence
from typing import Literal

import attrs
import numpy as np

from mrpbench_core.api import Simulation
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.common.fleet import Fleet, Lidar
from mrpbench_core.model.execution.movers import MoverDiscs
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.execution.scan_schedule import ScanSchedule
from mrpbench_core.model.execution.state import Inputs, State
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.model.worlds.level_layout import LevelLayout
from mrpbench_core.model.worlds.world import World
from mrpbench_simulators_pybullet.bodies import Bodies
from mrpbench_simulators_pybullet.bullet import Bullet, Group, quiet
from mrpbench_simulators_pybullet.contacts import ContactPairs, Contacts
from mrpbench_simulators_pybullet.leaves import Leaves
from mrpbench_simulators_pybullet.lidar import Casters, RayTests
from mrpbench_simulators_pybullet.walls import build_walls
from mrpbench_simulators_pybullet.wheels import Wheels

_TIMESTEP = {"wheels": 1 / 240, "body": 1 / 60}
_MOVER_HEIGHT = 1.7
_NEAR = 0.2
"""Metres from a robot within which the leaves of doors are checked for contacts."""


@attrs.frozen(kw_only=True)
class PhysicsOptions:
    """The options of the simulator `pybullet`, by their names."""

    timestep: float | None
    iterations: int
    model: Literal["wheels", "body"]
    lidar: Literal["native", "pybullet"]


class BulletSimulation(Simulation):
    """Robots, walls and movers in a Bullet world of their own; arguments as in `Simulator.open`."""

    def __init__(
        self,
        options: PhysicsOptions,
        world: World,
        fleet: Fleet,
        placements: Float,
        period: float,
        movers: Sequence[float] = (),
        levels: Int16 | None = None,
    ) -> None:
        self._radius, self._period, self._periods = fleet.radii, period, 0
        self._substeps = max(1, round(period / (options.timestep or _TIMESTEP[options.model])))
        self._timestep = period / self._substeps
        self._schedule = ScanSchedule(fleet, period)
        reach = max((lidar.range + math.hypot(*lidar.mount[:2]) for lidar in self._schedule.lidars), default=0.0)
        self._layout, self._facilities = LevelLayout(world, reach), Facilities(world)
        self._doing = self._facilities.initial_state()
        self._outlines = self._layout.door_outlines(self._facilities, self._doing)
        self._level: Int16 = np.zeros(len(fleet), np.int16) if levels is None else np.array(levels, np.int16)
        self._limit = np.array([(robot.max_speed, robot.max_turn_rate) for robot in fleet.robots]).reshape(-1, 2)
        self._discs = MoverDiscs(self._layout, np.asarray(movers, float))
        self._bullet = bullet = Bullet()
        with quiet():
            bullet.setPhysicsEngineParameter(
                fixedTimeStep=self._timestep,
                numSolverIterations=options.iterations,
                deterministicOverlappingPairs=1,
            )
            self._walls = build_walls(bullet, self._layout.segments)
            self._leaves = Leaves(bullet, self._facilities, self._layout, self._doing)
            poses = self._layout.to_plane(np.asarray(placements, float).reshape(-1, 3), self._level)
            self._robots: Wheels | Bodies
            if options.model == "wheels":
                self._robots = Wheels(bullet, fleet, poses, self._timestep)
            else:
                self._robots = Bodies(bullet, fleet, poses, period)
            self._movers = [self._build_mover(radius) for radius in movers]
            self._rays = RayTests(bullet, fleet) if options.lidar == "pybullet" else None
        self._casters = Casters(self._schedule.lidars, self._layout.segments)
        self._contacts = Contacts(bullet, self._robots.bodies, self._radius + 2 * self._limit[:, 0] * period)
        self._state = self._observe(set())
        self._scans = self._take_scans()

    @property
    def state(self) -> State:
        """The true state now."""
        return self._state

    def step(self, inputs: Inputs) -> State:
        """Advance by one control period."""
        if inputs.facilities:
            self._operate(inputs.facilities)
        self._discs.update(inputs)
        near = self._leaves.near(self._plane[:, :2], float(self._radius.max(initial=0.0)) + _NEAR)
        robots = len(self._radius)
        solid = [(body, -1) for body in (*self._walls, *near)]
        self._contacts.begin(self._plane[:, :2], solid + [(body, robots + j) for j, body in enumerate(self._movers)])
        self._robots.command(np.clip(inputs.twist, -self._limit, self._limit))
        for substep in range(1, self._substeps + 1):
            self._robots.before_step()
            if inputs.movers is not None:
                self._move(inputs.movers[:, 2:], (self._substeps - substep) * self._timestep)
            self._bullet.stepSimulation()
            self._contacts.collect()
        self._periods += 1
        self._state = self._observe(self._contacts.found)
        self._scans += self._take_scans()
        return self._state

    def _operate(self, commands: Mapping[str, float]) -> None:
        """Move doors and lifts, and the robots in lifts."""
        before, pose, level = self._doing, self._state.pose, self._level
        after = self._facilities.advance(before, commands, self._period, *self._discs.among(pose, level, self._radius))
        if after == before:
            return
        self._doing, self._level = after, self._facilities.carry(before, after, pose, level)
        self._leaves.move(after)
        self._outlines = self._layout.door_outlines(self._facilities, after)
        spread = self._layout.to_plane(pose, self._level)
        for robot in np.flatnonzero(self._level != level).tolist():
            self._robots.place(robot, *spread[robot, :2].tolist())

    def _build_mover(self, radius: float) -> int:
        shape = self._bullet.createCollisionShape(
            self._bullet.module.GEOM_CYLINDER, radius=radius, height=_MOVER_HEIGHT
        )
        body = self._bullet.body(Group.MOVERS, shape, (0.0, 0.0, -100.0))
        self._bullet.changeDynamics(body, -1, lateralFriction=0, restitution=0)
        return body

    def _move(self, velocity: Float, before: float) -> None:
        """Put the movers where they are `before` seconds before the end of the period."""
        places = np.hstack([self._discs.body, velocity]).tolist()
        for body, (x, y, vx, vy) in zip(self._movers, places, strict=True):
            position = (x - vx * before, y - vy * before, _MOVER_HEIGHT / 2)
            self._bullet.resetBasePositionAndOrientation(body, position, (0.0, 0.0, 0.0, 1.0))

    def _observe(self, contacts: ContactPairs) -> State:
        self._plane, twist = self._robots.observe()
        return State(
            pose=self._layout.to_levels(self._plane, self._level),
            twist=twist,
            level=self._level,
            contacts=np.array(sorted(contacts), np.int32),
            facilities=self._doing,
        )

    def scans(self) -> tuple[ScanBatch, ...]:
        """Scans taken since the last call."""
        taken, self._scans = self._scans, ()
        return taken

    def _take_scans(self) -> tuple[ScanBatch, ...]:
        stamp = self._periods * self._period
        return tuple(
            ScanBatch(stamp=stamp, robot=np.array(robots), ranges=self._scan(lidar, robots))
            for lidar, robots in self._schedule.due(self._periods)
        )

    def _scan(self, lidar: Lidar, robots: Sequence[int]) -> Float:
        if self._rays is not None:
            return self._rays.scan(lidar, robots, self._plane, self._discs)
        radius = np.concatenate([self._radius, self._discs.seen_radius])
        seen = np.ascontiguousarray(self._discs.seen)
        return self._casters.scan(lidar, robots, self._plane, seen, radius, self._outlines)

    def close(self) -> None:
        """Close the physics world."""
        self._bullet.close()
