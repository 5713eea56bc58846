"""How commands become motion: by the motors of wheels, or as the velocity of a body in the plane."""

from abc import ABC, abstractmethod

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.common.poses import wrapped
from mrpbench_simulators_bodies.engine import Engine
from mrpbench_simulators_bodies.scene import Scene

_PUSHED = 1e-7
"""metres and radians: a body that is farther off its arc than this was pushed."""


class Drive(ABC):
    """A fleet under its commands."""

    @abstractmethod
    def command(self, twist: Float) -> None:
        """Set the twists f8[n,2], within the limits of the robots, for the control period that begins."""

    def before_step(self) -> None:  # noqa: B027 - bodies in the plane keep their speed
        """Prepare the next physics step."""

    @abstractmethod
    def observe(self) -> tuple[Float, Float]:
        """Poses f8[n,3] in the plane and twists f8[n,2]."""

    @abstractmethod
    def place(self, robot: int, x: float, y: float) -> None:
        """Move a robot to x, y, with the yaw that it has."""


class Wheels(Drive):
    """Motors follow the command as fast as the robots' limits allow. Observations include the slip of the wheels."""

    def __init__(self, engine: Engine, scene: Scene) -> None:
        self._engine = engine
        robots = scene.robots
        self._ramp = scene.timestep * np.array([(it.acceleration, it.turn_acceleration) for it in robots])
        # Turns of a wheel per metre driven and per radian turned.
        self._per_metre = np.array([1 / robot.wheel_radius for robot in robots])
        self._per_radian = np.array([robot.wheel_separation / 2 / robot.wheel_radius for robot in robots])
        self._command = self._target = np.zeros((len(robots), 2))
        self._reached = False
        engine.turn_wheels(np.arange(len(robots)), np.zeros((len(robots), 2)))

    def command(self, twist: Float) -> None:
        """Ramp up to the twists f8[n,2]."""
        self._command, self._reached = twist, False

    def before_step(self) -> None:
        """Set the speeds of the motors."""
        if self._reached:
            return
        gap = self._command - self._target
        changed = np.flatnonzero(gap.any(axis=1))
        self._reached = not len(changed)
        if self._reached:
            return
        near = np.abs(gap) <= self._ramp  # the sum of the steps would miss the command by a rounding error
        self._target = np.where(near, self._command, self._target + np.copysign(self._ramp, gap))
        forward = self._target[changed, 0] * self._per_metre[changed]
        turn = self._target[changed, 1] * self._per_radian[changed]
        self._engine.turn_wheels(changed, np.column_stack([forward - turn, forward + turn]))

    def observe(self) -> tuple[Float, Float]:
        """Return what the engine says."""
        return self._engine.observe()

    def place(self, robot: int, x: float, y: float) -> None:
        """Move a robot to x, y."""
        self._engine.place(robot, x, y)


class Plane(Drive):
    """Bodies that are given the mean speed of each control period and keep to the plane.

    Nothing pulls them down, and they cannot tilt. Free of contacts they drive the exact arcs of a differential drive
    with limits of acceleration; in contacts they are rigid bodies with the robots' footprints and masses.
    """

    def __init__(self, engine: Engine, scene: Scene, period: float) -> None:
        self._engine, self._period = engine, period
        self._acceleration = np.array([(it.acceleration, it.turn_acceleration) for it in scene.robots])
        self._pose = self._expected = np.array(scene.poses, float)
        self._twist = np.zeros((len(scene.robots), 2))

    def command(self, twist: Float) -> None:
        """Set the velocities of this period."""
        way = self._acceleration * self._period
        change = np.minimum(np.maximum(twist - self._twist, -way), way)
        # Mean over the period of a speed that changes at full acceleration until it is reached, and then stays.
        mean = self._twist + change - change * np.abs(change) / (2 * way)
        self._twist = self._twist + change
        turn = mean[:, 1] * self._period
        speed, heading = mean[:, 0] * np.sinc(turn / (2 * np.pi)), self._pose[:, 2] + turn / 2
        velocity = np.empty((len(speed), 3))
        velocity[:, 0], velocity[:, 1], velocity[:, 2] = speed * np.cos(heading), speed * np.sin(heading), mean[:, 1]
        self._expected = self._pose + velocity * self._period
        self._engine.move(velocity)

    def observe(self) -> tuple[Float, Float]:
        """A body that was pushed has the twist of its actual motion."""
        pose = self._engine.poses()
        off = pose - self._expected
        off[:, 2] = wrapped(off[:, 2])
        is_off = np.abs(off) > _PUSHED
        if np.count_nonzero(is_off):
            self._stop(is_off.any(axis=1).nonzero()[0], pose)
        self._pose = self._expected = pose
        return pose, self._twist.copy()

    def _stop(self, pushed: Int, pose: Float) -> None:
        """Give robots i8[k] that were pushed to `pose` f8[n,3] the twists of their motion."""
        step = pose - self._pose
        turn = wrapped(step[:, 2])
        heading = self._pose[:, 2] + turn / 2
        ahead = step[:, 0] * np.cos(heading) + step[:, 1] * np.sin(heading)
        self._twist[pushed] = np.column_stack([ahead, turn])[pushed] / self._period
        for robot in pushed.tolist():
            self._engine.place(robot, *pose[robot, :2].tolist())

    def place(self, robot: int, x: float, y: float) -> None:
        """Move a robot to x, y, at rest."""
        self._pose[robot, :2] = x, y
        self._engine.place(robot, x, y)
