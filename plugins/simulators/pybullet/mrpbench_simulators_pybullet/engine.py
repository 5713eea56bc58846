"""Moves a scene by PyBullet, step by step."""

import math

import numpy as np
from mrpbench_simulators_bodies.engine import BURIED, ContactForces, Engine
from mrpbench_simulators_bodies.scene import MOVER_HEIGHT, Scene

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_simulators_pybullet.bullet import Bullet, Group, quiet
from mrpbench_simulators_pybullet.contacts import FORCE, Contacts
from mrpbench_simulators_pybullet.robots import BulletRobot, build_flat, build_robot, upright
from mrpbench_simulators_pybullet.walls import build_walls

_NEAR = 0.2
"""Metres from a robot within which the leaves of doors are checked for contacts."""
_STRIDE = 0.1
"""Seconds for which two robots may approach each other between checks of who is close."""


class BulletEngine(Engine):
    """A physics server of its own. Robots are multibodies on two wheels, or single bodies that keep to the plane."""

    def __init__(self, scene: Scene, iterations: int) -> None:
        self.bullet = bullet = Bullet()
        self._scene, self._planar = scene, scene.planar
        with quiet():
            bullet.setPhysicsEngineParameter(
                fixedTimeStep=scene.timestep, numSolverIterations=iterations, deterministicOverlappingPairs=1
            )
            bullet.setGravity(0, 0, 0 if scene.planar else -9.81)
            self._walls = build_walls(bullet, scene.segments)
            self._leaves = [self._leaf(leaf.length, leaf.thickness, leaf.height) for leaf in scene.leaves]
            self._wheeled: list[BulletRobot] = []
            if scene.planar:
                pairs = zip(scene.robots, scene.poses, strict=True)
                self.bodies = [build_flat(bullet, model, pose) for model, pose in pairs]
            else:
                ground = self._ground = bullet.body(Group.GROUND, bullet.createCollisionShape(bullet.module.GEOM_PLANE))
                bullet.changeDynamics(ground, -1, lateralFriction=1, restitution=0)
                robots = zip(scene.robots, scene.bodies, scene.poses, strict=True)
                self._wheeled = [build_robot(bullet, *robot) for robot in robots]
                self.bodies = [robot.body for robot in self._wheeled]
            self._movers = [self._mover(radius) for radius in scene.movers]
        self._radius = np.array([robot.radius for robot in scene.robots])
        self._leaf_reach = np.array([leaf.length for leaf in scene.leaves]) / 2
        self._leaf_place = np.zeros((len(scene.leaves), 2))
        speed = np.array([robot.max_speed for robot in scene.robots])
        self._contacts = Contacts(bullet, self.bodies, self._radius + _STRIDE * speed)

    def prepare(self, place: Float) -> None:
        """Find who is near."""
        near = self._near_leaves(place, float(self._radius.max(initial=0.0)) + _NEAR)
        robots = len(self.bodies)
        solid = [(body, -1) for body in (*self._walls, *near)]
        self._contacts.begin(place, solid + [(body, robots + j) for j, body in enumerate(self._movers)])

    def advance(self) -> None:
        """Do one physics step."""
        self.bullet.stepSimulation()

    def contacts(self) -> ContactForces:
        """Who touched in the last step, and how hard."""
        return self._contacts.collect()

    def observe(self) -> tuple[Float, Float]:
        """Poses f8[n,3] and twists f8[n,2]."""
        pose, twist = np.empty((len(self.bodies), 3)), np.empty((len(self.bodies), 2))
        for robot, body in enumerate(self.bodies):
            centre, orientation = self.bullet.getBasePositionAndOrientation(body)
            (vx, vy, _), (_, _, turn) = self.bullet.getBaseVelocity(body)
            (x, y, _), (qx, qy, qz, qw) = centre, orientation
            if not self._planar:
                (x, y, _), (qx, qy, qz, qw) = self.bullet.multiplyTransforms(
                    centre, orientation, *self._wheeled[robot].base
                )
                vx, vy = vx - turn * (y - centre[1]), vy + turn * (x - centre[0])
            yaw = math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
            pose[robot] = x, y, yaw
            twist[robot] = vx * math.cos(yaw) + vy * math.sin(yaw), turn
        return pose, twist

    def poses(self) -> Float:
        """Poses f8[n,3] alone, which is all that bodies in the plane are asked for."""
        if not self._planar:
            return super().poses()
        states = [self.bullet.getBasePositionAndOrientation(body) for body in self.bodies]
        poses = [
            (x, y, math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz)))
            for (x, y, _), (qx, qy, qz, qw) in states
        ]
        return np.array(poses, float).reshape(-1, 3)

    def weight(self) -> float:
        """Newton with which all robots press on the floor."""
        return float(sum(point[FORCE] for point in self.bullet.getContactPoints(bodyA=self._ground)))

    def place(self, robot: int, x: float, y: float) -> None:
        """Move a robot to x, y."""
        body = self.bodies[robot]
        (at_x, at_y, z), orientation = self.bullet.getBasePositionAndOrientation(body)
        if self._planar:
            _, _, qz, qw = orientation
            self.bullet.resetBasePositionAndOrientation(body, (x, y, 0.0), upright(2 * math.atan2(qz, qw)))
            return
        (base_x, base_y, _), _ = self.bullet.multiplyTransforms(
            (at_x, at_y, z), orientation, *self._wheeled[robot].base
        )
        self.bullet.resetBasePositionAndOrientation(body, (at_x + x - base_x, at_y + y - base_y, z), orientation)

    def turn_wheels(self, robots: Int, speed: Float) -> None:
        """Set the speeds of the motors."""
        control = self.bullet.module.VELOCITY_CONTROL
        for robot, pair in zip(robots.tolist(), speed.tolist(), strict=True):
            driven = self._wheeled[robot]
            self.bullet.setJointMotorControlArray(
                driven.body, driven.joints, control, targetVelocities=pair, forces=[driven.torque] * 2
            )

    def move(self, velocity: Float) -> None:
        """Set the velocities of bodies in the plane."""
        for body, (vx, vy, turn) in zip(self.bodies, velocity.tolist(), strict=True):
            self.bullet.resetBaseVelocity(body, (vx, vy, 0.0), (0.0, 0.0, turn))

    def place_leaves(self, pose: Float) -> None:
        """Put the leaves of doors at f8[k,3]."""
        self._leaf_place = pose[:, :2]
        for body, leaf, (x, y, yaw) in zip(self._leaves, self._scene.leaves, pose.tolist(), strict=True):
            self.bullet.resetBasePositionAndOrientation(body, (x, y, leaf.height / 2), upright(yaw))

    def place_movers(self, place: Float) -> None:
        """Put movers at f8[m,2]."""
        for body, (x, y) in zip(self._movers, place.tolist(), strict=True):
            there = (x, y, MOVER_HEIGHT / 2) if math.isfinite(x) and math.isfinite(y) else (0.0, 0.0, BURIED)
            self.bullet.resetBasePositionAndOrientation(body, there, upright(0.0))

    def close(self) -> None:
        """Disconnect."""
        self.bullet.close()

    def _leaf(self, length: float, thickness: float, height: float) -> int:
        half = [length / 2, thickness / 2, height / 2]
        return self._smooth(
            Group.WALLS, self.bullet.createCollisionShape(self.bullet.module.GEOM_BOX, halfExtents=half)
        )

    def _mover(self, radius: float) -> int:
        cylinder = self.bullet.module.GEOM_CYLINDER
        return self._smooth(
            Group.MOVERS, self.bullet.createCollisionShape(cylinder, radius=radius, height=MOVER_HEIGHT)
        )

    def _smooth(self, group: Group, shape: int) -> int:
        body = self.bullet.body(group, shape, (0.0, 0.0, BURIED))
        self.bullet.changeDynamics(body, -1, lateralFriction=0, restitution=0)
        return body

    def _near_leaves(self, place: Float, reach: float) -> list[int]:
        """The bodies of leaves within `reach` metres of any point f8[n,2] of the plane."""
        if not self._leaves or not len(place):
            return []
        gap = np.hypot(*(self._leaf_place[:, None] - place).transpose(2, 0, 1)).min(axis=1) - self._leaf_reach
        return [self._leaves[index] for index in np.flatnonzero(gap <= reach).tolist()]
