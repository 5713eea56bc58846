"""First draft of the built-in world `hospital_corridor`.

The shipped file is the truth and may have been edited since.
"""

import sys
from pathlib import Path

from building import DraftLevel, Routine, crowd_sim, write

TITLE = """Two floors of a hospital, 24 x 10.4 m each: seven rooms with doors and a nurses' station on both sides of a
corridor of 2.4 m, one lift. Staff and visitors walk between station, rooms and lift, patients up and down the corridor.

Edit it here or in the RMF traffic editor. People stay on their floor: one crowd for each."""
SOUTH, NORTH, WIDTH, DEPTH = 4.0, 6.4, 24.0, 10.4
"""The corridor's walls, and the building."""
LANES = {"south": 4.8, "north": 5.6}
STOPS = (0.8, 2.8, 8.4, 12.0, 15.6, 21.2, 23.2)
LIFT, CABIN = 12.0, 1.6
ROOMS = {
    "L1": ("admission", "x_ray", "laboratory", "day_clinic", "pharmacy", "ward_11", "ward_12"),
    "L2": ("surgery", "recovery", "ward_21", "ward_22", "ward_23", "ward_24", "ward_25"),
}
SITES = ((2.8, 1), (8.4, 1), (15.6, 1), (21.2, 1), (2.8, -1), (8.4, -1), (15.6, -1))
"""x of the door of each room, and 1 north of the corridor or -1 south of it."""
STATION = 21.2


def routine(level: str) -> Routine:
    named = {
        "station": ((10, 30), {"room": 3, "lift": 0.5}),
        "room": ((15, 45), {"station": 2, "room": 1, "lift": 0.5}),
        "lift": ((3, 8), {"room": 1, "station": 1}),
        "west": ((1, 4), {"east": 1}),
        "east": ((1, 4), {"west": 1}),
    }
    return {
        f"{level}_{name}": (stay, {f"{level}_{other}": weight for other, weight in following.items()})
        for name, (stay, following) in named.items()
    }


def groups(level: str) -> list[tuple[str, int, float, float]]:
    return [(f"{level}_room", 3, 6.0, 5.2), (f"{level}_station", 2, 21.2, 2.8), (f"{level}_west", 2, 18.0, 5.2),
            (f"{level}_lift", 1, 12.0, 5.2)]  # fmt: skip


def floor(name: str, elevation: float) -> DraftLevel:
    level = DraftLevel(name, elevation)
    for side, y in LANES.items():
        for number, x in enumerate(STOPS, 1):
            level.place(f"{name}_{side}_{number}", x, y)
        level.lane(*(f"{name}_{side}_{number}" for number in range(1, len(STOPS) + 1)))
    for number in range(1, len(STOPS) + 1):
        level.lane(f"{name}_south_{number}", f"{name}_north_{number}")
    for room, (x, way), kind in zip(ROOMS[name], SITES, ("hinged", "sliding", "hinged", "sliding") * 2, strict=False):
        wall, side = (NORTH, "north") if way > 0 else (SOUTH, "south")
        level.place(room, x, wall + 1.8 * way, f"dropoff_ingestor={room}")
        level.lane(f"{name}_{side}_{STOPS.index(x) + 1}", room)
        level.door(f"{room}_door", (x - 0.6, wall), (x + 0.6, wall), kind, direction=-way)
        for bed in (-1.7, 1.7):
            level.model("HospitalBed", x + bed, wall + 2.8 * way, 1.570796)
        level.people(f"{name}_room", *((x + beside, wall + 2.8 * way) for beside in (-0.7, 0.7)))
    station = level.place(f"{name}_station", STATION, 2.4)
    level.lane(f"{name}_south_{STOPS.index(STATION) + 1}", station)
    level.model("NurseDesk", 21.2, 0.9, 1.570796)
    level.people(f"{name}_station", (19.4, 1.6), (20.2, 2.4), (22.6, 1.6))
    level.place(f"{name}_cabin", LIFT, NORTH + 1.0)
    level.lane(f"{name}_north_{STOPS.index(LIFT) + 1}", f"{name}_cabin")
    level.people(f"{name}_lift", (11.0, 6.0), (13.0, 6.0))
    level.people(f"{name}_west", (1.0, 5.2), (2.0, 5.2))
    level.people(f"{name}_east", (22.0, 5.2), (23.0, 5.2))
    walls(level)
    return level


def walls(level: DraftLevel) -> None:
    level.remark("outer walls")
    level.wall((0, 0), (WIDTH, 0), (WIDTH, DEPTH), (0, DEPTH), (0, 0))
    for way, y, other in ((-1, SOUTH, (STATION, 2.4)), (1, NORTH, (LIFT, 1.0))):
        level.remark(f"the corridor's {'north' if way > 0 else 'south'} side")
        level.wall_with_gaps(y, 0, WIDTH, [*((x, 1.2) for x, of in SITES if of == way), other], "x")
    level.remark("lift shaft")
    left, right = LIFT - CABIN / 2 - 0.15, LIFT + CABIN / 2 + 0.15
    level.wall((left, NORTH), (left, NORTH + 2), (right, NORTH + 2), (right, NORTH))
    level.wall((LIFT, NORTH + 2), (LIFT, DEPTH))
    level.remark("between the rooms")
    for x in (5.6, 18.4):
        level.wall((x, NORTH), (x, DEPTH))
    for x in (5.6, 12.0, 18.4):
        level.wall((x, 0), (x, SOUTH))


def lift_lines() -> list[str]:
    doors = "{lift_door: {x: 0, y: -1.0, width: 1, motion_axis_orientation: 0, door_type: 2}}"
    return [
        "  lift:",
        f"    {{x: {LIFT:g}, y: {NORTH + 1:g}, yaw: 0, width: {CABIN}, depth: {CABIN}, reference_floor_name: L1,",
        "     initial_floor_name: L1, lowest_floor: L1, highest_floor: L2, plugins: true,",
        f"     doors: {doors}, level_doors: {{L1: [lift_door], L2: [lift_door]}}}}",
    ]


if __name__ == "__main__":
    both = {**routine("L1"), **routine("L2")}
    begin = [group for level in ROOMS for group in groups(level)]
    floors = [floor(name, 4.0 * index) for index, name in enumerate(ROOMS)]
    write(Path(sys.argv[1]), TITLE, *floors, lifts=lift_lines(), people=crowd_sim(both, begin))
