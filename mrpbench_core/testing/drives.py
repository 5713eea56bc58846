"""Worlds to drive in, and a drive that records everything: for tests that hold one simulator against another."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from mrpbench_core.api.simulator import Simulator
from mrpbench_core.model.execution import Inputs, ScanBatch, State
from mrpbench_core.model.fleet import Fleet, RobotModel
from mrpbench_core.model.occupancy import Occupancy
from mrpbench_core.model.world import Level, Obstacle, World
from mrpbench_core.testing.room import PERIOD

EMPTY = World(name="empty", levels=(Level(name="L1"),))
FURNISHED = World(
    name="furnished",
    levels=(
        Level(
            name="L1",
            walls=np.array([[0, 0, 6, 0], [6, 0, 6, 5], [6, 5, 0, 5], [0, 5, 0, 0], [3, 0, 3, 2], [3, 2, 4, 2.5]]),
            obstacles=(Obstacle(name="crate", polygon=np.array([[1, 3], [1.6, 3.2], [1.2, 3.8]])),),
        ),
    ),
)
"""A room with an inner wall, a bent one, and a triangular crate."""
RASTER = World(
    name="raster",
    levels=(Level(name="L1", occupancy=Occupancy(blocked=np.arange(70).reshape(7, 10) % 6 == 5, cell_size=0.7)),),
)
"""Every sixth cell is blocked."""

ByPeriod = ArrayLike | Callable[[int], ArrayLike]
"""The same in every period, or as a function of its number."""


def drive(
    simulator: Simulator,
    world: World,
    robots: Sequence[RobotModel],
    starts: ArrayLike,
    command: ByPeriod,
    periods: int,
    movers: Sequence[float] = (),
    place: ByPeriod | None = None,
    seed: int = 0,
) -> tuple[list[State], list[ScanBatch]]:
    """States before and after every period, and all scans.

    Args:
        simulator: what moves the robots.
        world: where.
        robots: one model each.
        starts: f8[n,3] metres, radians.
        command: f8[n,2] m/s, rad/s.
        periods: how long.
        movers: radii in metres of what else moves.
        place: f8[m,4] where these are, and how fast.
        seed: of the simulator's noise.
    """
    fleet = Fleet(robots=tuple(robots))
    with simulator.open(world, fleet, np.array(starts, float), seed, PERIOD, movers) as simulation:
        states, scans = [simulation.state], [*simulation.scans()]
        for period in range(periods):
            there = place(period) if callable(place) else place
            twist = np.array(command(period) if callable(command) else command, float)
            around = None if there is None else np.array(there, float)
            states.append(simulation.step(Inputs(twist=twist, movers=around)))
            scans += simulation.scans()
    return states, scans
