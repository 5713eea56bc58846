"""Robots: their shape, limits and sensors."""

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float, array

MOST_BEAMS, LEAST_RATE = 100_000, 0.01
"""Bounds of the beams of a lidar and of its scans in a second."""


@attrs.frozen(kw_only=True, cache_hash=True)
class Lidar:
    """A planar scanner. Beam i points at `i * 2*pi / beams` counter-clockwise from straight ahead."""

    beams: int = 360
    range: float = 3.5
    """metres; a beam that hits nothing within this range reads inf."""
    min_range: float = 0.12
    rate: float = 5.0
    """Hz of simulated time."""
    mount: tuple[float, float, float] = (0.0, 0.0, 0.18)
    """x, y, z of the sensor in the robot's base frame, metres."""


@attrs.frozen(kw_only=True)
class Urdf:
    """The URDF of a robot, for simulators that load it."""

    file: str
    """Absolute path."""
    wheels: tuple[str, str]
    """The joints of the left and the right driven wheel."""


@attrs.frozen(kw_only=True)
class RobotModel:
    """A model of robot. The base frame lies on the floor at the centre of rotation, x forward."""

    name: str
    footprint: Float = array("f8", 2)
    """f8[k,2] polygon in the base frame, metres, counter-clockwise."""
    max_speed: float
    """m/s."""
    max_turn_rate: float
    """rad/s."""
    acceleration: float = 2.5
    """m/s^2."""
    turn_acceleration: float = 3.2
    """rad/s^2."""
    height: float = 0.15
    mass: float = 1.0
    """kilogram."""
    wheel_radius: float = 0.033
    wheel_separation: float = 0.16
    lidar: Lidar | None = None
    urdf: Urdf | None = attrs.field(default=None, metadata={"recorded": False})
    """Not part of recordings, because it is a file of this machine."""
    graph: int | None = attrs.field(default=None, metadata={"recorded": False})
    """The RMF navigation graph (`graph_idx`) whose lanes the robot uses; None means all. Not part of recordings."""

    @property
    def radius(self) -> float:
        """Circumscribed radius about the base frame's origin, metres: the disc contains the robot at any yaw."""
        return float(np.hypot(self.footprint[:, 0], self.footprint[:, 1]).max())


@attrs.frozen(kw_only=True)
class Fleet:
    """Robots in order; robot i of every array in this project is `robots[i]`."""

    robots: tuple[RobotModel, ...]

    def __len__(self) -> int:
        return len(self.robots)

    @property
    def radii(self) -> Float:
        """Circumscribed radii f8[n], metres."""
        return np.array([robot.radius for robot in self.robots])

    @property
    def names(self) -> tuple[str, ...]:
        """`robot_0`, `robot_1`, ...: the ROS namespaces."""
        return tuple(f"robot_{index}" for index in range(len(self.robots)))

    @property
    def profiles(self) -> tuple[tuple[RobotModel, ...], tuple[int, ...]]:
        """The distinct robot models in order of first use, and for each robot the index of its model."""
        kinds: list[RobotModel] = []
        index = []
        for robot in self.robots:
            if robot not in kinds:
                kinds.append(robot)
            index.append(kinds.index(robot))
        return tuple(kinds), tuple(index)
