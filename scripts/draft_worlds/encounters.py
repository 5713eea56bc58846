"""First draft of the built-in world `encounters`; the shipped file is the truth and may have been edited since.

Lanes lie on multiples of 0.4 m.
"""

import sys
from pathlib import Path

from building import DraftLevel, write

TITLE = """Minimal cases in which a robot meets people, one level each.

The robot goes from `robot` to `robot_goal`, a person from `person` to `person_goal`.
Edit it here or in the RMF traffic editor."""


def corridor(name: str, length: float, width: float, **places: float) -> DraftLevel:
    """A straight corridor with these places on its middle line, from west to east."""
    level = DraftLevel(name)
    for place, x in places.items():
        level.place(place, x, 1.2)
    level.lane(*places)
    south, north = 1.2 - width / 2, 1.2 + width / 2
    level.remark(f"{width:g} m wide")
    level.wall((0.2, south), (0.2 + length, south), (0.2 + length, north), (0.2, north), (0.2, south))
    return level


def crossing() -> DraftLevel:
    """At 0.22 and 1.34 m/s both need about 12 s to the middle."""
    level = DraftLevel("crossing")
    for name, x, y in (("robot", 1.2, 4.0), ("middle", 4.0, 4.0), ("robot_goal", 7.2, 4.0),
                       ("person", 4.0, 20.8), ("person_goal", 4.0, 0.8)):  # fmt: skip
        level.place(name, x, y)
    level.lane("robot", "middle", "robot_goal")
    level.lane("person", "middle", "person_goal")
    level.remark("two corridors of 2 m")
    level.wall((0, 3), (3, 3), (3, 0), (5, 0), (5, 3), (8, 3), (8, 5), (5, 5), (5, 22), (3, 22), (3, 5), (0, 5), (0, 3))
    return level


def blind_corner() -> DraftLevel:
    level = DraftLevel("blind_corner")
    for name, x, y in (("person_goal", 0.8, 0.8), ("robot", 1.6, 0.8), ("corner", 6.4, 0.8),
                       ("robot_goal", 6.4, 5.6), ("person", 6.4, 6.4)):  # fmt: skip
        level.place(name, x, y)
    level.lane("person_goal", "robot", "corner", "robot_goal", "person")
    level.remark("two corridors of 1.5 m")
    level.wall((0.1, 0.05), (7.15, 0.05), (7.15, 7.15), (5.65, 7.15), (5.65, 1.55), (0.1, 1.55), (0.1, 0.05))
    return level


def doorway() -> DraftLevel:
    level = DraftLevel("doorway")
    for name, x in (("person_goal", 0.8), ("robot", 1.6), ("doorway", 4.0), ("robot_goal", 6.4), ("person", 7.2)):
        level.place(name, x, 2.0)
    level.lane(*level.places)
    level.remark("two rooms, 0.9 m between the faces of the wall")
    level.wall((0, 0), (8, 0), (8, 4), (0, 4), (0, 0))
    level.wall_with_gaps(4.0, 0.0, 4.0, [(2.0, 1.0)], "y")
    return level


def group() -> DraftLevel:
    level = DraftLevel("group")
    for name, x, y in (("robot", 0.8, 2.8), ("robot_goal", 7.2, 2.8), ("person", 4.0, 3.6),
                       ("person_2", 3.2, 2.4), ("person_3", 4.8, 2.4)):  # fmt: skip
        level.place(name, x, y)
    level.lane("robot", "robot_goal")
    for name in ("person", "person_2", "person_3"):
        level.lane("robot", name)
    level.remark("a room")
    level.wall((0, 0), (8, 0), (8, 6), (0, 6), (0, 0))
    return level


if __name__ == "__main__":
    ends = {"person_goal": 0.8, "robot": 1.6, "robot_goal": 8.8, "person": 9.6}
    write(
        Path(sys.argv[1]),
        TITLE,
        crossing(),
        corridor("head_on", 10.0, 2.0, **ends),
        corridor("narrow", 10.0, 1.2, **ends),
        corridor("overtaking", 14.0, 2.0, person=0.8, robot=1.6, robot_goal=12.8, person_goal=13.6),
        blind_corner(),
        doorway(),
        group(),
    )
