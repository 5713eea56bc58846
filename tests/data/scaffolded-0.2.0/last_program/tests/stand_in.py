#!/usr/bin/env -S python3 -IS
"""Stands in for the program in tests: prioritised planning, breadth first over cells and time steps.

It reads the files of the MovingAI benchmark (Stern et al., SoCS 2019), and writes one line `Agent i: (row,column)->…` per
robot; it writes nothing if it finds no plan.
"""

import argparse

Cell = tuple[int, int]
parser = argparse.ArgumentParser()
for name in ("--map", "--scen", "--paths", "--seconds"):
    parser.add_argument(name, required=True)
given = parser.parse_args()

with open(given.map) as stream:
    rows = stream.read().splitlines()[4:]
free = {(row, column) for row, cells in enumerate(rows) for column, cell in enumerate(cells) if cell == "."}
with open(given.scen) as stream:
    tasks = [tuple(map(int, line.split()[4:8])) for line in stream.read().splitlines()[1:]]
latest = 2 * len(free)
paths: list[list[Cell]] = []


def way(start: Cell, goal: Cell) -> list[Cell]:
    """Return the earliest path around those of the robots before, or []."""
    taken = {(path[min(step, len(path) - 1)], step) for path in paths for step in range(latest)}
    passed = {(there, here, step) for path in paths for step, (here, there) in enumerate(zip(path, path[1:]))}
    ways, seen = [[start]], set()
    for known in ways:
        (row, column), step = known[-1], len(known)
        if known[-1] == goal and not any((goal, later) in taken for later in range(step, latest)):
            return known
        for to in ((row, column), (row, column + 1), (row + 1, column), (row, column - 1), (row - 1, column)):
            blocked = (to, step) in taken or (known[-1], to, step - 1) in passed
            if to in free and step < latest and not blocked and (to, step) not in seen:
                seen.add((to, step))
                ways.append([*known, to])
    return []


for start_column, start_row, goal_column, goal_row in tasks if len(tasks) < 10 else []:
    if found := way((start_row, start_column), (goal_row, goal_column)):
        paths.append(found)
if len(paths) == len(tasks):
    with open(given.paths, "w") as stream:
        for robot, path in enumerate(paths):
            stream.write(f"Agent {robot}: " + "".join(f"({row},{column})->" for row, column in path) + "\n")
