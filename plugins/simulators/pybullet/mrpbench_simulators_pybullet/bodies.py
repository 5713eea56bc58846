"""Robots as single bodies in the plane: several times faster than wheels, which slip, tilt and rest on the floor.

A body is given the mean speed of each control period and keeps to the plane: nothing pulls it down, it cannot tilt, and
it is put back where contacts have lifted it. Free of contacts it drives the exact arcs of a differential drive with
limits of acceleration; in contacts it is a rigid body with the robot's footprint and mass.
"""

import math

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.common.poses import wrapped
from mrpbench_simulators_pybullet.bullet import Bullet, Group
from mrpbench_simulators_pybullet.robot import body_shape

_PUSHED = 1e-7
"""metres and radians: a body that is farther off its arc than this was pushed."""


class Bodies:
    """A fleet in the plane."""

    def __init__(self, bullet: Bullet, fleet: Fleet, poses: Float, period: float) -> None:
        self._bullet, self._period = bullet, period
        bullet.setGravity(0, 0, 0)
        self.bodies = []
        for robot, (x, y, yaw) in zip(fleet.robots, poses.tolist(), strict=True):
            body = bullet.body(
                Group.BODIES,
                body_shape(bullet, robot),
                (x, y, 0.0),
                baseOrientation=_upright(yaw),
                baseMass=robot.mass,
            )
            inertia = robot.mass * float((robot.footprint**2).sum(axis=1).mean()) / 2
            bullet.changeDynamics(
                body,
                -1,
                localInertiaDiagonal=(0.0, 0.0, inertia),  # in Bullet, 0 is no inverse: nothing tilts it
                lateralFriction=0,
                restitution=0,
                linearDamping=0,
                angularDamping=0,
            )
            self.bodies.append(body)
        self._acceleration = np.array([(robot.acceleration, robot.turn_acceleration) for robot in fleet.robots])
        self._pose = np.array(poses, float)
        self._twist = np.zeros((len(fleet), 2))
        self._expected = self._pose

    def command(self, twist: Float) -> None:
        """Set the twists f8[n,2], within the limits of the robots, for one control period."""
        way = self._acceleration * self._period
        change = np.clip(twist - self._twist, -way, way)
        # Mean over the period of a speed that changes at full acceleration until it is reached, and then stays.
        mean = self._twist + change - change * np.abs(change) / (2 * way)
        self._twist = self._twist + change
        turn = mean[:, 1] * self._period
        speed, heading = mean[:, 0] * np.sinc(turn / (2 * np.pi)), self._pose[:, 2] + turn / 2
        velocity = np.column_stack([speed * np.cos(heading), speed * np.sin(heading)])
        self._expected = self._pose + np.column_stack([velocity * self._period, turn])
        for body, (vx, vy), rate in zip(self.bodies, velocity.tolist(), mean[:, 1].tolist(), strict=True):
            self._bullet.resetBaseVelocity(body, (vx, vy, 0.0), (0.0, 0.0, rate))

    def before_step(self) -> None:
        """Do nothing: bodies keep their speed."""

    def observe(self) -> tuple[Float, Float]:
        """Return poses f8[n,3] and twists f8[n,2]; a body that was pushed gets the twist of its actual motion."""
        pose = np.empty_like(self._pose)
        for robot, body in enumerate(self.bodies):
            (x, y, _), (_, _, qz, qw) = self._bullet.getBasePositionAndOrientation(body)
            pose[robot] = x, y, 2 * math.atan2(qz, qw)
        pose[:, 2] = wrapped(pose[:, 2])
        off = pose - self._expected
        off[:, 2] = wrapped(off[:, 2])
        for robot in np.flatnonzero((np.abs(off) > _PUSHED).any(axis=1)).tolist():
            self._flatten(robot, pose[robot])
            step = pose[robot] - self._pose[robot]
            turn = float(wrapped(step[2]))
            heading = self._pose[robot, 2] + turn / 2
            ahead = step[0] * math.cos(heading) + step[1] * math.sin(heading)
            self._twist[robot] = ahead / self._period, turn / self._period
        self._pose = self._expected = pose
        return pose, self._twist.copy()

    def place(self, robot: int, x: float, y: float) -> None:
        """Move a robot to x, y, with the yaw that it has."""
        self._pose[robot, :2] = x, y
        self._flatten(robot, self._pose[robot])

    def _flatten(self, robot: int, pose: Float) -> None:
        x, y, yaw = pose.tolist()
        self._bullet.resetBasePositionAndOrientation(self.bodies[robot], (x, y, 0.0), _upright(yaw))


def _upright(yaw: float) -> tuple[float, float, float, float]:
    return 0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)
