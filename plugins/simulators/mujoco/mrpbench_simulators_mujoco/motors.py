"""The speed control of wheels: proportional in the physics step, and integral here, as in drives of real robots."""

import mujoco
import numpy as np

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_simulators_bodies.scene import Scene

_RESET_TIME = 0.1
"""seconds in which the integral part takes over a steady error."""
_MOST = 0.02
"""The integral part as a share of the highest speed of the wheel."""


class Motors:
    """Holds the speeds of wheels. The integral part works at a steady speed only, and not at the limit of the torque."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, scene: Scene, wheel: Int) -> None:
        """`wheel` i8[2n] are the indices of the wheels' speeds."""
        self._wheel, self._data = wheel, data
        self._limit = 0.999 * model.actuator_forcerange[:, 1]
        speed = np.array([robot.max_speed / robot.wheel_radius for robot in scene.robots])
        self._most = np.repeat(_MOST * speed, 2)
        self._share = scene.timestep / _RESET_TIME
        self._target, self._integral = np.zeros(len(wheel)), np.zeros(len(wheel))
        self._steady = np.ones(len(wheel), bool)

    def set(self, robots: Int, speed: Float) -> None:
        """Set the speeds f8[k,2] of the wheels of robots, rad/s."""
        self._target.reshape(-1, 2)[robots] = speed
        self._steady.reshape(-1, 2)[robots] = False

    def before_step(self) -> None:
        """Set the reference of each motor for the next physics step."""
        error = self._target - self._data.qvel[self._wheel]
        works = self._steady & (np.abs(self._data.actuator_force) < self._limit)
        self._integral += works * self._share * error
        self._integral = np.clip(self._integral, -self._most, self._most) * (self._target != 0)
        self._data.ctrl[:] = self._target + self._integral
        self._steady[:] = True
