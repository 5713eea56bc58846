"""First draft of the built-in world `warehouse_pickers`.

The shipped file is the truth and may have been edited since.
"""

import sys
from itertools import pairwise
from pathlib import Path

from building import DraftLevel, Routine, crowd_sim, write

TITLE = """A warehouse of 24 x 17 m with pickers: five racks, six aisles, three packing stations, four docks.

Pickers walk along an aisle, pick at shelves on both sides, and bring what they have to a packing station.
Edit it here or in the RMF traffic editor."""
RACKS, AISLES, PICKED = (4.0, 8.0, 12.0, 16.0, 20.0), (2.0, 6.0, 10.0, 14.0, 18.0, 22.0), (6.0, 10.0, 14.0, 18.0)
SHELVES = {"south": 6.4, "middle": 9.2, "north": 12.0}
"""y of the shelves at which pickers stop."""
STATIONS = (6.0, 12.0, 18.0)


def routine() -> Routine:
    """Along an aisle from the south to the north, with a chance to have all, then to a packing station."""
    aisles = {f"aisle_{number}_south": 1.0 for number in range(1, len(PICKED) + 1)}
    found: dict[str, tuple[tuple[float, float], dict[str, float]]] = {"packing": ((10, 25), aisles)}
    for number in range(1, len(PICKED) + 1):
        for here, after in pairwise([*SHELVES, "end"]):
            onward = {} if after == "end" else {f"aisle_{number}_{after}": 3.0}
            found[f"aisle_{number}_{here}"] = ((5, 20), {**onward, "packing": 1.0})
    return found


def hall() -> DraftLevel:
    level = DraftLevel("hall")
    for number, x in enumerate(AISLES, 1):
        for name, y in (("front", 4.0), ("south", 7.2), ("north", 10.8), ("rear", 14.8)):
            level.place(f"{name}_{number}", x, y)
        level.lane(f"front_{number}", f"south_{number}", f"north_{number}", f"rear_{number}")
    level.place("front_middle", 12.0, 4.0)
    level.lane("front_1", "front_2", "front_3", "front_middle", "front_4", "front_5", "front_6")
    level.lane(*(f"rear_{number}" for number in range(1, len(AISLES) + 1)))
    for number, (x, stop) in enumerate(zip(STATIONS, ("front_2", "front_middle", "front_5"), strict=True), 1):
        level.place(f"packing_station_{number}", x, 2.4, f"pickup_dispenser=packing_station_{number}")
        level.lane(stop, f"packing_station_{number}")
        level.model("AdjTable", x, 0.9)
    for number, aisle in enumerate((1, 2, 5, 6), 1):
        level.place(f"dock_{number}", AISLES[aisle - 1], 16.0, "is_charger")
        level.lane(f"rear_{aisle}", f"dock_{number}")
    level.people("packing", *((x + side, 1.0) for x in STATIONS for side in (-1.4, 1.4)))
    for number, x in enumerate(PICKED, 1):
        for name, y in SHELVES.items():
            level.people(f"aisle_{number}_{name}", (x - 0.7, y), (x + 0.7, y))
    for x in RACKS:
        for y in (7.2, 11.1):
            level.model("aws_robomaker_warehouse_ShelfD_01", x - 0.45, y, 1.570796)
            level.model("aws_robomaker_warehouse_ShelfE_01", x + 0.45, y, 1.570796)
    level.remark("outer walls")
    level.wall((0, 0), (24, 0), (24, 17), (0, 17), (0, 0))
    return level


if __name__ == "__main__":
    pickers = [(f"aisle_{number}_south", 2, x, 4.8) for number, x in enumerate(PICKED, 1)]
    write(Path(sys.argv[1]), TITLE, hall(), people=crowd_sim(routine(), [*pickers, ("packing", 2, 12.0, 3.2)]))
