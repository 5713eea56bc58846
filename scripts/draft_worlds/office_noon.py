"""First draft of the built-in world `office_noon`; the shipped file is the truth and may have been edited since."""

import sys
from itertools import pairwise
from pathlib import Path

from building import DraftLevel, Routine, crowd_sim, write

TITLE = """An office of 24 x 12 m at noon: three offices, meeting room and post room north of a corridor, kitchen,
canteen and reception south of it. People walk between desks, kitchen, canteen, meeting, post and entrance.

Edit it here or in the RMF traffic editor."""
SPINE = (0.8, 2.4, 3.6, 7.2, 12.0, 16.8, 20.4, 21.6, 23.2)
NORTH, SOUTH, MIDDLE = 7.2, 4.8, 6.0
ROUTINE: Routine = {
    "desk": ((20, 60), {"canteen": 2, "kitchen": 1, "post": 0.5, "meeting": 0.5, "entrance": 0.5}),
    "kitchen": ((10, 30), {"canteen": 2, "desk": 1}),
    "canteen": ((30, 90), {"desk": 2, "kitchen": 1, "entrance": 0.5}),
    "meeting": ((30, 60), {"canteen": 1, "desk": 1}),
    "post": ((5, 15), {"desk": 1}),
    "entrance": ((2, 8), {"canteen": 1, "desk": 1}),
}
GROUPS = [("desk", 2, 2.4, 10.0), ("canteen", 3, 12.0, 3.6), ("desk", 2, 7.2, 10.0), ("kitchen", 2, 3.6, 2.0),
          ("desk", 2, 12.0, 10.0), ("entrance", 1, 22.0, 2.0)]  # fmt: skip


def office() -> DraftLevel:
    level = DraftLevel("office")
    for number, x in enumerate(SPINE):
        level.place({0: "dock_west", 8: "dock_east"}.get(number, f"corridor_{number}"), x, MIDDLE)
    level.lane("dock_west", *(f"corridor_{number}" for number in range(1, 8)), "dock_east")
    rooms = (("office_1", 1, 2.4, 8.8, 10.8), ("office_2", 3, 7.2, 8.8, 10.8), ("office_3", 4, 12.0, 8.8, 10.8),
             ("kitchen", 2, 3.6, 2.8, 1.2), ("canteen", 4, 12.0, 3.2, 1.2))  # fmt: skip
    for name, stop, x, y, back in rooms:
        level.place(name, x, y)
        level.place(f"{name}_back", x, back)
        level.lane(f"corridor_{stop}", name, f"{name}_back")
    for name, stop, x, y in (("meeting", 5, 16.8, 8.4), ("post", 7, 21.6, 8.8), ("reception", 6, 20.4, 2.8)):
        level.place(name, x, y)
        level.lane(f"corridor_{stop}", name)
    furniture(level)
    walls(level)
    return level


def furniture(level: DraftLevel) -> None:
    for x in (2.4, 7.2, 12.0):
        for y in (9.2, 11.0):
            level.model("Desk", x - 1.9, y)
            level.model("Desk", x + 1.9, y)
    level.people("desk", *((x + side, y) for x in (2.4, 7.2, 12.0) for y in (9.2, 11.0) for side in (-1.2, 1.2)))
    level.model("ConfTable", 16.8, 10.4)
    level.people("meeting", *((x, y) for x in (15.75, 17.85) for y in (9.6, 11.2)))
    for x in (20.4, 21.6, 22.8):
        level.model("MetalCabinet", x, 11.6, 1.570796)
    level.people("post", (20.6, 10.8), (22.6, 10.8))
    for y in (0.8, 2.0, 3.2):
        level.model("KitchenCountertop", 0.45, y)
    level.model("Cafe table", 6.0, 1.2)
    level.people("kitchen", (1.2, 0.9), (1.2, 2.0), (1.2, 3.1), (6.0, 2.1))
    for x in (9.4, 14.6):
        for y in (1.4, 3.4):
            level.model("Cafe table", x, y)
    level.people("canteen", *((x + side, y) for x in (9.4, 14.6) for y in (1.4, 3.4) for side in (-0.85, 0.85)))
    level.model("NurseDesk", 18.2, 2.2)
    level.people("entrance", (22.4, 0.8), (23.2, 1.6))


def walls(level: DraftLevel) -> None:
    level.remark("outer walls")
    level.wall((0, 0), (24, 0), (24, 12), (0, 12), (0, 0))
    level.remark("the corridor's north side: doors of offices and meeting room, doorway of the post room")
    doors = [(2.4, 1.0), (7.2, 1.0), (12.0, 1.0), (16.8, 1.2)]
    level.wall_with_gaps(NORTH, 0, 24, [*doors, (21.6, 1.4)], "x")
    for number, (x, width) in enumerate(doors):
        name, kind = (f"office_{number + 1}_door", "sliding") if number < 3 else ("meeting_door", "double_sliding")
        level.door(name, (x - width / 2, NORTH), (x + width / 2, NORTH), kind, direction=-1)
    level.remark("its south side: kitchen, canteen, reception")
    level.wall_with_gaps(SOUTH, 0, 24, [(3.6, 2.0), (12.0, 4.0), (20.4, 2.4)], "x")
    level.remark("between the rooms")
    for left, _ in pairwise((4.8, 9.6, 14.4, 19.2, 24.0)):
        level.wall((left, NORTH), (left, 12))
    for x in (7.2, 16.8):
        level.wall((x, 0), (x, SOUTH))


if __name__ == "__main__":
    write(Path(sys.argv[1]), TITLE, office(), people=crowd_sim(ROUTINE, GROUPS))
