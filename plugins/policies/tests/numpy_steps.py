"""What `mrpbench_native.grid` computes, in NumPy: the oracle of tests."""

import numpy as np


def occupants(state):
    """Return i4[b*size]: the index of the active robot at each place, -1 = none."""
    found, active = np.full(len(state.maps.blocked), -1, np.int32), state.active.ravel()
    found[state.place.ravel()[active]] = np.flatnonzero(active)
    return found


def soft(state, wish):
    """Return where the robots are after a step, see `mrpbench_policies.fleet_state.soft`."""
    place, to = state.place.ravel(), wish.ravel()
    index = np.arange(len(place), dtype=np.int32)
    stays = ~state.active.ravel() | state.maps.blocked[to]
    to = np.where(stays, place, to)
    occupant = occupants(state)
    other = occupant[to]
    swap = (other >= 0) & (other != index)
    swap &= to[other] == place
    stays |= swap | (to == place)
    movers = index[~stays]
    aims = to[movers]
    ahead = occupant[aims]
    first = np.zeros(len(state.maps.blocked), np.int32)
    first[aims[::-1]] = movers[::-1]  # of equal places the last one counts, which is that of the first robot
    lost = first[aims] != movers
    stays[movers[lost]] = True
    follows = ~lost & (ahead >= 0)
    movers, ahead = movers[follows], ahead[follows]
    while (hindered := stays[ahead]).any():
        stays[movers[hindered]] = True
        movers, ahead = movers[~hindered], ahead[~hindered]
    return np.where(stays, place, to).reshape(wish.shape)


def overwritten(state, to):
    """Return which robots enter the cell of one with a higher index."""
    index = np.arange(to.size, dtype=np.int32).reshape(to.shape)
    return (occupants(state)[to] > index) & state.active


def free_actions(state, moving):
    """Return the sums of the bits of actions that lead to free cells."""
    free = ~state.maps.blocked[state.place[..., None] + state.maps.offset]
    return np.where(moving, 1, (free << np.arange(5)).sum(axis=-1)).astype(np.uint8)


def pogema(state, radius):
    """Return the windows of POGEMA's observation `default`, cut out of whole maps one by one."""
    maps, side = state.maps, 2 * radius + 1
    obstacles = maps.blocked.reshape(maps.count, maps.height, maps.width).astype(np.float32)
    robots = np.zeros(len(maps.blocked), np.float32)
    robots[state.place[state.active & ~state.overwritten]] = 1.0
    robots = robots.reshape(obstacles.shape)
    environments, count = state.place.shape
    windows = np.zeros((environments, count, 3, side, side), np.float32)
    cells, goals = maps.cells(state.place) + maps.margin - radius, maps.cells(state.goal) + maps.margin - radius
    for environment, robot in np.ndindex(environments, count):
        row, column = cells[environment, robot].tolist()
        window = slice(row, row + side), slice(column, column + side)
        windows[environment, robot, 0] = obstacles[environment][window]
        windows[environment, robot, 1] = robots[environment][window]
        down, right = np.clip(goals[environment, robot] - (row, column), -radius, radius) + radius
        windows[environment, robot, 2, down, right] = 1.0
    return windows.reshape(-1, 3, side, side)
