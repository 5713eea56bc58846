"""Moves a scene by MuJoCo, step by step."""

import mujoco
import numpy as np
from mrpbench_simulators_bodies.engine import BURIED, ContactForces, Engine
from mrpbench_simulators_bodies.scene import MOVER_HEIGHT, Scene

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_simulators_mujoco.model import FLOOR, FREE, PLANAR, Built, build_model
from mrpbench_simulators_mujoco.motors import Motors


class MuJoCoEngine(Engine):
    """A model and its state. Robots are bodies on free joints, or on two slides and a hinge."""

    def __init__(self, scene: Scene, iterations: int) -> None:
        self._planar, self._count = scene.planar, len(scene.robots)
        built: Built = build_model(scene, iterations)
        self._model, self._data = built.model, mujoco.MjData(built.model)
        self._data.qpos[:] = built.start
        self._owner, self._leaf_heights = built.owner, built.leaf_heights
        self._movers, self._leaves = built.movers, built.leaves
        self._axle = np.array([robot.wheel_radius for robot in scene.robots])
        self._coordinates, self._speeds = PLANAR if scene.planar else FREE
        self._positions = self._data.qpos.reshape(self._count, self._coordinates)
        wheels = np.arange(self._count * self._speeds).reshape(self._count, self._speeds)[:, 6:].ravel()
        self._motors = None if scene.planar else Motors(self._model, self._data, scene, wheels)
        self._velocities = self._data.qvel.reshape(self._count, self._speeds)
        self.place_movers(np.full((len(self._movers), 2), np.inf))
        mujoco.mj_forward(self._model, self._data)

    def prepare(self, place: Float) -> None:
        """Let the motors take over steady errors."""
        del place
        if self._motors is not None:
            self._motors.prepare()

    def advance(self) -> None:
        """Do one physics step."""
        mujoco.mj_step(self._model, self._data)

    def contacts(self) -> ContactForces:
        """Who touched in the last step, and how hard."""
        forces: dict[tuple[int, int], float] = {}
        contact = self._data.contact
        first_owner, second_owner = self._owner[contact.geom].T
        counts = (first_owner != FLOOR) & (second_owner != FLOOR)
        if not counts.any():
            return forces
        for row in counts.nonzero()[0].tolist():
            first, second = int(first_owner[row]), int(second_owner[row])
            pair = (second, first) if first < 0 or 0 <= second < first else (first, second)
            address = contact.efc_address[row]
            force = float(self._data.efc_force[address]) if address >= 0 else 0.0  # without friction: the normal force
            forces[pair] = forces.get(pair, 0.0) + force
        return forces

    def observe(self) -> tuple[Float, Float]:
        """Poses f8[n,3] of the floor below the middle of the axles, and twists f8[n,2]."""
        position, velocity = self._positions, self._velocities
        if self._planar:
            pose = position.copy()
            pose[:, 2] = np.arctan2(np.sin(pose[:, 2]), np.cos(pose[:, 2]))
            turn = velocity[:, 2]
        else:
            w, x, y, z = position[:, 3:7].T
            lean = np.column_stack([2 * (x * z + w * y), 2 * (y * z - w * x)])  # of the vertical axis, when it pitches
            place = position[:, :2] + lean * self._axle[:, None]
            pose = np.column_stack([place, np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))])
            turn = velocity[:, 5]
        ahead = velocity[:, 0] * np.cos(pose[:, 2]) + velocity[:, 1] * np.sin(pose[:, 2])
        if not self._planar:
            ahead += velocity[:, 4] * self._axle
        return pose, np.column_stack([ahead, turn])

    def heights(self) -> Float:
        """Heights f8[n] of the base frames above the floor, metres, and 0 for robots that keep to the plane."""
        return np.zeros(self._count) if self._planar else self._positions[:, 2].copy()

    def tilts(self) -> Float:
        """Angles f8[n] between the robots' vertical axes and the vertical, radians."""
        x, y = self._positions[:, 4:6].T
        tilts: Float = np.arccos(np.clip(1 - 2 * (x * x + y * y), -1, 1))
        return tilts

    def velocities(self) -> Float:
        """f8[n,3] of bodies in the plane: m/s along x and y, rad/s."""
        velocity: Float = self._velocities.copy()
        return velocity

    def weight(self) -> float:
        """Newton with which all robots press on the floor."""
        force, total = np.empty(6), 0.0
        for index, pair in enumerate(self._owner[self._data.contact.geom].tolist()):
            if FLOOR in pair:
                mujoco.mj_contactForce(self._model, self._data, index, force)
                total += float(force[0])
        return total

    def place(self, robot: int, x: float, y: float) -> None:
        """Move a robot to x, y."""
        self._positions[robot, :2] = x, y
        if self._planar:
            self._velocities[robot] = 0

    def turn_wheels(self, robots: Int, speed: Float) -> None:
        """Set the speeds of the motors."""
        assert self._motors is not None
        self._motors.set(robots, speed)

    def move(self, velocity: Float) -> None:
        """Set the velocities of bodies in the plane."""
        self._velocities[:] = velocity

    def place_leaves(self, pose: Float) -> None:
        """Put the leaves of doors at f8[k,3]."""
        for body, height, (x, y, yaw) in zip(self._leaves, self._leaf_heights, pose.tolist(), strict=True):
            self._data.mocap_pos[body] = x, y, height / 2
            self._data.mocap_quat[body] = np.cos(yaw / 2), 0.0, 0.0, np.sin(yaw / 2)

    def place_movers(self, place: Float) -> None:
        """Put movers at f8[m,2]."""
        if len(self._movers):
            upright = np.column_stack([place, np.full(len(place), MOVER_HEIGHT / 2)])
            here = np.isfinite(upright).all(axis=1, keepdims=True)
            self._data.mocap_pos[self._movers] = np.where(here, upright, (0.0, 0.0, BURIED))

    def close(self) -> None:
        """Nothing is held outside of Python."""
