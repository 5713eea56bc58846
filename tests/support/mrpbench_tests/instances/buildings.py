"""Buildings with floors, lifts and doors, drawn at random in the format of the RMF traffic editor.

Each floor is a corridor with rooms on both sides, some of which are lift shafts.
"""

import math
from typing import Any

import attrs
import numpy as np
import yaml

from mrpbench_tests.drawn_floor import DrawnFloor, Point

Random = np.random.Generator

PITCH, DEPTH, CABIN = 4.0, 5.0, 1.6
"""Metres: width and depth of a room, side of a cabin."""
MOST_DOORS, MOST_LIFTS = 15, 4
KINDS = {"hinged": 1.0, "double_hinged": 1.6, "sliding": 1.0, "double_sliding": 1.2}
"""The kinds of doors and their widths in metres."""


@attrs.frozen(kw_only=True)
class Building:
    """A building file and what it shows. Positions are in metres, in the frame of the first floor."""

    text: str
    places: dict[str, dict[str, Point]]
    """The position of each place, by floor: ends of lanes, in rooms and at the ends of corridors."""
    lifts: dict[str, tuple[Point, tuple[str, ...]]]
    """The centre of each cabin and the floors that it serves."""
    doors: dict[str, str]
    """The kind of each door."""
    tips: dict[str, Point]
    """The end of the first leaf of each hinged door when it is open."""


@attrs.frozen
class _Site:
    """A room or a shaft along the corridor: its middle, and its side (1 = north, -1 = south)."""

    x: float
    side: int


@attrs.frozen
class _Shaft:
    name: str
    site: _Site
    x: float
    """Two shafts on one site stand side by side."""
    floors: tuple[str, ...]


@attrs.frozen
class _Opening:
    """A doorway between the corridor and a room or a lift."""

    x: float
    side: int
    width: float


