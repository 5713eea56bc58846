"""Robots on driven wheels: velocity motors that follow the command as fast as the robots' limits allow."""

import numpy as np

from mrpbench_core.model.arrays import Float
from mrpbench_core.model.fleet import Fleet
from mrpbench_simulators_pybullet.bullet import Bullet, Group
from mrpbench_simulators_pybullet.robot import build_robot, motor_torque


class Wheels:
    """A fleet on the floor. Poses and twists are exact; where wheels slip, so do the robots."""

    def __init__(self, bullet: Bullet, fleet: Fleet, poses: Float, timestep: float) -> None:
        self._bullet = bullet
        bullet.setGravity(0, 0, -9.81)
        ground = bullet.body(Group.GROUND, bullet.createCollisionShape(bullet.module.GEOM_PLANE))
        bullet.changeDynamics(ground, -1, lateralFriction=1, restitution=0)
        robots = fleet.robots
        self.bodies = [build_robot(bullet, robot, *pose) for robot, pose in zip(robots, poses.tolist(), strict=True)]
        self._torque = [[motor_torque(robot)] * 2 for robot in robots]
        self._ramp = timestep * np.array([(robot.acceleration, robot.turn_acceleration) for robot in robots])
        # Turns of the left and the right wheel per metre driven and per radian turned.
        self._per_metre = np.array([1 / robot.wheel_radius for robot in robots])
        self._per_radian = np.array([robot.wheel_separation / 2 / robot.wheel_radius for robot in robots])
        self._command = self._target = np.zeros((len(robots), 2))
        self._reached = False
        self._drive(np.arange(len(robots)))

    def command(self, twist: Float) -> None:
        """What the robots are to do, f8[n,2] within their limits, from now on."""
        self._command, self._reached = twist, False

    def before_step(self) -> None:
        """Hand the motors their speeds for the next physics step."""
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
            self._bullet.setJointMotorControlArray(
                self.bodies[robot],
                (0, 1),
                control,
                targetVelocities=(forward[robot] - turn[robot], forward[robot] + turn[robot]),
                forces=self._torque[robot],
            )

    def observe(self) -> tuple[Float, Float]:
        """Poses f8[n,3] and twists f8[n,2]."""
        pose, twist = np.empty((len(self.bodies), 3)), np.empty((len(self.bodies), 2))
        for robot, body in enumerate(self.bodies):
            (x, y, _), (qx, qy, qz, qw) = self._bullet.getBasePositionAndOrientation(body)
            (vx, vy, _), (_, _, turn) = self._bullet.getBaseVelocity(body)
            yaw = np.arctan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
            pose[robot] = x, y, yaw
            twist[robot] = vx * np.cos(yaw) + vy * np.sin(yaw), turn
        return pose, twist

    def place(self, robot: int, x: float, y: float) -> None:
        """Put a robot elsewhere as it is."""
        (_, _, z), orientation = self._bullet.getBasePositionAndOrientation(self.bodies[robot])
        self._bullet.resetBasePositionAndOrientation(self.bodies[robot], (x, y, z), orientation)
