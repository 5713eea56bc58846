"""First draft of the built-in world `household`; the shipped file is the truth and may have been edited since.

Lanes lie on multiples of 0.4 m from one another, so that a raster of 0.4 m runs through the middle of its passages.
"""

import sys
from math import pi
from pathlib import Path

from building import DraftLevel, write

TITLE = """A furnished flat of 12.4 × 9.2 m: five rooms on a hall, doors and passages between furniture 0.7 m wide.

Edit it here or in the RMF traffic editor. Walls are 0.1 m thick boxes around their lines."""
GAP = 0.8
"""Between the ends of the lines of two walls that leave 0.7 m."""
LOW, HIGH = 3.3, 4.7
"""The walls of the hall."""


def draft(file: Path) -> None:
    """Write the building file."""
    level = DraftLevel("L1")
    places(level)
    walls(level)
    furniture(level)
    write(file, TITLE, level)


def places(level: DraftLevel) -> None:
    for name, x, y in (
        ("front_door", 0.4, 4), ("coat_rack", 2, 4), ("hall_west", 4, 4), ("hall_middle", 5.2, 4),
        ("hall_east", 9.2, 4), ("ironing_board", 11.6, 4), ("bedroom", 2, 2.4), ("between_the_beds", 2, 0.8),
        ("dresser", 3.6, 2.4),
        ("bathroom", 5.2, 2.4), ("shower", 5.2, 0.8), ("nursery", 9.2, 2.4), ("nursery_window", 9.2, 0.8),
        ("toys", 7.6, 2.4), ("nursery_desk", 7.6, 1.6), ("wardrobe", 11.2, 2.4),
        ("living_room", 4, 5.6), ("kitchen", 0.8, 5.6),
        ("stove", 0.8, 6.8), ("sink", 0.8, 8), ("balcony", 4, 8.4), ("television", 6, 5.6), ("sofa", 6, 7.6),
        ("bay_window", 6, 8.4), ("study", 9.2, 5.6), ("writing_desk", 9.2, 7.6), ("armchair", 10.8, 5.6),
        ("bookshelf", 10.8, 7.6),
    ):  # fmt: skip
        level.place(name, x, y, *(("is_charger", "is_parking_spot") if name in ("coat_rack", "ironing_board") else ()))
    level.lane("front_door", "coat_rack", "hall_west", "hall_middle", "hall_east", "ironing_board")
    level.lane("coat_rack", "bedroom", "between_the_beds")
    level.lane("bedroom", "dresser")
    level.lane("hall_middle", "bathroom", "shower")
    level.lane("hall_east", "nursery", "nursery_window")
    level.lane("nursery_desk", "toys", "nursery", "wardrobe")
    level.lane("hall_west", "living_room", "kitchen", "stove", "sink")
    level.lane("living_room", "balcony", "bay_window", "sofa", "television", "living_room")
    level.lane("hall_east", "study", "writing_desk", "bookshelf", "armchair", "study")


def walls(level: DraftLevel) -> None:
    left, right, bottom, top = -0.15, 12.15, -0.15, 8.95
    level.remark("outer walls; the front door is in the west")
    level.wall((left, bottom), (right, bottom), (right, top), (left, top))
    level.wall_with_gaps(left, bottom, top, [(4, GAP)], "y")
    level.remark("hall, south side: doors of bedroom, bathroom, nursery")
    level.wall_with_gaps(LOW, left, right, [(2, GAP), (5.2, GAP), (9.2, GAP)], "x")
    level.remark("hall, north side: doors of living room, study")
    level.wall_with_gaps(HIGH, left, right, [(4, GAP), (9.2, GAP)], "x")
    level.remark("bedroom | bathroom | nursery")
    level.wall((4.2, bottom), (4.2, LOW))
    level.wall((6.6, bottom), (6.6, LOW))
    level.remark("living room | study")
    level.wall((7.8, HIGH), (7.8, top))
    half = GAP / 2
    level.door("front_door", (left, 4 - half), (left, 4 + half), direction=-1)  # opens outwards
    for name, x, y in (("bedroom", 2, LOW), ("bathroom", 5.2, LOW), ("nursery", 9.2, LOW),
                       ("living_room", 4, HIGH), ("study", 9.2, HIGH)):  # fmt: skip
        level.door(f"{name}_door", (x - half, y), (x + half, y), "sliding")  # an open leaf would bar the hall


def furniture(level: DraftLevel) -> None:
    for x in (1.1, 2.9):
        level.model("NormalBed", x, 1.0, pi / 2)
    level.model("BedsideTable", 0.2, 0.2)
    level.model("WhiteCabinet", 3.6, 2.95, pi / 2)
    level.model("Toilet", 4.5, 1.5)
    level.model("BathroomSink", 6.25, 2.2)
    level.model("Shower", 6.1, 0.4)
    level.model("NormalBed", 10.9, 0.6)
    level.model("Desk", 7.6, 0.3, pi / 2)
    level.model("Drawer", 6.95, 2.9)
    level.model("WhiteCabinet", 11.85, 2.4)
    level.model("KitchenCountertop", 0.125, 6.4)
    level.model("KitchenSink", 0.125, 7.6)
    level.model("Fridge", 0.15, 8.55)
    level.model("Table", 1.9, 7.2)
    for x in (1.5, 2.3):
        level.model("Chair", x, 6.5)
        level.model("Chair", x, 7.9)
    level.model("Sofa", 6.8, 7.4)
    level.model("CoffeeTable", 5.35, 7.4)
    level.model("Drawer", 7.45, 5.1)
    level.model("AdjTable", 9.2, 8.45)
    level.model("OfficeChairBlue", 8.35, 7.4)
    level.model("Bookshelf", 11.9, 7.6, pi / 2)
    level.model("Bookshelf", 11.9, 6.6, pi / 2)
    level.model("MiniSofa", 11.65, 5.3)
    level.model("LampAndStand", 8.2, 5.1)


if __name__ == "__main__":
    draft(Path(sys.argv[1]))
