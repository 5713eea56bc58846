"""Robots in a Bullet world."""

import math

import attrs
import numpy as np
from mrpbench_simulators_bodies.body import RobotBody, Shape, prism

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_simulators_pybullet.bullet import Bullet, Group

_MOST_SHAPES = 120
"""Of a robot: PyBullet takes at most 128 links."""
_MARGIN = 0.001
"""metres that Bullet adds around a convex hull."""
_NO_MASS = 1e-6
_DAMPING = {"restitution": 0, "linearDamping": 0, "angularDamping": 0}


@attrs.frozen(kw_only=True)
class BulletRobot:
    """A body, the joints of its left and right wheel, and the pose of its base frame as Bullet reports the body."""

    body: int
    joints: tuple[int, int]
    base: tuple[tuple[float, ...], tuple[float, ...]]
    """Position and quaternion x, y, z, w in the frame of the centre of mass and the principal axes."""
    torque: float


def build_robot(bullet: Bullet, model: RobotModel, body: RobotBody, pose: Float) -> BulletRobot:
    """Put a robot on wheels at x, y, yaw.

    Raises:
        InputError: it has more shapes than PyBullet takes.
    """
    if len(body.shapes) > _MOST_SHAPES:
        file = model.urdf.file if model.urdf else None
        hint = "use `simulator: mujoco`"
        raise InputError(
            f"has {len(body.shapes)} collision shapes, PyBullet takes {_MOST_SHAPES}", file=file, hint=hint
        )
    module = bullet.module
    x, y, yaw = pose.tolist()
    shapes = [(body_shape(bullet, shape), shape) for shape in body.shapes]
    base = next((index for index, (_, shape) in enumerate(shapes) if shape.touches_floor), None)
    fixed = [pair for index, pair in enumerate(shapes) if index != base]
    wheels = [bullet.createCollisionShape(module.GEOM_SPHERE, radius=wheel.radius) for wheel in body.wheels]
    moments, axes = body.principal()
    centre, turn = body.centre.tolist(), _quaternion(axes)
    places = [wheel.place for wheel in body.wheels] + [(0.0, 0.0, 0.0)] * len(fixed)
    links = len(places)
    identity = [0.0, 0.0, 0.0, 1.0]
    index = bullet.body(
        Group.BODIES,
        -1 if base is None else shapes[base][0],
        (x, y, 0.0),
        baseOrientation=[0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)],
        baseMass=body.mass,
        baseInertialFramePosition=centre,
        baseInertialFrameOrientation=turn,
        linkMasses=[wheel.mass for wheel in body.wheels] + [_NO_MASS] * len(fixed),
        linkCollisionShapeIndices=wheels + [shape for shape, _ in fixed],
        linkVisualShapeIndices=[-1] * links,
        linkPositions=places,
        linkOrientations=[identity] * links,
        linkInertialFramePositions=[[0.0, 0.0, 0.0]] * links,
        linkInertialFrameOrientations=[identity] * links,
        linkParentIndices=[0] * links,
        linkJointTypes=[module.JOINT_REVOLUTE] * 2 + [module.JOINT_FIXED] * len(fixed),
        linkJointAxis=[[0.0, 1.0, 0.0]] * links,
    )
    # Without a threshold, points that nearly touch take the solver's time too.
    smooth = {"lateralFriction": 0, "contactProcessingThreshold": 0, **_DAMPING}
    bullet.changeDynamics(index, -1, localInertiaDiagonal=moments.tolist(), **smooth)
    for link, wheel in enumerate(body.wheels):
        across, about = wheel.inertia
        bullet.assign(index, link, Group.WHEELS)
        bullet.changeDynamics(
            index, link, localInertiaDiagonal=(across, about, across), lateralFriction=1, jointDamping=0, **_DAMPING
        )
    for link, (_, shape) in enumerate(fixed, start=2):
        bullet.assign(index, link, Group.BODIES if shape.touches_floor else Group.GUARDS)
        bullet.changeDynamics(index, link, localInertiaDiagonal=[1e-9] * 3, **smooth)
    frame = bullet.invertTransform(centre, turn)
    return BulletRobot(body=index, joints=(0, 1), base=frame, torque=body.torque)


def build_flat(bullet: Bullet, model: RobotModel, pose: Float) -> int:
    """Put the footprint of a robot at x, y, yaw as a body that keeps to the plane."""
    x, y, yaw = pose.tolist()
    shape = body_shape(bullet, prism(model.footprint, model.height))
    body = bullet.body(Group.BODIES, shape, (x, y, 0.0), baseOrientation=upright(yaw), baseMass=model.mass)
    inertia = model.mass * float((model.footprint**2).sum(axis=1).mean()) / 2
    # Bullet takes an inverse inertia of 0 as one that nothing tilts.
    bullet.changeDynamics(body, -1, localInertiaDiagonal=(0.0, 0.0, inertia), lateralFriction=0, **_DAMPING)
    return body


def body_shape(bullet: Bullet, shape: Shape) -> int:
    """A collision shape in the base frame."""
    module = bullet.module
    kinds = {
        "box": lambda: {"shapeType": module.GEOM_BOX, "halfExtents": [side / 2 for side in shape.size]},
        "sphere": lambda: {"shapeType": module.GEOM_SPHERE, "radius": shape.size[0]},
        "cylinder": lambda: {"shapeType": module.GEOM_CYLINDER, "radius": shape.size[0], "height": shape.size[1]},
        "capsule": lambda: {"shapeType": module.GEOM_CAPSULE, "radius": shape.size[0], "height": shape.size[1]},
        "hull": lambda: {"shapeType": module.GEOM_MESH, "vertices": _within_margin(shape).tolist()},
    }
    made: int = bullet.createCollisionShape(
        **kinds[shape.kind](),
        collisionFramePosition=shape.frame[:3, 3].tolist(),
        collisionFrameOrientation=_quaternion(shape.frame[:3, :3]),
    )
    return made


def _within_margin(shape: Shape) -> Float:
    """The points f8[k,3] of a hull: the lowest are raised by what Bullet adds around it, if they are near the floor."""
    height = shape.corners()[:, 2]
    low = (height > 0) & (height < _MARGIN)
    raised: Float = shape.points + np.outer(low * _MARGIN, shape.frame[2, :3])
    return raised


def upright(yaw: float) -> tuple[float, float, float, float]:
    """The quaternion of a yaw."""
    return 0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)


def _quaternion(turn: Float) -> list[float]:
    """x, y, z, w of a rotation f8[3,3]: by the eigenvector of I. Y. Bar-Itzhack (2000)."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = turn.tolist()
    matrix = np.array(
        [
            (xx - yy - zz, yx + xy, zx + xz, zy - yz),
            (yx + xy, yy - xx - zz, zy + yz, xz - zx),
            (zx + xz, zy + yz, zz - xx - yy, yx - xy),
            (zy - yz, xz - zx, yx - xy, xx + yy + zz),
        ]
    )
    quaternion: list[float] = np.linalg.eigh(matrix)[1][:, 3].tolist()
    return quaternion