def random_building(
    random: Random, *, floors: int | None = None, lifts: int | None = None, lanes: int | None = None
) -> Building:
    """Return a building of two or three `floors`, up to four `lifts` and up to fifteen doors; None is drawn.

    Every floor can be reached; some lifts do not serve all floors, and two may stand side by side. The corridor has one
    or two `lanes`. One door in ten opens into the corridor.
    """
    count = floors or int(random.integers(2, 4))
    drawn = [
        DrawnFloor(
            f"L{index + 1}",
            3.5 * index,
            float(random.uniform(0.02, 0.1)),
            float(random.uniform(-3, 3)) if index else 0.0,
            (float(random.uniform(-500, 500)), float(random.uniform(-500, 500))),
        )
        for index in range(count)
    ]
    names = [floor.name for floor in drawn]
    slots = int(random.integers(4, 7))
    ways = (-0.4, 0.4) if (lanes or int(random.integers(1, 3))) == 2 else (0.0,)
    half = ways[-1] + 0.6
    sites = [_Site(PITCH * (slot + 0.5), side) for slot in range(slots) for side in (1, -1)]
    sites = [sites[index] for index in random.permutation(len(sites))]
    shafts = _shafts(random, sites, _stops(random, names, lifts or int(random.integers(1, MOST_LIFTS + 1))))
    rooms = [site for site in sites if all(site != shaft.site for shaft in shafts)]
    doors: dict[str, str] = {}
    tips: dict[str, Point] = {}
    for floor in drawn:
        here = [shaft for shaft in shafts if floor.name in shaft.floors]
        openings = {_Opening(shaft.x, shaft.site.side, 1.0) for shaft in here}
        for index in random.permutation(len(rooms))[: MOST_DOORS // count].tolist():
            site, door = rooms[index], f"{floor.name}_door_{len(openings) - len(here)}"
            doors[door] = str(random.choice(list(KINDS)))
            openings.add(_Opening(site.x, site.side, KINDS[doors[door]]))
            _draw_room(floor, door.replace("door", "room"), site, half, ways)
            tip = _draw_door(random, floor, door, doors[door], site, half)
            tips |= {door: tip} if "hinged" in doors[door] else {}
        _draw_corridor(floor, PITCH * slots, half, ways, here, openings)
        for shaft in shafts:
            _draw_shaft(floor, shaft, half)
    corners = [(0.0, half + DEPTH), (PITCH * slots, half + DEPTH), (0.0, -half - DEPTH)]
    by_name = {floor.name: floor for floor in drawn}
    document = {
        "name": "drawn",
        "lifts": {shaft.name: _lift(random, shaft, by_name, half) for shaft in shafts},
        "levels": {floor.name: floor.section(corners) for floor in drawn},
    }
    shift = drawn[0].scale * drawn[0].origin

    def moved(point: Point) -> Point:
        return (point[0] + float(shift[0]), point[1] + float(shift[1]))

    return Building(
        text=yaml.safe_dump(document, default_flow_style=None, sort_keys=False),
        places={floor.name: {name: moved(point) for name, point in floor.places.items()} for floor in drawn},
        lifts={shaft.name: (moved((shaft.x, _middle(shaft, half))), shaft.floors) for shaft in shafts},
        doors=doors,
        tips={name: moved(point) for name, point in tips.items()},
    )


def _stops(random: Random, names: list[str], lifts: int) -> list[tuple[str, ...]]:
    """Draw the floors that each lift serves; the lifts together join all floors."""
    while True:
        served = [set(random.permutation(names)[: random.integers(2, len(names) + 1)].tolist()) for _ in range(lifts)]
        joined = set(served[0])
        for _ in served:
            joined |= {name for stops in served if stops & joined for name in stops}
        if joined == set(names):
            return [tuple(name for name in names if name in stops) for stops in served]


def _shafts(random: Random, sites: list[_Site], stops: list[tuple[str, ...]]) -> list[_Shaft]:
    """Place lifts on the first sites, half of the time two on one."""
    shafts: list[_Shaft] = []
    free = iter(sites)
    while len(shafts) < len(stops):
        site = next(free)
        twins = 2 if len(stops) - len(shafts) > 1 and random.random() < 0.5 else 1
        for x in (site.x - 0.9, site.x + 0.9) if twins == 2 else (site.x,):
            shafts.append(_Shaft(f"lift_{len(shafts)}", site, x, stops[len(shafts)]))
    return shafts


def _middle(shaft: _Shaft, half: float) -> float:
    return shaft.site.side * (half + 0.2 + CABIN / 2)


def _lift(random: Random, shaft: _Shaft, floors: dict[str, DrawnFloor], half: float) -> dict[str, Any]:
    """Return a lift, drawn on one of its floors. Its door is to the south of a cabin that is not turned."""
    reference = floors[str(random.choice(shaft.floors))]
    x, y = reference.pixel((shaft.x, _middle(shaft, half)))
    door = {"x": 0.0, "y": -(CABIN / 2 + 0.2), "width": 1.0, "motion_axis_orientation": 0.0, "door_type": 2}
    return {
        "depth": CABIN,
        "doors": {"front": door},
        "highest_floor": shaft.floors[-1],
        "initial_floor_name": str(random.choice(shaft.floors)),
        "level_doors": {name: ["front"] for name in shaft.floors},
        "lowest_floor": shaft.floors[0],
        "plugins": True,
        "reference_floor_name": reference.name,
        "width": CABIN,
        "x": x,
        "y": y,
        "yaw": reference.turn + (0.0 if shaft.site.side > 0 else math.pi),
    }


def _draw_room(floor: DrawnFloor, name: str, site: _Site, half: float, ways: tuple[float, ...]) -> None:
    """Draw lanes from the corridor to two places in a room."""
    entrance = floor.vertex((site.x, site.side * (half + 2.0)))
    floor.lane(_on_lane(floor, site.x, site.side, ways), entrance)
    for offset, end in ((-1.2, "west"), (1.2, "east")):
        floor.lane(entrance, floor.place((site.x + offset, site.side * (half + 3.6)), f"{name}_{end}"))


def _draw_door(random: Random, floor: DrawnFloor, name: str, kind: str, site: _Site, half: float) -> Point:
    """Draw the door of a room; return where the end of its first leaf is when the door is open, if it is hinged."""
    width, wall = KINDS[kind], site.side * half
    ends = [(site.x - width / 2, wall), (site.x + width / 2, wall)]
    start, end = ends if random.random() < 0.5 else ends[::-1]
    axis = str(random.choice(["start", "end"]))
    hinge, tip = (start, end) if axis == "start" or kind.startswith("double") else (end, start)
    way = site.side if random.random() < 0.9 else -site.side
    # Direction 1 turns the first leaf clockwise, seen from above: a leaf that points east then opens to the south.
    floor.door(name, kind, start, end, axis, -way if tip[0] > hinge[0] else way)
    return (hinge[0], wall + way * (width / 2 if kind.startswith("double") else width))


def _draw_corridor(
    floor: DrawnFloor, length: float, half: float, ways: tuple[float, ...], lifts: list[_Shaft], openings: set[_Opening]
) -> None:
    """Draw the lanes along the corridor and into the lifts, and the walls beside it."""
    stops = sorted({opening.x for opening in openings})
    for y in ways:
        ends = [floor.place((x, y), f"{floor.name}_{end}_{y:g}") for end, x in (("west", 0.6), ("east", length - 0.6))]
        floor.lane(ends[0], *(floor.vertex((x, y)) for x in stops), ends[1])
    for x in stops:
        floor.lane(*(floor.vertex((x, y)) for y in ways))
    for lift in lifts:
        floor.lane(_on_lane(floor, lift.x, lift.site.side, ways), floor.vertex((lift.x, _middle(lift, half))))
    for side in (1, -1):
        gaps = [(opening.x, opening.width) for opening in openings if opening.side == side]
        floor.wall_with_gaps(side * half, length, gaps)
        floor.wall(
            (0.0, side * half), (0.0, side * (half + DEPTH)), (length, side * (half + DEPTH)), (length, side * half)
        )
        for x in np.arange(PITCH, length, PITCH).tolist():
            floor.wall((x, side * half), (x, side * (half + DEPTH)))
    floor.wall((0.0, -half), (0.0, half))
    floor.wall((length, -half), (length, half))


def _draw_shaft(floor: DrawnFloor, shaft: _Shaft, half: float) -> None:
    wall, back = shaft.site.side * half, shaft.site.side * (half + CABIN + 0.4)
    left, right = shaft.x - 0.9, shaft.x + 0.9
    floor.wall((left, wall), (left, back), (right, back), (right, wall))


def _on_lane(floor: DrawnFloor, x: float, side: int, ways: tuple[float, ...]) -> int:
    """Return the vertex of the corridor before a door."""
    return floor.vertex((x, ways[-1] if side > 0 else ways[0]))
