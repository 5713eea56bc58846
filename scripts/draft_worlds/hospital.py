"""First draft of the built-in world `hospital`; the shipped file is the truth and may have been edited since.

Three floors of one plan: rooms north and south of a corridor that is wide enough for two robots, four lifts along
it. The lifts in the north serve all floors, those in the south two floors each.
"""

import sys
from itertools import pairwise
from pathlib import Path

from building import DraftLevel, write

TITLE = """A hospital of 26 × 12 m on three floors: fifteen rooms with doors, four lifts, a corridor with two lanes.

Edit it here or in the RMF traffic editor. Walls are 0.1 m thick boxes around their lines."""
SOUTH, NORTH, WIDTH, DEPTH = 5.0, 7.0, 26.0, 12.0
"""The corridor's walls, and the building."""
LANES = {"south": 5.6, "north": 6.4}
"""y of the corridor's lanes."""
CABIN = 1.6
LIFTS = {
    "lift_a": (7.0, "north", ("L1", "L2", "L3")),
    "lift_b": (18.6, "north", ("L1", "L2", "L3")),
    "lift_c": (10.0, "south", ("L1", "L2")),
    "lift_d": (21.6, "south", ("L2", "L3")),
}
"""x of the cabin, its side of the corridor, and the levels that it serves."""
ROOMS = {
    "L1": ("pharmacy", "emergency", "radiology", "kitchen", "reception"),
    "L2": ("ward_21", "ward_22", "ward_23", "ward_24", "ward_25"),
    "L3": ("surgery", "recovery", "laboratory", "sterilisation", "offices"),
}
SITES = ((3, "north"), (12.8, "north"), (23, "north"), (4.6, "south"), (15.8, "south"))
"""x of the door of each room, and its side of the corridor."""
KINDS = ("hinged", "sliding", "double_sliding", "hinged", "double_hinged")
WIDTHS = (1.0, 1.0, 1.2, 1.0, 1.8)


def draft(file: Path) -> None:
    """Write the building file."""
    levels = [floor(name, 4.0 * index) for index, name in enumerate(ROOMS)]
    write(file, TITLE, *levels, lifts=[lift for name in LIFTS for lift in lift_lines(name)])


def floor(name: str, elevation: float) -> DraftLevel:
    level = DraftLevel(name, elevation)
    lifts = {lift: (x, side) for lift, (x, side, served) in LIFTS.items() if name in served}
    corridor(level, sorted({x for x, _ in SITES} | {x for x, _, _ in LIFTS.values()} | {1.0, 25.0}))
    for room, (x, side), kind, width in zip(ROOMS[name], SITES, KINDS, WIDTHS, strict=True):
        add_room(level, room, x, 1 if side == "north" else -1, kind, width)
    for lift, (x, side) in lifts.items():
        place = level.place(f"{name}_{lift}", x, 8.0 if side == "north" else 4.0)
        level.lane(place, f"{name}_{side}_{x:g}")
    walls(level, lifts)
    return level


def corridor(level: DraftLevel, stops: list[float]) -> None:
    for side, y in LANES.items():
        for x in stops:
            level.place(f"{level.name}_{side}_{x:g}", x, y)
        for a, b in pairwise(stops):
            level.lane(f"{level.name}_{side}_{a:g}", f"{level.name}_{side}_{b:g}")
    for x in stops:
        level.lane(f"{level.name}_south_{x:g}", f"{level.name}_north_{x:g}")
    for end, x in (("west", 1.0), ("east", 25.0)):
        for side, y in LANES.items():
            charger = level.place(f"{level.name}_charger_{end}_{side}", x + (0.6 if x > 20 else -0.6), y, "is_charger")
            level.lane(charger, f"{level.name}_{side}_{x:g}")


def add_room(level: DraftLevel, name: str, x: float, way: int, kind: str, width: float) -> None:
    """Three places behind a door: `way` is 1 north of the corridor and -1 south of it."""
    wall, side = (NORTH, "north") if way > 0 else (SOUTH, "south")
    entrance = level.place(name, x, wall + 2.2 * way)
    level.lane(f"{level.name}_{side}_{x:g}", entrance)
    level.lane(entrance, level.place(f"{name}_pickup", x - 1.6, wall + 3.6 * way, f"pickup_dispenser={name}_pickup"))
    level.lane(entrance, level.place(f"{name}_dropoff", x + 1.6, wall + 3.6 * way, f"dropoff_ingestor={name}_dropoff"))
    # Seen from start to end, direction 1 opens to the right: south of the corridor that is into the room.
    level.door(f"{name}_door", (x - width / 2, wall), (x + width / 2, wall), kind, direction=-way)


def walls(level: DraftLevel, lifts: dict[str, tuple[float, str]]) -> None:
    level.remark("outer walls")
    level.wall((0, 0), (WIDTH, 0), (WIDTH, DEPTH), (0, DEPTH), (0, 0))
    for side, y in (("south", SOUTH), ("north", NORTH)):
        level.remark(f"the corridor's {side} side: doors of rooms and lifts")
        gaps = [(x, width) for (x, of), width in zip(SITES, WIDTHS, strict=True) if of == side]
        gaps += [(x, 1.0) for x, of in lifts.values() if of == side]
        level.wall_with_gaps(y, 0, WIDTH, gaps, "x")
    level.remark("lift shafts, with the walls behind them that part the rooms")
    for x, side, _ in LIFTS.values():
        wall, back, outer = (NORTH, NORTH + 2, DEPTH) if side == "north" else (SOUTH, SOUTH - 2, 0)
        left, right = x - CABIN / 2 - 0.15, x + CABIN / 2 + 0.15
        level.wall((left, wall), (left, back), (right, back), (right, wall))
        level.wall((x, back), (x, outer))


def lift_lines(name: str) -> list[str]:
    x, side, served = LIFTS[name]
    y, door = (8.0, -1.0) if side == "north" else (4.0, 1.0)
    shape = f"yaw: 0, width: {CABIN}, depth: {CABIN}"
    ends = f"reference_floor_name: {served[0]}, initial_floor_name: {served[0]}"
    return [
        f"  {name}:",
        f"    {{x: {x}, y: {y}, {shape}, {ends},",
        f"     lowest_floor: {served[0]}, highest_floor: {served[-1]}, plugins: true,",
        f"     doors: {{{name}_door: {{x: 0, y: {door}, width: 1, motion_axis_orientation: 0, door_type: 2}}}},",
        f"     level_doors: {{{', '.join(f'{level}: [{name}_door]' for level in served)}}}}}",
    ]


if __name__ == "__main__":
    draft(Path(sys.argv[1]))
