"""A differential-drive robot: a body, and two driven wheels.

The wheels are spheres: they touch the floor in one point, which is faster and much more accurate in turns than a
cylinder, whose contact wanders over its width. They touch nothing but the floor. The body is the footprint, raised. It
has no friction and can rest on the floor at its front and rear, where a real robot has its casters; its weight is over
the axle.
"""

import math

from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_simulators_pybullet.bullet import Bullet, Group
from mrpbench_simulators_pybullet.wheeled_body import WheeledBody

_CLEARANCE = 0.01
"""metres between body and floor."""
_MARGIN = 0.001
"""metres that Bullet adds around a convex hull."""
_PLAY = 0.0005
"""metres between floor and casters when the robot is level, so that the wheels bear the weight."""
_WHEEL_SHARE = 0.1
"""Mass of one wheel as a share of the robot's, as in the TurtleBot3's model for Gazebo; light wheels err more."""
_GRAVITY = 9.81


def build_robot(bullet: Bullet, robot: RobotModel, x: float, y: float, yaw: float) -> WheeledBody:
    """Put a robot on the floor. Link 0 is its left wheel, link 1 its right; its frame is in the middle of the axle."""
    module, radius = bullet.module, robot.wheel_radius
    body = bullet.createCollisionShape(module.GEOM_MESH, vertices=_hull(robot))
    wheel = bullet.createCollisionShape(module.GEOM_SPHERE, radius=radius)
    half = robot.wheel_separation / 2
    identity = [0.0, 0.0, 0.0, 1.0]
    index = bullet.body(
        Group.BODIES,
        body,
        (x, y, radius),
        baseOrientation=[0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)],
        baseMass=robot.mass * (1 - 2 * _WHEEL_SHARE),
        linkMasses=[robot.mass * _WHEEL_SHARE] * 2,
        linkCollisionShapeIndices=[wheel, wheel],
        linkVisualShapeIndices=[-1, -1],
        linkPositions=[[0.0, half, 0.0], [0.0, -half, 0.0]],
        linkOrientations=[identity, identity],
        linkInertialFramePositions=[[0.0, 0.0, 0.0]] * 2,
        linkInertialFrameOrientations=[identity, identity],
        linkParentIndices=[0, 0],
        linkJointTypes=[module.JOINT_REVOLUTE] * 2,
        linkJointAxis=[[0.0, 1.0, 0.0]] * 2,
    )
    common = {"restitution": 0, "linearDamping": 0, "angularDamping": 0}
    # Without a threshold, points that nearly touch take the solver's time too.
    bullet.changeDynamics(index, -1, lateralFriction=0, contactProcessingThreshold=0, **common)
    for link in (0, 1):
        bullet.assign(index, link, Group.WHEELS)
        bullet.changeDynamics(index, link, lateralFriction=1, jointDamping=0, **common)
    return WheeledBody(body=index)


def body_shape(bullet: Bullet, robot: RobotModel) -> int:
    """The footprint as a prism that stands on the floor."""
    corners = [[x, y, z] for x, y in robot.footprint.tolist() for z in (0.0, robot.height)]
    shape: int = bullet.createCollisionShape(bullet.module.GEOM_MESH, vertices=corners)
    return shape


def motor_torque(robot: RobotModel) -> float:
    """The highest torque of a motor, N m: enough to make a wheel slip that bears the whole weight."""
    return robot.mass * _GRAVITY * robot.wheel_radius


def _hull(robot: RobotModel) -> list[list[float]]:
    """Corners of the body about the middle of the axle: the footprint raised, and the points it glides on."""
    floor, low, high = (height - robot.wheel_radius for height in (0.0, _CLEARANCE, robot.height))
    footprint = robot.footprint.tolist()
    front, rear = max(x for x, _ in footprint), min(x for x, _ in footprint)
    glides = [[end * 0.9, 0.0, floor + _MARGIN + _PLAY] for end in (front, rear)]
    return [[x, y, z] for x, y in footprint for z in (low, high)] + glides
