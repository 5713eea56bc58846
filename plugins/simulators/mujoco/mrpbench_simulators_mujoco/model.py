"""Builds the MuJoCo model of a scene.

Contacts are decided by bits: what stands alone touches robots only, robots touch everything, wheels the floor. Robots'
bodies have no friction; wheels have the Coulomb friction of rubber on a floor. Contacts are as stiff as the physics
step allows (https://mujoco.readthedocs.io/en/stable/modeling.html, solver parameters), so that a wheel sinks in by a
few micrometres and rolls on its whole radius.
"""

import math

import attrs
import mujoco
import numpy as np
from mrpbench_simulators_bodies.body import MOTOR_LAG, ROTOR, WHEEL_CONTACT, RobotBody, Shape, prism
from mrpbench_simulators_bodies.engine import BURIED
from mrpbench_simulators_bodies.scene import HEIGHT, MOVER_HEIGHT, Scene

from mrpbench_core.model.common.arrays import Float, Int

FLOOR = -2
"""In `Built.owner`: the floor, and wheels, which touch nothing else."""
FREE, PLANAR = (9, 8), (3, 3)
"""Coordinates and speeds of a robot: a free joint and two wheels; two slides and a hinge."""
_GROUND, _ROBOT, _THING = 1, 2, 4
"""Bits of contacts."""
_BODY_CONTACT = ([0.03, 1.0], [0.6, 0.9, 0.003, 0.5, 2.0])
"""As `WHEEL_CONTACT`, but softer, so that robots that push a wall with slipping wheels do not chatter."""
_KINDS = {
    "box": mujoco.mjtGeom.mjGEOM_BOX,
    "sphere": mujoco.mjtGeom.mjGEOM_SPHERE,
    "cylinder": mujoco.mjtGeom.mjGEOM_CYLINDER,
    "capsule": mujoco.mjtGeom.mjGEOM_CAPSULE,
    "hull": mujoco.mjtGeom.mjGEOM_MESH,
}


@attrs.frozen(kw_only=True)
class Built:
    """A compiled model and where its parts are."""

    model: mujoco.MjModel
    start: Float
    """The coordinates of all robots where they begin."""
    owner: Int
    """For each geom: the index of a robot, the number of robots + the index of a mover, -1 = does not move, FLOOR."""
    movers: Int
    """The index of each mover among the mocap bodies."""
    leaves: Int
    leaf_heights: tuple[float, ...]


def build_model(scene: Scene, iterations: int) -> Built:
    """Compile the model of a scene."""
    builder = _Builder(scene, iterations)
    builder.floor()
    builder.walls()
    builder.robots()
    builder.things()
    return builder.compile()


