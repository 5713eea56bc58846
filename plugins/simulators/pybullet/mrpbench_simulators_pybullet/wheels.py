"""Robots on driven wheels: velocity motors that follow the command as fast as the robots' limits allow."""

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet, RobotModel
from mrpbench_simulators_pybullet.bullet import Bullet, Group
from mrpbench_simulators_pybullet.robot import build_robot, motor_torque
from mrpbench_simulators_pybullet.urdf import load_described
from mrpbench_simulators_pybullet.wheeled_body import WheeledBody


class Wheels:
    """A fleet on the floor. Observed poses and twists are those of the bodies, wheel slip included."""

    def __init__(self, bullet: Bullet, fleet: Fleet, poses: Float, timestep: float) -> None:
        self._bullet = bullet
        bullet.setGravity(0, 0, -9.81)
        ground = bullet.body(Group.GROUND, bullet.createCollisionShape(bullet.module.GEOM_PLANE))
        bullet.changeDynamics(ground, -1, lateralFriction=1, restitution=0)
        robots = fleet.robots
        self._driven = [self._build(robot, *pose) for robot, pose in zip(robots, poses.tolist(), strict=True)]
        self.bodies = [robot.body for robot in self._driven]
        self._torque = [[motor_torque(robot)] * 2 for robot in robots]
        self._ramp = timestep * np.array([(robot.acceleration, robot.turn_acceleration) for robot in robots])
        # Turns of the left and the right wheel per metre driven and per radian turned.
        self._per_metre = np.array([1 / robot.wheel_radius for robot in robots])
        self._per_radian = np.array([robot.wheel_separation / 2 / robot.wheel_radius for robot in robots])
        self._command = self._target = np.zeros((len(robots), 2))
        self._reached = False
        self._drive(np.arange(len(robots)))

    def _build(self, robot: RobotModel, x: float, y: float, yaw: float) -> WheeledBody:
        if robot.urdf is None:
            return build_robot(self._bullet, robot, x, y, yaw)
        return load_described(self._bullet, robot, robot.urdf, x, y, yaw)

    def command(self, twist: Float) -> None:
        """Set the twists f8[n,2], within the limits of the robots, from now on."""
        self._command, self._reached = twist, False

    def before_step(self) -> None:
        """Set the speeds of the motors for the next physics step."""
        if self._reached:
            return
        change = np.clip(self._command - self._target, -self._ramp, self._ramp)
        self._target = self._target + change
        changed = np.flatnonzero(change.any(axis=1))
        self._reached = not len(changed)
        self._drive(changed)

    def _drive(self, robots: np.ndarray[tuple[int], np.dtype[np.int64]]) -> None:
        control = self._bullet.module.VELOCITY_CONTROL
        forward = self._target[:, 0] * self._per_metre
        turn = self._target[:, 1] * self._per_radian
        for robot in robots.tolist():
            driven = self._driven[robot]
            left, right = driven.signs
            self._bullet.setJointMotorControlArray(
                driven.body,
                driven.joints,
                control,
                targetVelocities=(left * (forward[robot] - turn[robot]), right * (forward[robot] + turn[robot])),
                forces=self._torque[robot],
            )

    def observe(self) -> tuple[Float, Float]:
        """Return poses f8[n,3] and twists f8[n,2]."""
        pose, twist = np.empty((len(self.bodies), 3)), np.empty((len(self.bodies), 2))
        for robot, driven in enumerate(self._driven):
            (x, y, z), (qx, qy, qz, qw) = self._bullet.getBasePositionAndOrientation(driven.body)
            (vx, vy, _), (_, _, turn) = self._bullet.getBaseVelocity(driven.body)
            if driven.base is not None:
                before = x, y
                (x, y, _), (qx, qy, qz, qw) = self._bullet.multiplyTransforms((x, y, z), (qx, qy, qz, qw), *driven.base)
                vx, vy = vx - turn * (y - before[1]), vy + turn * (x - before[0])
            yaw = np.arctan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
            pose[robot] = x, y, yaw
            twist[robot] = vx * np.cos(yaw) + vy * np.sin(yaw), turn
        return pose, twist

    def place(self, robot: int, x: float, y: float) -> None:
        """Move a robot to x, y, with the yaw that it has."""
        pose, _ = self.observe()
        (at_x, at_y, z), orientation = self._bullet.getBasePositionAndOrientation(self.bodies[robot])
        there = (at_x + x - pose[robot, 0], at_y + y - pose[robot, 1], z)
        self._bullet.resetBasePositionAndOrientation(self.bodies[robot], there, orientation)
