"""First draft of the built-in world `airport`; the shipped file is the truth and may have been edited since.

Width, height, places, lanes and the extent of the roads are those of Table I of Schaefer et al., "A Benchmark for
Multi-Robot Planning in Realistic, Complex and Cluttered Environments", ICRA 2023; the building is our own.
"""

import sys
from math import pi
from pathlib import Path

from building import DraftLevel, write

TITLE = """An airport terminal of 282 × 64 m: two concourses with 56 gates, shops between them; 210 places, 211 lanes.

Edit it here or in the RMF traffic editor. Walls are 0.1 m thick boxes around their lines."""
WIDTH, HEIGHT = 281.9, 63.9
SOUTH, NORTH = 20.0, 44.0
STOPS = [6.0 + 10 * index for index in range(28)]
CONNECTORS = {0: "west", 13: "central", 27: "east"}
SHOPS = (
    "bookshop", "bakery", "pharmacy", "bureau_de_change", "chocolatier", "florist", "toy_shop", "newsagent",
    "watchmaker", "perfumery", "noodle_bar", "juice_bar", "tea_room", "pizzeria", "salad_bar", "ice_cream",
    "sushi_bar", "brewery", "prayer_room", "nursery", "business_lounge", "silver_lounge", "gold_lounge",
    "reading_lounge", "cinema", "spa", "barber", "gallery", "first_aid", "lost_property", "tourist_office",
    "car_rental", "hotel_desk", "luggage_lockers", "rail_office", "chapel",
)  # fmt: skip


def draft(file: Path) -> None:
    """Write the building file."""
    level = DraftLevel("L1")
    concourses(level)
    for side, y, outward in (("south", SOUTH, -1), ("north", NORTH, 1)):
        gates(level, side, y, outward)
    shops(level)
    shell(level)
    write(file, TITLE, level)


def concourses(level: DraftLevel) -> None:
    for side, y in (("south", SOUTH), ("north", NORTH)):
        names = [level.place(f"{side}_concourse_{k + 1}", x, y) for k, x in enumerate(STOPS)]
        level.lane(*names)
    for k, name in CONNECTORS.items():
        x = STOPS[k]
        inner = [level.place(f"{name}_passage_{part}", x, y) for part, y in (("south", 28), ("north", 36))]
        level.lane(f"south_concourse_{k + 1}", *inner, f"north_concourse_{k + 1}")


def gates(level: DraftLevel, side: str, y: float, outward: int) -> None:
    """Behind each stop a gate room: a desk inside its door, and seats or a jet bridge."""
    letter = "a" if side == "south" else "b"
    back = 0.0 if side == "south" else HEIGHT
    front = y + outward * 5
    walls = []
    for k, x in enumerate(STOPS):
        parameters = ("is_charger", "is_parking_spot") if k % 9 == 4 else ()
        desk = level.place(f"gate_{letter}{k + 1}", x, y + outward * 8)
        turn = k % 4 < 2
        seat = (x, y + outward * 13) if turn else (x + (3 if k % 4 == 2 else -3), y + outward * 8)
        inner = level.place(f"{'jet_bridge' if turn else 'seats'}_{letter}{k + 1}", *seat, *parameters)
        level.lane(f"{side}_concourse_{k + 1}", desk, inner)
        for dx in (-2.6, 2.6) if turn else ():
            for dy in (10, 12.5):
                level.model("WaitingChair", x + dx, y + outward * dy)
        for dx in () if turn else (-2.4, 0.0, 2.4):
            level.model("WaitingChair", x + dx, y + outward * 11.5, pi / 2)
        walls.append(x + 5)
    level.remark(f"gates of the {side} concourse")
    level.wall_with_gaps(front, 0.0, WIDTH, [(x, 3.1) for x in STOPS], "x")
    for x in walls[:-1]:
        level.wall((x, back), (x, front))


def shops(level: DraftLevel) -> None:
    """Shops open to the south concourse, lounges to the north one."""
    stops = [k for k in range(28) if k not in (0, 6, 7, 13, 14, 20, 21, 26, 27, 1)]
    names = iter(SHOPS)
    for side, y, inward in (("south", SOUTH, 1), ("north", NORTH, -1)):
        front, back = y + inward * 4, y + inward * 10
        level.remark(f"shops on the {side} concourse")
        for k in stops:
            x = STOPS[k]
            level.place(name := next(names), x, y + inward * 6)
            level.lane(f"{side}_concourse_{k + 1}", name)
            level.wall_with_gaps(front, x - 5, x + 5, [(x, 3.1)], "x")
            level.wall((x - 5, back), (x + 5, back))
            level.wall((x - 5, front), (x - 5, back))
            if k + 1 not in stops:
                level.wall((x + 5, front), (x + 5, back))
            for dx in (-3.5, 3.5):
                level.model("Bookshelf" if side == "south" else "Sofa", x + dx, y + inward * 6.5)
            level.model("NurseDesk", x, y + inward * 9, pi / 2)


def shell(level: DraftLevel) -> None:
    level.remark("outer walls")
    corners = [(0.0, 0.0), (WIDTH, 0.0), (WIDTH, HEIGHT), (0.0, HEIGHT), (0.0, 0.0)]
    level.wall(*corners)
    level.remark("check-in and baggage halls beside the passages")
    for x in (71.0, 211.0):
        level.wall((x - 5, 24), (x + 5, 24), (x + 5, 40), (x - 5, 40), (x - 5, 24))
    level.model("Fountain", 146, 32)
    for x in (16.0, 26.0, 256.0, 266.0):
        level.model("Pine Tree", x, 32)


if __name__ == "__main__":
    draft(Path(sys.argv[1]))
