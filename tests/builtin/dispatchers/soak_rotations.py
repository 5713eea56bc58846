"""Rotates rings of robots many times in all simulators and counts contacts: `soak_rotations.py ROTATIONS SEED`."""

import argparse
import sys
from collections import defaultdict
from functools import partial

import attrs
from mrpbench_controllers_dwb import Dwb
from mrpbench_controllers_pure_pursuit import PurePursuit
from mrpbench_simulators_planar import Planar
from mrpbench_simulators_pybullet import PyBullet
from mrpbench_tests.execution.rings import rotate

from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.builtin.simulators.kinematic import Kinematic

SIMULATORS = {
    "kinematic": (Kinematic, 20),
    "planar": (Planar, 40),
    "pybullet": (partial(PyBullet, model="wheels"), 4),
}
"""Each with the number of rings that rotate at once."""
CONTROLLERS = {"pure_pursuit": PurePursuit, "dwb": Dwb}
CELLS = (0.4, 0.45, 0.62, 1.0)
"""metres; a `turtlebot3_burger` may rotate on the first only because its navigator keeps a few centimetres."""
COLUMNS = (2, 2, 3)
"""Rings go around two rows of so many cells."""
TURNS = 25
"""Rotations of each ring."""


@attrs.define
class Total:
    """Sums over all rings of a simulator and a controller."""

    rotations: int = 0
    missing: int = 0
    contacts: int = 0
    gaps: dict[float, float] = attrs.field(factory=dict)
    """Smallest distance in metres between two robots, for each size of cells."""


def main() -> int:
    """Run every pair of simulator and controller until there are enough rotations.

    Returns 0 if no robots touched and all rotations were completed.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("rotations", type=int)
    parser.add_argument("seed", type=int)
    given = parser.parse_args()
    totals: dict[tuple[str, str], Total] = defaultdict(Total)
    seed = given.seed
    while sum(total.rotations for total in totals.values()) < given.rotations:
        cell, columns = CELLS[seed % len(CELLS)], COLUMNS[seed % len(COLUMNS)]
        for simulator, (simulate, rings) in SIMULATORS.items():
            for controller in CONTROLLERS:
                total = totals[simulator, controller]
                found = rotate(
                    Adg(),
                    CONTROLLERS[controller](),
                    simulate(),
                    cell=cell,
                    rings=rings,
                    turns=TURNS,
                    columns=columns,
                    seed=seed,
                )
                total.rotations += found.rotations
                total.missing += rings * TURNS - found.rotations
                total.contacts += found.contacts
                total.gaps[cell] = min(total.gaps.get(cell, found.gap), found.gap)
                gaps = ", ".join(f"{gap:.4f} m on {side} m" for side, gap in sorted(total.gaps.items()))
                print(
                    f"seed {seed}: {simulator:9} {controller:12} {total.rotations} rotations, {total.missing} not "
                    f"completed, {total.contacts} contacts; smallest gaps {gaps}",
                    flush=True,
                )
        seed += 1
    return int(any(total.contacts or total.missing for total in totals.values()))


if __name__ == "__main__":
    sys.exit(main())
