"""Worlds and drives that several tests share."""

import numpy as np

from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.execution import Inputs
from mrpbench_core.model.fleet import Fleet
from mrpbench_core.model.occupancy import Occupancy
from mrpbench_core.model.world import Level, Obstacle, World

PERIOD = 0.05
BURGER = load_robot("turtlebot3_burger")
WAFFLE = load_robot("turtlebot3_waffle")
EMPTY = World(name="empty", levels=(Level(name="L1"),))
ROOM = World(
    name="room",
    levels=(
        Level(
            name="L1",
            walls=[[0, 0, 6, 0], [6, 0, 6, 5], [6, 5, 0, 5], [0, 5, 0, 0], [3, 0, 3, 2], [3, 2, 4, 2.5]],
            obstacles=(Obstacle(name="crate", polygon=[[1, 3], [1.6, 3.2], [1.2, 3.8]]),),
        ),
    ),
)
RASTER = World(
    name="raster",
    levels=(Level(name="L1", occupancy=Occupancy(blocked=np.arange(70).reshape(7, 10) % 6 == 5, cell_size=0.7)),),
)
STARTS = [[1, 1, 0.3], [2.3, 1.7, 2], [4.4, 1, -1], [5, 4, 3], [2.5, 4.2, -2.5], [1.75, 1.2, 1]]


def drive(simulator, world, robots, starts, command, periods, movers=(), place=None, seed=0):
    """States before and after every period, and all scans; `command` and `place` may be functions of the period."""
    with simulator.open(world, Fleet(robots=robots), np.array(starts, float), seed, PERIOD, movers) as simulation:
        states, scans = [simulation.state], [*simulation.scans()]
        for period in range(periods):
            twist = np.array(command(period) if callable(command) else command, float)
            there = place(period) if callable(place) else place
            states.append(simulation.step(Inputs(twist=twist, movers=there)))
            scans += simulation.scans()
    return states, scans