class _Builder:
    def __init__(self, scene: Scene, iterations: int) -> None:
        self._scene, self._spec = scene, mujoco.MjSpec()
        self._world = self._spec.worldbody
        option = self._spec.option
        option.timestep = scene.timestep
        option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        option.cone = mujoco.mjtCone.mjCONE_PYRAMIDAL
        option.iterations = iterations
        option.gravity = (0.0, 0.0, 0.0 if scene.planar else -9.81)
        self._spec.compiler.autolimits = False
        self._spec.memory = 64 * 2**20 + len(scene.robots) * 2**20
        self._hulls: dict[int, str] = {}
        self._owners: dict[str, int] = {}

    def floor(self) -> None:
        """The floor carries robots; without weight they need none."""
        if not self._scene.planar:
            self._geom(self._world, FLOOR, type=_PLANE, size=[0, 0, 1], condim=3, contype=_GROUND, conaffinity=0)

    def walls(self) -> None:
        """Prisms of the height of walls."""
        for polygon in self._scene.solids:
            box = _box_of(polygon)
            if box is None:
                points = prism(polygon, HEIGHT).points
                self._solid(self._world, -1, type=_KINDS["hull"], meshname=self._hull(points))
                continue
            (x, y, yaw), (along, across) = box
            size = [along / 2, across / 2, HEIGHT / 2]
            turn = [math.cos(yaw / 2), 0, 0, math.sin(yaw / 2)]
            self._solid(self._world, -1, type=_KINDS["box"], size=size, pos=[x, y, HEIGHT / 2], quat=turn)

    def robots(self) -> None:
        scene = self._scene
        upright: dict[int, Shape] = {}
        for robot, (model, body) in enumerate(zip(scene.robots, scene.bodies, strict=True)):
            if scene.planar:
                shape = upright.setdefault(id(body), prism(model.footprint, model.height))
                inertia = model.mass * float((model.footprint**2).sum(axis=1).mean()) / 2
                self._planar_robot(robot, shape, model.mass, inertia)
            else:
                self._wheeled_robot(robot, body)

    def _planar_robot(self, robot: int, shape: Shape, mass: float, inertia: float) -> None:
        made = self._world.add_body(explicitinertial=True, mass=mass, ipos=[0, 0, 0], inertia=[inertia] * 3)
        slide, hinge = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE
        for kind, axis in ((slide, [1, 0, 0]), (slide, [0, 1, 0]), (hinge, [0, 0, 1])):
            made.add_joint(type=kind, axis=axis)
        self._shape(made, robot, shape)

    def _wheeled_robot(self, robot: int, body: RobotBody) -> None:
        moments, axes = body.principal()
        turn = np.empty(4)
        mujoco.mju_mat2Quat(turn, np.ascontiguousarray(axes).ravel())
        made = self._world.add_body(
            explicitinertial=True, mass=body.mass, ipos=body.centre, iquat=turn, inertia=moments
        )
        made.add_freejoint()
        for shape in body.shapes:
            self._shape(made, robot, shape)
        mass = body.mass + sum(wheel.mass for wheel in body.wheels)
        for side, wheel in enumerate(body.wheels):
            across, about = wheel.inertia
            turning = made.add_body(
                pos=wheel.place, explicitinertial=True, mass=wheel.mass, ipos=[0, 0, 0], inertia=[across, about, across]
            )
            joint = f"wheel_{robot}_{side}"
            turning.add_joint(
                name=joint, type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 1, 0], armature=ROTOR * mass * wheel.radius**2
            )
            solref, solimp = WHEEL_CONTACT
            self._geom(
                turning, FLOOR, type=_KINDS["sphere"], size=[wheel.radius, 0, 0], condim=3, contype=0,
                conaffinity=_GROUND, priority=1, solref=solref, solimp=solimp,
            )  # fmt: skip
            motor = self._spec.add_actuator(target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
            motor.set_to_velocity(kv=mass / 2 * wheel.radius**2 / MOTOR_LAG)
            motor.forcelimited = True
            motor.forcerange = [-body.torque, body.torque]

    def things(self) -> None:
        """Leaves of doors, then movers: moved by the simulation, and by nothing else."""
        scene = self._scene
        for leaf in scene.leaves:
            self._thing(-1, type=_KINDS["box"], size=[leaf.length / 2, leaf.thickness / 2, leaf.height / 2])
        for index, radius in enumerate(scene.movers):
            owner = len(scene.robots) + index
            self._thing(owner, type=_KINDS["cylinder"], size=[radius, MOVER_HEIGHT / 2, 0])

    def _thing(self, owner: int, **properties: object) -> None:
        self._solid(self._world.add_body(mocap=True, pos=[0, 0, BURIED]), owner, **properties)

    def compile(self) -> Built:
        scene = self._scene
        model = self._spec.compile()
        owner = np.array([self._owners[model.geom(index).name] for index in range(model.ngeom)], np.int64)
        leaves, movers = len(scene.leaves), len(scene.movers)
        return Built(
            model=model,
            start=self._start(model.qpos0),
            owner=owner,
            leaves=np.arange(leaves),
            movers=np.arange(leaves, leaves + movers),
            leaf_heights=tuple(leaf.height for leaf in scene.leaves),
        )

    def _start(self, initial: Float) -> Float:
        if not len(self._scene.robots):
            return initial.copy()
        coordinates = initial.reshape(len(self._scene.robots), -1).copy()
        poses = self._scene.poses
        coordinates[:, :2] = poses[:, :2]
        if self._scene.planar:
            coordinates[:, 2] = poses[:, 2]
        else:
            coordinates[:, 3], coordinates[:, 6] = np.cos(poses[:, 2] / 2), np.sin(poses[:, 2] / 2)
        return coordinates.ravel()

    def _shape(self, body: "mujoco.MjsBody", robot: int, shape: Shape) -> None:
        turn = np.empty(4)
        mujoco.mju_mat2Quat(turn, np.ascontiguousarray(shape.frame[:3, :3]).ravel())
        properties: dict[str, object] = {"pos": shape.frame[:3, 3], "quat": turn, "type": _KINDS[shape.kind]}
        if shape.kind == "hull":
            properties["meshname"] = self._hull(shape.points)
        elif shape.kind == "box":
            properties["size"] = [side / 2 for side in shape.size]
        else:
            radius, length = (*shape.size, 0.0)[:2]
            properties["size"] = [radius, length / 2, 0]
        solref, solimp = _BODY_CONTACT
        floor = _GROUND if shape.touches_floor else 0
        self._geom(
            body, robot, condim=1, contype=_ROBOT, conaffinity=_ROBOT | _THING | floor, priority=1,
            solref=solref, solimp=solimp, **properties,
        )  # fmt: skip

    def _solid(self, body: "mujoco.MjsBody", owner: int, **properties: object) -> None:
        self._geom(body, owner, condim=1, contype=_THING, conaffinity=0, **properties)

    def _geom(self, body: "mujoco.MjsBody", owner: int, **properties: object) -> None:
        name = str(len(self._owners))
        self._owners[name] = owner
        body.add_geom(name=name, **properties)

    def _hull(self, points: Float) -> str:
        """The name of the mesh of a convex hull."""
        if id(points) not in self._hulls:
            name = self._hulls[id(points)] = f"hull_{len(self._hulls)}"
            mesh = self._spec.add_mesh(name=name, inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX)
            mesh.uservert = np.ascontiguousarray(points).ravel()
            self._points = [*getattr(self, "_points", ()), points]
        return self._hulls[id(points)]


_PLANE = mujoco.mjtGeom.mjGEOM_PLANE


def _box_of(polygon: Float) -> tuple[tuple[float, float, float], tuple[float, float]] | None:
    """The pose of the middle of a rectangle f8[4,2] and its sides; None for other polygons."""
    if len(polygon) != 4:
        return None
    along, across = polygon[1] - polygon[0], polygon[3] - polygon[0]
    length, width = float(np.hypot(*along)), float(np.hypot(*across))
    square = abs(float(along @ across)) < 1e-9 * length * width
    if not square or np.abs(polygon[0] + polygon[2] - polygon[1] - polygon[3]).max() > 1e-9 or not length * width:
        return None
    x, y = ((polygon[0] + polygon[2]) / 2).tolist()
    return (x, y, math.atan2(along[1], along[0])), (length, width)
