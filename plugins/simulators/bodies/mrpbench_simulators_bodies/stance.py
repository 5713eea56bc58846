"""Whether the robot of a URDF stands on its driven wheels, and what else of it touches the floor."""

import math
from pathlib import Path

import attrs
import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_simulators_bodies.body import PLAY, RobotBody, Shape

_WHEEL_ERROR = 0.1
"""Share of its radius by which the mesh of a wheel may reach less or more far down."""
_BELOW = 0.01
"""metres by which shapes may reach into the floor: they are raised."""
_TILT = 0.5
"""radian by which a robot may tilt until it rests on something in front or behind."""
_BALANCED = 0.005
"""metres between the centre of mass and the axle within which a robot may tip to both sides."""


def check_stance(body: RobotBody, robot: RobotModel, file: Path) -> None:
    """Check that the robot rests on its driven wheels, and on casters where its weight is beside the axle.

    Args:
        body: the solid parts of the robot.
        robot: the robot, with a URDF.
        file: its URDF, for errors.

    Raises:
        InputError: the robot would not drive.
    """
    assert robot.urdf is not None
    for name in robot.urdf.wheels:
        _check_wheel(name, body, robot, file)
    for shape in body.shapes:
        if shape.touches_floor and (depth := -_lowest(shape)) > _BELOW:
            hint = "with all other joints at 0, nothing should be lower than the driven wheels"
            raise InputError(f"{shape.part!r} reaches {depth:.3f} m into the floor", file=file, hint=hint)
    resting = [shape.corners() for shape in body.shapes if shape.touches_floor]
    corners = np.concatenate([np.zeros((0, 3)), *resting])
    for side in (1, -1):
        if side * body.centre[0] > -_BALANCED and _tilt(corners, side) > _TILT:
            where = "in front of" if side > 0 else "behind"
            wrong = f"nothing {where} the axle is near the floor, so that the robot tips over"
            raise InputError(wrong, file=file, hint="add the collision shape of a caster")


def above_floor(shapes: tuple[Shape, ...]) -> tuple[Shape, ...]:
    """Raise shapes that touch the floor by up to a centimetre, so that the driven wheels bear the weight.

    Many URDFs have a box down to the floor, which would carry the robot without friction.
    """
    return tuple(_raised(shape, PLAY - _lowest(shape)) if shape.touches_floor else shape for shape in shapes)


def _raised(shape: Shape, height: float) -> Shape:
    if height <= 0:
        return shape
    frame = shape.frame.copy()
    frame[2, 3] += height
    return attrs.evolve(shape, frame=frame)


def _check_wheel(name: str, body: RobotBody, robot: RobotModel, file: Path) -> None:
    """Compare the mesh of a wheel, which has no radius of its own, with the radius that the robot's file gives."""
    meshes = [shape for shape in body.shapes if shape.part == name and shape.kind == "hull"]
    radius = robot.wheel_radius
    lowest = min(map(_lowest, meshes), default=0.0)
    if abs(lowest) > _WHEEL_ERROR * radius:
        wrong = f"the mesh of the wheel {name!r} reaches {radius - lowest:.3g} m down from its axle"
        raise InputError(f"{wrong}, but wheel_radius is {radius:g}", file=file, hint=f"see the file of {robot.name}")


def _lowest(shape: Shape) -> float:
    return float(shape.corners()[:, 2].min())


def _tilt(corners: Float, side: int) -> float:
    """The angle by which a robot tips to the front (1) or the rear (-1) until a point f8[k,3] of it is on the floor."""
    ahead = corners[side * corners[:, 0] > 0]
    angles = np.arctan2(ahead[:, 2], side * ahead[:, 0])
    return float(angles.min(initial=math.pi))
