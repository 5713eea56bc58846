"""Everything that the files of other programs show: a world, and the robots of a run with their motion."""

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.worlds.world import World
from mrpbench_core.store.recording import Recording
from mrpbench_world.solids import Leaf, PlacedRobot, Prism, elevations, floors_of, leaves_of, walls_of


@attrs.frozen(kw_only=True, eq=False)
class Motion:
    """The recorded poses of robots."""

    time: Float
    """f8[t] seconds."""
    pose: Float
    """f8[t,n,4]: x, y, z (metres) and yaw (radians, without jumps) in the frame `map`."""


@attrs.frozen(kw_only=True, eq=False)
class Scene:
    """A world in the frame `map`, metres, z up; levels are at their elevations."""

    name: str
    walls: list[Prism]
    floors: list[Prism]
    leaves: list[Leaf]
    robots: list[PlacedRobot] = attrs.field(factory=list)
    motion: Motion | None = None


def scene_of(world: World, robots: list[PlacedRobot] | None = None, motion: Motion | None = None) -> Scene:
    """The scene of a world, with robots.

    Raises:
        InputError: levels of the world are at the same elevation.
    """
    places = np.array([robot.pose[:2] for robot in robots or ()]).reshape(-1, 2)
    return Scene(
        name=world.name,
        walls=walls_of(world),
        floors=floors_of(world, places),
        leaves=leaves_of(world),
        robots=robots or [],
        motion=motion,
    )


def robots_of(recording: Recording) -> list[PlacedRobot]:
    """The robots of a run where they begin: by the first sample, or by the scenario if nothing was executed."""
    context = recording.context()
    scenario, motion = context.scenario, motion_of(recording)
    if motion is not None:
        poses = motion.pose[0]
    else:  # a start without a yaw has the yaw 0
        height = np.array(elevations(context.world))[scenario.start_level]
        poses = np.column_stack([scenario.start[:, :2], height, np.nan_to_num(scenario.start[:, 2])])
    return [
        PlacedRobot(name=name, model=model, pose=(x, y, yaw), elevation=z)
        for name, model, (x, y, z, yaw) in zip(context.fleet.names, context.fleet.robots, poses.tolist(), strict=True)
    ]


def motion_of(recording: Recording) -> Motion | None:
    """The true poses of a recording, or estimates where the truth is unknown; None if nothing was executed."""
    name = recording.pose_channel
    if name is None:
        return None
    pose = np.asarray(recording.channel(name), float)
    level = recording.channel("level") if "level" in recording.channels else np.zeros(pose.shape[:2], int)
    height = np.array(elevations(recording.context().world))[level]
    yaw = np.unwrap(np.nan_to_num(pose[..., 2]), axis=0)
    return Motion(time=recording.channel("time"), pose=np.dstack([pose[..., :2], height, yaw]))
