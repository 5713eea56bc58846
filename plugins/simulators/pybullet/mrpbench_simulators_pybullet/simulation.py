"""A PyBullet world in motion."""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from mrpbench_core.api import Simulation
from mrpbench_core.model.arrays import Float, Int16
from mrpbench_core.model.execution import Inputs, ScanBatch, State
from mrpbench_core.model.facilities import Facilities
from mrpbench_core.model.fleet import Fleet
from mrpbench_core.model.scan_schedule import ScanSchedule
from mrpbench_core.model.storeys import Storeys
from mrpbench_core.model.world import World
from mrpbench_simulators_pybullet.bullet import Bullet, Group, quiet
from mrpbench_simulators_pybullet.leaves import Leaves
from mrpbench_simulators_pybullet.lidar import Lidars
from mrpbench_simulators_pybullet.robot import build_robot, motor_torque
from mrpbench_simulators_pybullet.walls import build_walls

if TYPE_CHECKING:
    from mrpbench_simulators_pybullet.simulator import PyBullet

_MOVER_HEIGHT = 1.7
_NEAR = 0.2
"""Metres from a robot beyond which no leaf is asked whether it touches one."""


class BulletSimulation(Simulation):
    """Robots, walls and movers in a Bullet world of their own."""

    def __init__(
        self,
        options: "PyBullet",
        world: World,
        fleet: Fleet,
        placements: Float,
        period: float,
        movers: Sequence[float] = (),
        levels: Int16 | None = None,
    ) -> None:
        self._fleet, self._period, self._periods = fleet, period, 0
        self._substeps = max(1, round(period / options.timestep))
        self._timestep = period / self._substeps
        self._schedule = ScanSchedule(fleet, period)
        reach = max((lidar.range + math.hypot(*lidar.mount[:2]) for lidar in self._schedule.lidars), default=0.0)
        self._storeys, self._facilities = Storeys(world, reach), Facilities(world)
        self._doing = self._facilities.initial()
        self._level: Int16 = np.zeros(len(fleet), np.int16) if levels is None else np.array(levels, np.int16)
        self._bullet = bullet = Bullet()
        with quiet():
            bullet.setGravity(0, 0, -9.81)
            bullet.setPhysicsEngineParameter(
                fixedTimeStep=self._timestep,
                numSolverIterations=options.iterations,
                deterministicOverlappingPairs=1,
            )
            ground = bullet.body(Group.GROUND, bullet.createCollisionShape(bullet.module.GEOM_PLANE))
            bullet.changeDynamics(ground, -1, lateralFriction=1, restitution=0)
            self._walls = build_walls(bullet, self._storeys.segments)
            self._leaves = Leaves(bullet, self._facilities, self._storeys, self._doing)
            poses = self._storeys.spread(np.asarray(placements, float).reshape(-1, 3), self._level).tolist()
            self._robots = [build_robot(bullet, robot, *pose) for robot, pose in zip(fleet.robots, poses, strict=True)]
            self._movers = [self._build_mover(radius) for radius in movers]
            self._lidars = Lidars(bullet, fleet)
        self._index = {body: robot for robot, body in enumerate(self._robots)}
        self._torque = [[motor_torque(robot)] * 2 for robot in fleet.robots]
        self._limit = np.array([(robot.max_speed, robot.max_turn_rate) for robot in fleet.robots])
        self._ramp = self._timestep * np.array(
            [(robot.acceleration, robot.turn_acceleration) for robot in fleet.robots]
        )
        # Turns of the left and the right wheel per metre driven and per radian turned.
        self._per_metre = np.array([1 / robot.wheel_radius for robot in fleet.robots])
        self._per_radian = np.array([robot.wheel_separation / 2 / robot.wheel_radius for robot in fleet.robots])
        self._target = np.zeros((len(fleet), 2))
        self._drive(np.arange(len(fleet)))
        self._state = self._observe(set())
        self._scans = self._take_scans()

    @property
    def state(self) -> State:
        """The truth now."""
        return self._state

    def step(self, inputs: Inputs) -> State:
        """Advance by one control period."""
        command = np.clip(inputs.twist, -self._limit, self._limit)
        self._operate(inputs.facilities)
        contacts: set[tuple[int, int]] = set()
        close = self._close_pairs()
        self._touchable = self._leaves.near(self._plane, float(self._fleet.radii.max(initial=0.0)) + _NEAR)
        for substep in range(1, self._substeps + 1):
            change = np.clip(command - self._target, -self._ramp, self._ramp)
            self._target = self._target + change
            self._drive(np.flatnonzero(change.any(axis=1)))
            if inputs.movers is not None:
                self._move(inputs.movers, (self._substeps - substep) * self._timestep)
            self._bullet.stepSimulation()
            self._find_contacts(close, contacts)
        self._periods += 1
        self._state = self._observe(contacts)
        self._scans += self._take_scans()
        return self._state

    def _operate(self, commands: Mapping[str, float]) -> None:
        """Move doors and lifts, and who is in a lift."""
        before, pose, level = self._doing, self._state.pose, self._level
        after = self._facilities.advance(before, commands, self._period, pose, level, self._fleet.radii)
        if after == before:
            return
        self._doing, self._level = after, self._facilities.carried(before, after, pose, level)
        self._leaves.move(after)
        spread = self._storeys.spread(pose, self._level)
        for robot in np.flatnonzero(self._level != level).tolist():
            (_, _, z), orientation = self._bullet.getBasePositionAndOrientation(self._robots[robot])
            x, y = spread[robot, :2].tolist()
            self._bullet.resetBasePositionAndOrientation(self._robots[robot], (x, y, z), orientation)

    def _drive(self, robots: np.ndarray[tuple[int], np.dtype[np.int64]]) -> None:
        """Hand the wheels of some robots their new speed."""
        control = self._bullet.module.VELOCITY_CONTROL
        forward = self._target[:, 0] * self._per_metre
        turn = self._target[:, 1] * self._per_radian
        for robot in robots.tolist():
            self._bullet.setJointMotorControlArray(
                self._robots[robot],
                (0, 1),
                control,
                targetVelocities=(forward[robot] - turn[robot], forward[robot] + turn[robot]),
                forces=self._torque[robot],
            )

    def _build_mover(self, radius: float) -> int:
        shape = self._bullet.createCollisionShape(
            self._bullet.module.GEOM_CYLINDER, radius=radius, height=_MOVER_HEIGHT
        )
        body = self._bullet.body(Group.MOVERS, shape, (0.0, 0.0, -100.0))
        self._bullet.changeDynamics(body, -1, lateralFriction=0, restitution=0)
        return body

    def _move(self, movers: Float, before: float) -> None:
        """Put the movers where they are `before` seconds before the end of the period."""
        for body, (x, y, vx, vy) in zip(self._movers, movers.tolist(), strict=True):
            position = (x - vx * before, y - vy * before, _MOVER_HEIGHT / 2)
            self._bullet.resetBasePositionAndOrientation(body, position, (0.0, 0.0, 0.0, 1.0))

    def _close_pairs(self) -> list[tuple[int, int]]:
        """Robots that could touch each other within a period, with room to spare."""
        place, reach = self._plane, self._fleet.radii + 2 * self._limit[:, 0] * self._period
        first, second = np.triu_indices(len(place), 1)
        gap = place[first] - place[second]
        near = (gap * gap).sum(axis=1) < (reach[first] + reach[second]) ** 2
        return list(zip(first[near].tolist(), second[near].tolist(), strict=True))

    def _find_contacts(self, close: list[tuple[int, int]], contacts: set[tuple[int, int]]) -> None:
        """Add what touches now. Asking by body is cheaper than listing every wheel on the floor."""
        for obstacle in (*self._walls, *self._movers, *self._touchable):
            for point in self._bullet.getContactPoints(bodyA=obstacle):
                if point[8] <= 0:
                    contacts.add((self._index[point[2]], -1))
        for first, second in close:
            for point in self._bullet.getContactPoints(bodyA=self._robots[first], bodyB=self._robots[second]):
                if point[8] <= 0:
                    contacts.add((first, second))

    def _observe(self, contacts: set[tuple[int, int]]) -> State:
        pose, twist = np.empty((len(self._robots), 3)), np.empty((len(self._robots), 2))
        for robot, body in enumerate(self._robots):
            (x, y, _), (qx, qy, qz, qw) = self._bullet.getBasePositionAndOrientation(body)
            (vx, vy, _), (_, _, turn) = self._bullet.getBaseVelocity(body)
            yaw = np.arctan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
            pose[robot] = x, y, yaw
            twist[robot] = vx * np.cos(yaw) + vy * np.sin(yaw), turn
        pairs = np.array(sorted(contacts), np.int32)
        self._plane = pose[:, :2]
        return State(
            pose=self._storeys.gather(pose, self._level),
            twist=twist,
            level=self._level,
            contacts=pairs,
            facilities=self._doing,
        )

    def scans(self) -> tuple[ScanBatch, ...]:
        """Scans taken since the last call."""
        taken, self._scans = self._scans, ()
        return taken

    def _take_scans(self) -> tuple[ScanBatch, ...]:
        stamp = self._periods * self._period
        pose = self._storeys.spread(self._state.pose, self._level)
        return tuple(
            ScanBatch(stamp=stamp, robot=np.array(robots), ranges=self._lidars.scan(lidar, robots, pose))
            for lidar, robots in self._schedule.due(self._periods)
        )

    def close(self) -> None:
        """Give the physics world back."""
        self._bullet.close()
