"""What a world and its robots are made of: upright prisms, and leaves of doors that slide or turn."""

import math
from collections import Counter
from collections.abc import Iterator

import attrs
import numpy as np
from mrpbench_simulators_bodies.body import CLEARANCE, PLAY, RobotBody, plain_body
from mrpbench_simulators_bodies.polygons import convex_parts, convex_solids
from mrpbench_simulators_bodies.scene import HEIGHT

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.worlds.doors import leaf_segments, swing_angles
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.model.worlds.solids import wall_boxes
from mrpbench_core.model.worlds.world import Level, World

FLOOR = 0.1
"""metres of a floor's thickness."""
MARGIN = 1.0
"""metres by which the floor of a level without a drawn one reaches beyond everything solid."""
STEP_S = 0.004
"""Simulated seconds of a physics step of the other program."""
LEAF_MASS = 10.0
"""kilogram of a leaf of a door."""
GREY, WOOD, BLUE = (0.7, 0.7, 0.7), (0.55, 0.4, 0.25), (0.2, 0.35, 0.6)
"""Colours (red, green, blue) of walls and floors, of doors, and of robots."""


@attrs.frozen(kw_only=True, eq=False)
class Prism:
    """An upright solid with a convex base."""

    name: str
    base: Float
    """f8[k,2] metres, counter-clockwise."""
    bottom: float
    top: float
    """metres in the frame `map`."""

    @property
    def box(self) -> tuple[Float, Float, float] | None:
        """Middle f8[3], sides f8[3] and yaw, if the base is a rectangle."""
        if len(self.base) != 4:
            return None
        along, across = self.base[1] - self.base[0], self.base[3] - self.base[0]
        length, width = math.hypot(*along), math.hypot(*across)
        if not length or not width or np.abs(self.base[2] - self.base[0] - along - across).max() > 1e-9:
            return None
        if abs(along @ across) > 1e-9 * length * width:
            return None
        middle = np.array([*self.base.mean(axis=0), (self.bottom + self.top) / 2])
        return middle, np.array([length, width, self.top - self.bottom]), math.atan2(along[1], along[0])


@attrs.frozen(kw_only=True, eq=False)
class Leaf:
    """A leaf of a door, shut, and how it moves until it is open."""

    name: str
    prism: Prism
    hinge: tuple[float, float] | None = None
    """x, y of the axis about which it turns; None: it slides."""
    travel: tuple[float, float] = (0.0, 0.0)
    """metres that it slides."""
    turn: float = 0.0
    """radians that it turns, counter-clockwise."""

    @property
    def axis(self) -> tuple[tuple[float, float, float], float]:
        """Axis of its joint, and the metres or radians by which it opens along or about it."""
        if self.hinge is not None:
            return (0.0, 0.0, math.copysign(1.0, self.turn)), abs(self.turn)
        length = math.hypot(*self.travel)
        return (self.travel[0] / length, self.travel[1] / length, 0.0), length


@attrs.frozen(kw_only=True, eq=False)
class PlacedRobot:
    """A robot at the place where it begins."""

    name: str
    model: RobotModel
    pose: tuple[float, float, float]
    """x, y (metres), yaw (radians) in the frame `map`."""
    elevation: float = 0.0
    """metres of its floor."""

    @property
    def rigid(self) -> RobotBody:
        """Masses, inertia and wheels as in our simulators of rigid bodies."""
        return plain_body(self.model)

    def body(self) -> list[Prism]:
        """Its footprint in the base frame, from just above the floor to its height, as convex prisms."""
        bases = convex_parts(np.asarray(self.model.footprint))
        top = max(self.model.height, 2 * CLEARANCE)
        return [Prism(name=f"body_{index}", base=base, bottom=CLEARANCE, top=top) for index, base in enumerate(bases)]

    def casters(self) -> list[tuple[Float, float]]:
        """Middle f8[3] in the base frame and radius of a sphere at the front and at the rear, which glide."""
        along = np.asarray(self.model.footprint)[:, 0]
        ends = [end for end in (0.9 * float(along.min()), 0.9 * float(along.max())) if end]
        radii = [min(self.model.wheel_radius, abs(end)) / 4 for end in ends]
        return [(np.array([end, 0.0, radius + PLAY]), radius) for end, radius in zip(ends, radii, strict=True)]


def elevations(world: World) -> list[float]:
    """The height in metres of the floor of each level.

    Raises:
        InputError: levels are at the same height, so that they cannot be in one file.
    """
    heights = [float(level.elevation) for level in world.levels]
    if len(set(heights)) < len(heights):
        raise InputError(f"levels of {world.name} are at the same elevation", hint="choose one with --level")
    return heights


def walls_of(world: World) -> list[Prism]:
    """Everything solid that does not move: walls, obstacles and blocked cells, as convex prisms that may overlap."""
    prisms = []
    for level, elevation in zip(world.levels, elevations(world), strict=True):
        for kind, number, base, height in _bases(level):
            name = f"{level.name}_{kind}_{number}"
            prisms.append(Prism(name=name, base=base, bottom=elevation, top=elevation + height))
    return prisms


def _bases(level: Level) -> Iterator[tuple[str, int, Float, float]]:
    """Kind, number within the kind, base and height of each solid of a level."""
    numbers = Counter[str]()
    for part, base in convex_solids(level):
        kind, _, index = part.partition(" ")
        yield kind, numbers[kind], base, level.obstacles[int(index)].height if index else HEIGHT
        numbers[kind] += 1


def floors_of(world: World, extra: Float) -> list[Prism]:
    """Slabs below each level: the drawn floor, or the box around everything solid and the points `extra` f8[k,2].

    A drawn floor with holes is written without them: robots keep clear of holes by their maps.
    """
    prisms = []
    for level, elevation in zip(world.levels, elevations(world), strict=True):
        bases = [part for floor in level.floors for part in convex_parts(np.asarray(floor.polygon))]
        if not bases:
            corners = np.concatenate([np.empty((0, 2)), extra, *(base for _, _, base, _ in _bases(level))])
            low, high = corners.min(axis=0, initial=0.0) - MARGIN, corners.max(axis=0, initial=0.0) + MARGIN
            bases = [np.array([low, (high[0], low[1]), high, (low[0], high[1])])]
        prisms += [
            Prism(name=f"{level.name}_floor_{number}", base=base, bottom=elevation - FLOOR, top=elevation)
            for number, base in enumerate(bases)
        ]
    return prisms


def leaves_of(world: World) -> list[Leaf]:
    """The leaves of all doors on all levels, shut."""
    heights = elevations(world)
    leaves = []
    for gate in Facilities(world).doors:
        door = gate.door
        shut, opened = leaf_segments(door, 0.0), leaf_segments(door, 1.0)
        turns = swing_angles(door)
        for level in gate.levels:
            bases = wall_boxes(shut, door.thickness).reshape(-1, 4, 4)[..., :2]
            for number, (base, line, end) in enumerate(zip(bases, shut, opened, strict=True)):
                name = f"{world.levels[level].name}_{gate.name}_{number}"
                prism = Prism(name=name, base=base, bottom=heights[level], top=heights[level] + door.height)
                if "hinged" in door.motion:
                    at_end = math.dist(line[:2], door.end) < math.dist(line[:2], door.start)
                    turn = turns[int(at_end)]
                    leaves.append(Leaf(name=name, prism=prism, hinge=(float(line[0]), float(line[1])), turn=turn))
                else:
                    x, y = (end[:2] - line[:2]).tolist()
                    leaves.append(Leaf(name=name, prism=prism, travel=(x, y)))
    return leaves
