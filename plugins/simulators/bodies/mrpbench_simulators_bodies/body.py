"""Robots as rigid bodies: shapes, masses and two driven wheels, in the robot's base frame.

The wheels are spheres: they touch the floor in one point, which is faster and much more accurate in turns than a
cylinder, whose contact wanders over its width. They touch nothing but the floor. All other shapes have no friction, so
that casters glide.
"""

import math
from typing import Literal

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel

CLEARANCE = 0.01
"""metres between the floor and the body of a robot without a URDF."""
PLAY = 0.0005
"""metres between floor and casters when a robot is level, so that its wheels bear the weight."""
ROTOR = 0.5
"""Inertia of a motor behind its gear, as a share of that of the whole mass at the rim of its wheel."""
MOTOR_LAG = 0.01
"""seconds in which a motor that bears the whole mass approaches its speed, unless its torque is at its limit."""
WHEEL_CONTACT = (0.02, 1.0), (0.999, 0.999, 0.001, 0.5, 2.0)
"""Time constant (s) and damping ratio, and impedance of MuJoCo: so stiff that speeds err by less than a thousandth."""
_WHEEL_SHARE = 0.1
"""Mass of one wheel as a share of such a robot's, as in the TurtleBot3's model for Gazebo; light wheels err more."""
_GRAVITY = 9.81
_SIDES = 32
"""Sides of the prisms that stand for cylinders, and of the circles of spheres, where points are needed."""
_DIRECTIONS = 2000
"""Directions in which the outermost points of a hull are kept, which moves its surface by a thousandth of its size."""
_FLAT = 5e-4
"""metres to both sides by which a hull without volume is thickened."""


