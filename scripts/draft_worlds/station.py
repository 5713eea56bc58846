"""First draft of the built-in world `station`; the shipped file is the truth and may have been edited since."""

import sys
from pathlib import Path

from building import DraftLevel, write

TITLE = """A station hall of 36 x 16 m: three entrances, stairs to four platforms, kiosks, pillars, two docks of robots.

Edit it here or in the RMF traffic editor."""
SPINE = (3.2, 8.0, 12.8, 17.6, 22.4, 27.2, 32.0)


def box(level: DraftLevel, left: float, bottom: float, right: float, top: float) -> None:
    level.wall((left, bottom), (right, bottom), (right, top), (left, top), (left, bottom))


def hall() -> DraftLevel:
    level = DraftLevel("hall")
    for number, x in enumerate(SPINE):
        level.place(f"hall_{number + 1}", x, 8.0)
    for name, x, y, hub in (
        ("west_entrance", 1.2, 8.0, 1), ("east_entrance", 34.8, 8.0, 7), ("south_entrance", 17.6, 1.2, 4),
        ("platform_1", 3.2, 14.4, 1), ("platform_2", 12.8, 14.4, 3), ("platform_3", 22.4, 14.4, 5),
        ("platform_4", 32.0, 14.4, 7), ("tickets", 3.2, 2.0, 1), ("lockers", 32.0, 2.0, 7),
        ("bakery", 12.8, 4.4, 3), ("newsagent", 22.4, 4.4, 5), ("dock_1", 8.0, 1.6, 2), ("dock_2", 27.2, 1.6, 6),
        ("benches", 17.6, 13.6, 4),
    ):  # fmt: skip
        level.place(name, x, y)
        level.lane(name, f"hall_{hub}")
    level.lane(*(f"hall_{number + 1}" for number in range(len(SPINE))))
    level.remark("outer walls")
    box(level, 0, 0, 36, 16)
    level.remark("stairs between the platforms")
    for left, right in ((5.2, 10.8), (14.8, 16.0), (19.2, 20.4), (24.4, 30.0)):
        box(level, left, 13.0, right, 16)
    level.remark("bakery and newsagent")
    for left, right in ((10.8, 14.8), (20.4, 24.4)):
        box(level, left, 1.0, right, 3.4)
    level.remark("pillars")
    for x in (5.6, 10.4, 15.2, 20.0, 24.8, 29.6):
        for y in (6.2, 9.8):
            box(level, x - 0.3, y - 0.3, x + 0.3, y + 0.3)
    return level


if __name__ == "__main__":
    write(Path(sys.argv[1]), TITLE, hall())
