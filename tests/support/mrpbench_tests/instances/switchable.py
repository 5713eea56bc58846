"""Situations in which robots are late, as switchable temporal plan graphs.

Feng, Paul, Chen and Li, "A real-time rescheduling algorithm for multi-robot plan execution", ICAPS 2024, and the files
of their STPG benchmark.
"""

import json
import zipfile
from collections import defaultdict
from collections.abc import Hashable, Sequence

import numpy as np

from mrpbench_core.model.common.arrays import Int32

Arc = tuple[int, int, int]
"""Event before, event after, least ticks between them."""


class Switchable:
    """The orders that are still open, for `mrpbench_native.mapf.reorder`.

    The events of a robot are its visits of vertices from its present state on. A move takes one tick. A robot enters a
    vertex at least one tick after the robot before it has reached its next vertex.
    """

    def __init__(
        self, paths: Sequence[Sequence[tuple[Hashable, int]]], states: Sequence[int], delays: Sequence[int]
    ) -> None:
        """Build the graph.

        Args:
            paths: for each robot the vertices and the ticks at which it reaches them in the plan, without waits.
            states: for each robot the index in its path where it is now.
            delays: for each robot the ticks by which its next move is late.
        """
        self.first, self.duration = [0], list[int]()
        self.fixed, self.planned, self.switched = list[Arc](), list[Arc](), list[Arc]()
        visits = defaultdict(list)
        for robot, (path, state) in enumerate(zip(paths, states, strict=True)):
            self.duration += [1 + (delays[robot] if k == state else 0) for k in range(state, len(path))]
            self.first.append(len(self.duration))
            for k, (vertex, tick) in enumerate(path):
                visits[vertex].append((tick, robot, k))
        last = [len(path) - 1 for path in paths]
        for there in visits.values():
            there.sort()
            for index, (_, one, k) in enumerate(there):
                for _, other, m in there[index + 1 :]:
                    if one == other or k < states[one]:
                        continue
                    enters, follows = self.first[one] + k - states[one], self.first[other] + m - states[other]
                    if k == states[one] or m == last[other]:
                        self.fixed.append((enters + 1, follows, 1))
                    else:
                        self.planned.append((enters + 1, follows, 1))
                        self.switched.append((follows + 1, enters, 1))

    def arrays(self) -> dict[str, Int32]:
        """The arguments of `reorder`: `first` i4[n+1], `duration` i4[events], the arcs i4[...,3]."""
        arcs = {"fixed": self.fixed, "planned": self.planned, "switched": self.switched}
        return {
            "first": np.array(self.first, np.int32),
            "duration": np.array(self.duration, np.int32),
            **{name: np.array(found, np.int32).reshape(-1, 3) for name, found in arcs.items()},
        }


def read_situation(archive: zipfile.ZipFile, name: str) -> Switchable:
    """Read a situation of the STPG benchmark, such as `p01/sit/map_random-32-32-10_ins_1_an_60_sit_0.json`."""
    situation = json.loads(archive.read(name))
    plan = archive.read(f"path/{situation['path_file'].rpartition('/')[2]}").decode()
    paths = []
    for line in plan.splitlines():
        if line.startswith("Agent"):
            cells = [cell for cell in line.partition(": ")[2].strip().split("->") if cell]
            paths.append([(cell, tick) for tick, cell in enumerate(cells) if tick == 0 or cells[tick - 1] != cell])
    return Switchable(paths, situation["states"], situation["delay_steps"])
