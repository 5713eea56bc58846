"""The scene of a simulation: everything that a physics engine builds, in the plane where levels lie side by side."""

from collections.abc import Mapping, Sequence
from functools import cached_property

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet, RobotModel
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.model.worlds.level_layout import LevelLayout
from mrpbench_core.model.worlds.world import World
from mrpbench_simulators_bodies.body import RobotBody, plain_body
from mrpbench_simulators_bodies.leaves import Leaf, leaves_of
from mrpbench_simulators_bodies.polygons import convex_solids
from mrpbench_simulators_bodies.urdf import described_body

HEIGHT = 2.5
"""metres: the height to which RMF's generator of Gazebo worlds builds walls, which is above every lidar."""
MOVER_HEIGHT = 1.7
"""metres of people and carts."""


@attrs.frozen(kw_only=True, eq=False, slots=False)
class Scene:
    """What a world, a fleet and its movers are made of."""

    world: World
    layout: LevelLayout
    robots: tuple[RobotModel, ...]
    bodies: tuple[RobotBody, ...]
    """One for each robot; equal robots share one."""
    poses: Float
    """f8[n,3] of the robots in the plane."""
    leaves: tuple[Leaf, ...]
    """Of all doors on all levels."""
    movers: tuple[float, ...]
    """Radii of upright cylinders, metres."""
    timestep: float
    """seconds of a physics step."""
    planar: bool
    """True if robots are their footprints, that keep to the plane and have neither wheels nor weight."""

    @property
    def segments(self) -> Float:
        """The outlines f8[S,4] of everything solid that does not move, solid on their left."""
        return self.layout.segments

    @cached_property
    def solids(self) -> list[Float]:
        """The same as convex polygons f8[k,2], counter-clockwise, which may overlap."""
        polygons_in_plane: list[Float] = []
        for index, level in enumerate(self.world.levels):
            polygons = [polygon for _, polygon in convex_solids(level)]
            polygons_in_plane += [self.layout.to_plane(it, np.full(len(it), index, np.int16)) for it in polygons]
        return polygons_in_plane


def build_scene(
    world: World,
    layout: LevelLayout,
    facilities: Facilities,
    state: Mapping[str, float],
    fleet: Fleet,
    poses: Float,
    movers: Sequence[float],
    timestep: float,
    planar: bool,
) -> Scene:
    """Collect the scene; doors are as in `state`.

    Raises:
        InputError: the URDF of a robot is wrong.
    """
    profiles, profile = fleet.profiles
    bodies = [body_of(robot) for robot in profiles]
    return Scene(
        world=world,
        layout=layout,
        robots=fleet.robots,
        bodies=tuple(bodies[index] for index in profile),
        poses=poses,
        leaves=leaves_of(facilities, state),
        movers=tuple(movers),
        timestep=timestep,
        planar=planar,
    )


def body_of(robot: RobotModel) -> RobotBody:
    """The body of a model of robot.

    Raises:
        InputError: its URDF is wrong.
    """
    return plain_body(robot) if robot.urdf is None else described_body(robot, robot.urdf)
