"""The planes of PRIMAL and SCRIMP, drawn once more cell by cell, as their published environments do."""

import math

import numpy as np
import pytest
from mrpbench_policies.fleet_state import FleetState, soft
from mrpbench_policies.maps import Maps
from mrpbench_policies.observations import Primal, Scrimp

AROUND = ((-1, 0), (1, 0), (0, -1), (0, 1))


def steps_to(goal, free):
    steps, front = {goal: 0}, [goal]
    for row, column in front:
        for down, right in AROUND:
            to = row + down, column + right
            if to in free and to not in steps:
                steps[to] = steps[row, column] + 1
                front.append(to)
    return steps


def drawn(free, robots, goals, robot, reach):
    """The planes of a robot, nearer cells last, and its vector; `robots` are cells, None for those that have left."""
    at = robots[robot]
    cells = [[(at[0] + down, at[1] + right) for right in reach] for down in reach]
    near = {cell for line in cells for cell in line}
    others = [i for i, cell in enumerate(robots) if i != robot and cell in near]

    def inside(goal):
        return tuple(max(here + reach[0], min(here + reach[-1], to)) for here, to in zip(at, goal, strict=True))

    shown = {inside(goals[i]) for i in others}
    steps = steps_to(goals[robot], free)

    def nearer(cell, action):
        to = cell[0] + AROUND[action][0], cell[1] + AROUND[action][1]
        return cell in steps and to in steps and steps[to] < steps[cell]

    planes = [
        [[cell in robots for cell in line] for line in cells],
        [[cell == goals[robot] for cell in line] for line in cells],
        [[cell in shown for cell in line] for line in cells],
        [[cell not in free for cell in line] for line in cells],
        *([[nearer(cell, action) for cell in line] for line in cells] for action in range(4)),
    ]
    away = [to - here for here, to in zip(at, goals[robot], strict=True)]
    distance = math.hypot(*away)
    return np.array(planes, float), [*(it / (distance or 1) for it in away), distance]


@pytest.mark.parametrize("radius", [1, 3, 6])
def test_planes_are_those_of_the_published_environments(radius):
    generator = np.random.default_rng(radius)
    blocked = generator.random((2, 9, 11)) < 0.25
    maps = Maps(blocked, radius)
    free = [{tuple(cell) for cell in np.argwhere(~one).tolist()} for one in blocked]
    start, goal = (np.stack([generator.permutation(sorted(cells))[:12] for cells in free]) for _ in range(2))
    state = FleetState.at(maps, maps.places(start), maps.places(goal))
    for _ in range(5):
        state.active &= generator.random((2, 12)) < 0.95
        primal, scrimp = Primal(radius).observe(state), Scrimp(radius).observe(state)
        cells = maps.cells(state.place).tolist()
        for environment, robot in np.argwhere(state.active).tolist():
            active = state.active[environment]
            robots = [tuple(cell) if there else None for cell, there in zip(cells[environment], active, strict=True)]
            goals = list(map(tuple, goal[environment].tolist()))
            row = environment * 12 + robot
            planes, _ = drawn(free[environment], robots, goals, robot, range(-radius, radius + 1))
            np.testing.assert_array_equal(scrimp["observation"][row], planes)
            planes, vector = drawn(free[environment], robots, goals, robot, range(-radius, radius))
            np.testing.assert_array_equal(primal["observation"][row], planes[:4])
            np.testing.assert_allclose(primal["goal"][row], vector, rtol=1e-6)
            np.testing.assert_array_equal(scrimp["goal"][row], primal["goal"][row])
        state.move(soft(state, state.wishes(generator.integers(0, 5, (2, 12)))))


def test_a_robot_at_its_goal_has_no_direction():
    maps = Maps(np.zeros((1, 2, 2), bool), 1)
    there = maps.places(np.array([[(0, 1)]]))
    observed = Primal(1).observe(FleetState.at(maps, there, there))
    assert observed["goal"].tolist() == [[0.0, 0.0, 0.0]]
    assert observed["observation"][0, 1].tolist() == [[0, 0], [0, 1]]
