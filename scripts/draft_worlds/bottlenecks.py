"""First draft of the built-in world `bottlenecks`; the shipped file is the truth and may have been edited since.

Lanes lie on multiples of 0.4 m, and the outer faces of walls 0.2 m beside one, so that a raster of 0.4 m runs through
the middle of the passages.
"""

import sys
from pathlib import Path

from building import DraftLevel, write

TITLE = """Minimal hard cases, one level each: a corridor for one, a swap, a roundabout, an alcove, a narrow door.

Robots must give way to one another; passages are 0.7 m wide. Edit it here or in the RMF traffic editor."""
GAP = 0.8
"""Between the lines of walls that leave 0.7 m."""


def room(level: DraftLevel, left: float, bottom: float, right: float, top: float, **gaps: float) -> None:
    """Four walls, with a gap of 0.7 m in those named, at the coordinate given."""
    for side, fixed, first, last, axis in (
        ("south", bottom, left, right, "x"), ("north", top, left, right, "x"),
        ("west", left, bottom, top, "y"), ("east", right, bottom, top, "y"),
    ):  # fmt: skip
        level.wall_with_gaps(fixed, first, last, [(gaps[side], GAP)] if side in gaps else [], axis)


def corridor() -> DraftLevel:
    level = DraftLevel("corridor")
    for side, x, toward in (("west", 0.4, 1), ("east", 9.6, -1)):
        for part, y in (("south", 0.4), ("middle", 1.2), ("north", 2.0)):
            level.place(f"{side}_{part}", x, y)
        level.place(f"{side}_mouth", x + toward * 1.2, 1.2)
        for part in ("south", "middle", "north"):
            level.lane(f"{side}_{part}", f"{side}_mouth")
    level.lane("west_mouth", "east_mouth")
    level.remark("west room, east room, corridor of 4.8 m")
    room(level, -0.15, -0.15, 2.6, 2.55, east=1.2)
    room(level, 7.4, -0.15, 10.15, 2.55, west=1.2)
    for y in (0.8, 1.6):
        level.wall((2.6, y), (7.4, y))
    return level


def swap() -> DraftLevel:
    level = DraftLevel("swap")
    for name, x, y in (
        ("south_west", 0.4, 0.4),
        ("south_east", 2.8, 0.4),
        ("north_east", 2.8, 1.2),
        ("north_west", 0.4, 1.2),
    ):
        level.place(name, x, y)
    level.lane("south_west", "south_east", "north_east", "north_west", "south_west")
    level.remark("one room, two robots wide")
    room(level, -0.15, -0.15, 3.35, 1.75)
    return level


def roundabout() -> DraftLevel:
    level = DraftLevel("roundabout")
    arms = {"south": (3.6, 0.4), "east": (6.8, 3.6), "north": (3.6, 6.8), "west": (0.4, 3.6)}
    ring = {"south": (3.6, 2.4), "south_east": (4.8, 2.4), "east": (4.8, 3.6), "north_east": (4.8, 4.8),
            "north": (3.6, 4.8), "north_west": (2.4, 4.8), "west": (2.4, 3.6), "south_west": (2.4, 2.4)}  # fmt: skip
    for name, xy in arms.items():
        level.place(name, *xy)
    for name, xy in ring.items():
        level.place(f"ring_{name}", *xy)
    for name in arms:
        level.lane(name, f"ring_{name}")
    level.lane(*(f"ring_{name}" for name in ring), "ring_south", one_way=True)
    level.remark("island, ring")
    room(level, 2.8, 2.8, 4.4, 4.4)
    room(level, 2.0, 2.0, 5.2, 5.2, south=3.6, east=3.6, north=3.6, west=3.6)
    level.remark("arms: south, north, west, east")
    room(level, 2.75, -0.15, 4.45, 1.2, north=3.6)
    room(level, 2.75, 6.0, 4.45, 7.35, south=3.6)
    room(level, -0.15, 2.75, 1.2, 4.45, east=3.6)
    room(level, 6.0, 2.75, 7.35, 4.45, west=3.6)
    for x in (3.2, 4.0):
        level.wall((x, 1.2), (x, 2.0))
        level.wall((x, 5.2), (x, 6.0))
        level.wall((1.2, x), (2.0, x))
        level.wall((5.2, x), (6.0, x))
    return level


def alcove() -> DraftLevel:
    level = DraftLevel("alcove")
    for name, x, y in (("west", 0.4, 0.8), ("west_of_alcove", 2.4, 0.8), ("mouth", 3.6, 0.8),
                       ("east_of_alcove", 4.8, 0.8), ("east", 6.8, 0.8), ("alcove", 3.6, 1.6)):  # fmt: skip
        level.place(name, x, y)
    level.lane("west", "west_of_alcove", "mouth", "east_of_alcove", "east")
    level.lane("mouth", "alcove")
    level.remark("the block that the corridor is cut from")
    room(level, -0.15, -0.15, 7.35, 2.15)
    level.remark("corridor, alcove")
    level.wall((-0.15, 0.4), (7.35, 0.4))
    level.wall_with_gaps(1.2, -0.15, 7.35, [(3.6, GAP)], "x")
    level.wall((3.2, 1.2), (3.2, 2.15))
    level.wall((4.0, 1.2), (4.0, 2.15))
    return level


def door() -> DraftLevel:
    level = DraftLevel("door")
    for side, x, toward in (("west", 0.4, 1), ("east", 5.2, -1)):
        for part, y in (("south", 0.4), ("middle", 1.2), ("north", 2.0)):
            level.place(f"{side}_{part}", x, y)
        level.place(f"{side}_of_door", x + toward * 1.6, 1.2)
        for part in ("south", "middle", "north"):
            level.lane(f"{side}_{part}", f"{side}_of_door")
    level.lane("west_of_door", "east_of_door")
    level.remark("two rooms")
    level.wall((-0.15, -0.15), (5.75, -0.15), (5.75, 2.55), (-0.15, 2.55), (-0.15, -0.15))
    level.wall_with_gaps(2.8, -0.15, 2.55, [(1.2, GAP)], "y")
    level.door("narrow_door", (2.8, 0.8), (2.8, 1.6), "sliding")
    return level


if __name__ == "__main__":
    write(Path(sys.argv[1]), TITLE, corridor(), swap(), roundabout(), alcove(), door())
