"""The tokens of MAPF-GPT, written down once more from their description."""

import numpy as np
from mrpbench_policies.fleet_state import FleetState, soft
from mrpbench_policies.maps import FAR, Maps
from mrpbench_policies.observations import MapfGptTokens

VOCABULARY = [*range(-20, 21), -80, -40, 40, *"nwudlr", *(f"{mask:04b}" for mask in range(16)), "!"]


def described(blocked, cells, goals, history, robot):
    """The tokens of a robot as words."""
    rows, columns = blocked.shape
    free = {(r, c) for r in range(rows) for c in range(columns) if not blocked[r, c]}

    def ways(goal):
        steps, front = {goal: 0}, [goal]
        for r, c in front:
            for to in ((r - 1, c), (r + 1, c), (r, c - 1), (r, c + 1)):
                if to in free and to not in steps:
                    steps[to] = steps[r, c] + 1
                    front.append(to)
        return steps

    row, column = cells[robot]
    steps, words = ways(goals[robot]), []
    for r in range(row - 5, row + 6):
        for c in range(column - 5, column + 6):
            more = steps[r, c] - steps[row, column] if (r, c) in steps else -80
            words.append(more if (r, c) not in steps or abs(more) <= 20 else (40 if more > 0 else -40))
    near = [i for i, (r, c) in enumerate(cells) if abs(r - row) <= 5 and abs(c - column) <= 5]
    near.sort(key=lambda i: (i != robot, abs(cells[i][0] - row) + abs(cells[i][1] - column), i))
    for i in near[:13]:
        (r, c), (goal_row, goal_column), to = cells[i], goals[i], ways(goals[i])
        around = ((r - 1, c), (r + 1, c), (r, c - 1), (r, c + 1))
        words += [r - row, c - column]
        words += [max(-20, min(20, goal_row - row)), max(-20, min(20, goal_column - column))]
        words += ["nwudlr"[action + 1] for action in history[i]]
        words.append("".join("1" if to.get(cell, FAR) < to[r, c] else "0" for cell in around))
    return words + ["!"] * (256 - len(words))


def test_tokens_say_what_is_around():
    generator = np.random.default_rng(3)
    blocked = generator.random((30, 24)) < 0.25
    maps = Maps(blocked[None], 5)
    component = max((maps.component(int(place)) for place in maps.places(np.argwhere(~blocked))[0][:5]), key=len)
    cells = maps.cells(component)
    start, goal = (generator.permutation(cells)[:60] for _ in range(2))
    state = FleetState.at(maps, maps.places(start[None]), maps.places(goal[None]))
    history = np.full((60, 5), -1)
    for _ in range(7):
        tokens = MapfGptTokens().observe(state)["tokens"]
        places = list(map(tuple, maps.cells(state.place)[0].tolist()))
        for robot in generator.integers(0, 60, 8).tolist():
            words = described(blocked, places, list(map(tuple, goal.tolist())), history, robot)
            assert [VOCABULARY[token] for token in tokens[robot]] == words
        actions = generator.integers(0, 5, 60)
        history = np.column_stack([history[:, 1:], actions])
        state.remember(actions[None])
        state.move(soft(state, state.wishes(actions[None])))
