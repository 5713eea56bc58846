"""The speed control of wheels: proportional in the physics step, and integral here, as in drives of real robots."""

import mujoco
import numpy as np
from mrpbench_simulators_bodies.scene import Scene

from mrpbench_core.model.common.arrays import Float, Int

_SHARE = 0.3
"""Share of a steady error that the integral part takes over in each control period."""
_MOST = 0.02
"""The integral part as a share of the highest speed of the wheel."""


class Motors:
    """Holds the speeds of wheels. The integral part works at steady speeds, below the limit of the torque."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, scene: Scene, wheel: Int) -> None:
        """`wheel` i8[2n] are the indices of the wheels' speeds."""
        self._wheel, self._data, self._reference = wheel, data, data.ctrl
        self._limit = 0.999 * model.actuator_forcerange[:, 1]
        speed = np.array([robot.max_speed / robot.wheel_radius for robot in scene.robots])
        self._most = np.repeat(_MOST * speed, 2)
        self._target, self._integral = np.zeros(len(wheel)), np.zeros(len(wheel))
        self._steady = np.ones(len(wheel), bool)

    def set(self, robots: Int, speed: Float) -> None:
        """Set the speeds f8[k,2] of the wheels of robots, rad/s."""
        self._target.reshape(-1, 2)[robots] = speed
        self._steady.reshape(-1, 2)[robots] = False
        np.add(self._target, self._integral, out=self._reference)

    def prepare(self) -> None:
        """A control period begins."""
        error = self._target - self._data.qvel[self._wheel]
        works = self._steady & (np.abs(self._data.actuator_force) < self._limit)
        integral = self._integral + works * (_SHARE * error)
        self._integral = np.clip(integral, -self._most, self._most) * (self._target != 0)
        np.add(self._target, self._integral, out=self._reference)
        self._steady[:] = True