@attrs.frozen(kw_only=True, eq=False)
class Shape:
    """A convex solid."""

    kind: Literal["box", "sphere", "cylinder", "capsule", "hull"]
    size: tuple[float, ...] = ()
    """metres: the whole sides of a box; radius; radius and length along z; the length of a capsule is that of its
    cylinder."""
    points: Float = attrs.field(factory=lambda: np.empty((0, 3)))
    """f8[k,3] of a hull, metres in its own frame."""
    frame: Float = attrs.field(factory=lambda: np.eye(4))
    """f8[4,4] pose in the robot's base frame."""
    part: str = ""
    """The link or wheel joint of a URDF that it belongs to, for errors."""
    touches_floor: bool = True

    def corners(self) -> Float:
        """Points f8[k,3] in the base frame whose convex hull is the shape, to a two-hundredth of its radius."""
        local = self._own_corners()
        placed: Float = local @ self.frame[:3, :3].T + self.frame[:3, 3]
        return placed

    def _own_corners(self) -> Float:
        if self.kind == "hull":
            return self.points
        if self.kind == "box":
            signs = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
            return signs * self.size
        radius, length = self.size[0], self.size[1] if len(self.size) > 1 else 0.0
        if self.kind == "cylinder":
            return np.concatenate([_ring(radius, -length / 2), _ring(radius, length / 2)])
        lift = np.linspace(-math.pi / 2, math.pi / 2, _SIDES // 2 + 1)
        rings = [
            _ring(radius * math.cos(angle), radius * math.sin(angle) + math.copysign(length / 2, angle))
            for angle in lift.tolist()
        ]
        return np.concatenate([*rings, _ring(radius, -length / 2), _ring(radius, length / 2)])


@attrs.frozen(kw_only=True, eq=False)
class Wheel:
    """A driven wheel that turns about the y axis of the base frame."""

    place: tuple[float, float, float]
    """metres: its middle."""
    radius: float
    mass: float
    inertia: tuple[float, float]
    """kg m²: across its axle and about it."""


@attrs.frozen(kw_only=True, eq=False)
class RobotBody:
    """Everything of a robot that moves as one, and its left and right wheel."""

    shapes: tuple[Shape, ...]
    mass: float
    """kilogram, without the wheels."""
    centre: Float
    """f8[3] centre of mass, metres."""
    inertia: Float
    """f8[3,3] about the centre of mass, kg m²."""
    wheels: tuple[Wheel, Wheel]

    @property
    def torque(self) -> float:
        """The highest torque of a motor, N m: enough to make a wheel slip that bears the whole weight."""
        return (self.mass + sum(wheel.mass for wheel in self.wheels)) * _GRAVITY * self.wheels[0].radius

    def principal(self) -> tuple[Float, Float]:
        """Principal moments f8[3], kg m², and their axes f8[3,3] as columns of a rotation."""
        moments, axes = np.linalg.eigh(self.inertia)
        if np.linalg.det(axes) < 0:
            axes = axes * (1.0, 1.0, -1.0)
        least = 1e-9 + 1e-6 * self.mass
        moments = np.maximum(moments, least)
        if moments[0] + moments[1] < moments[2]:  # of no body; URDFs written by hand have it
            moments = np.full(3, moments.mean())
        return moments, axes


def plain_body(robot: RobotModel) -> RobotBody:
    """A robot without a URDF: its footprint, raised, that can rest on the floor at its front and rear.

    There a real robot has its casters. The weight is over the axle.
    """
    low, high = CLEARANCE, robot.height
    footprint = robot.footprint.tolist()
    front, rear = max(x for x, _ in footprint), min(x for x, _ in footprint)
    glides = [(end * 0.9, 0.0, PLAY) for end in (front, rear)]
    points = np.array([(x, y, z) for x, y in footprint for z in (low, high)] + glides)
    mass, radius = robot.mass * (1 - 2 * _WHEEL_SHARE), robot.wheel_radius
    side = np.array([*np.ptp(robot.footprint, axis=0).tolist(), high - low]) ** 2
    wheel = robot.mass * _WHEEL_SHARE
    moment = 0.4 * wheel * radius**2
    left, right = (
        Wheel(place=(0.0, half, radius), radius=radius, mass=wheel, inertia=(moment, moment))
        for half in (robot.wheel_separation / 2, -robot.wheel_separation / 2)
    )
    return RobotBody(
        shapes=(Shape(kind="hull", points=points, part="body"),),
        mass=mass,
        centre=np.array([0.0, 0.0, radius]),
        inertia=np.diag(mass / 12 * (side.sum() - side)),
        wheels=(left, right),
    )


def prism(footprint: Float, height: float) -> Shape:
    """A footprint f8[k,2] that stands on the floor."""
    return Shape(kind="hull", points=np.array([(x, y, z) for x, y in footprint.tolist() for z in (0.0, height)]))


def hull(points: Float) -> Float:
    """The points of f8[k,3] that decide their convex hull, at most a few thousand, and with some volume."""
    points = np.unique(points, axis=0)
    if len(points) > _DIRECTIONS:
        points = points[np.unique((points @ _directions().T).argmax(axis=0))]
    centred = points - points.mean(axis=0)
    _, spread, axes = np.linalg.svd(centred, full_matrices=True)
    if len(points) < 4 or spread[2] < 1e-4:
        points = np.concatenate([points + side * _FLAT * axis for axis in axes for side in (-1, 1)])
    return points


def _directions() -> Float:
    """Unit vectors f8[k,3] spread evenly over the sphere (a Fibonacci lattice)."""
    index = np.arange(_DIRECTIONS)
    z = 1 - (2 * index + 1) / _DIRECTIONS
    turn = index * (math.pi * (3 - math.sqrt(5)))
    across = np.sqrt(1 - z * z)
    return np.column_stack([across * np.cos(turn), across * np.sin(turn), z])


def _ring(radius: float, z: float) -> Float:
    turn = np.arange(_SIDES) * (2 * math.pi / _SIDES)
    return np.column_stack([radius * np.cos(turn), radius * np.sin(turn), np.full(_SIDES, z)])
