"""Rotates rings of robots many times in simulators and counts contacts: `soak_rotations.py ROTATIONS SEED`."""

import argparse
import sys

from mrpbench_controllers_dwb import Dwb
from mrpbench_controllers_pure_pursuit import PurePursuit
from mrpbench_simulators_planar import Planar

from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.testing.execution.rings import rotate

CELLS = (0.62, 0.7, 0.8, 1.0)
RINGS = 25
TURNS = {PurePursuit: 20, Dwb: 1}
"""Rotations of each ring; `dwb` takes long."""


def main() -> int:
    """Run every pair of simulator and controller until there are enough rotations; return 0 if nobody touched."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("rotations", type=int)
    parser.add_argument("seed", type=int)
    given = parser.parse_args()
    pairs = [(simulator, controller) for simulator in (Kinematic, Planar) for controller in (PurePursuit, Dwb)]
    done, contacts, missing, seed = 0, 0, 0, given.seed
    while done < given.rotations:
        for simulator, controller in pairs:
            cell = CELLS[seed % len(CELLS)]
            found = rotate(Adg(), controller(), simulator(), cell=cell, rings=RINGS, turns=TURNS[controller], seed=seed)
            done, contacts = done + found.rotations, contacts + found.contacts
            missing += RINGS * TURNS[controller] - found.rotations
            print(simulator.__name__, controller.__name__, f"cell {cell}, seed {seed}:", found, flush=True)
        print(f"{done} rotations, {contacts} contacts, {missing} rotations not completed", flush=True)
        seed += 1
    return int(contacts > 0)


if __name__ == "__main__":
    sys.exit(main())
