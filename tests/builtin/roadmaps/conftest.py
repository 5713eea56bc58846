"""Robots and small worlds for roadmaps."""

import numpy as np
import pytest

from mrpbench_core.model.common.fleet import Fleet, RobotModel
from mrpbench_core.model.worlds.world import Lane, Level, Vertex, World


@pytest.fixture(scope="session")
def make_fleet():
    def make(*radii, speeds=None, graphs=None) -> Fleet:
        corners = np.array([[1, 0], [0, 1], [-1, 0], [0, -1]])
        speeds = speeds or [0.2] * len(radii)
        return Fleet(
            robots=tuple(
                RobotModel(
                    name=f"disc_{radius}", footprint=radius * corners, max_speed=speed, max_turn_rate=1.0, graph=graph
                )
                for radius, speed, graph in zip(radii, speeds, graphs or [None] * len(radii), strict=True)
            )
        )

    return make


@pytest.fixture
def two_rooms() -> World:
    """6 m x 4 m, a wall with a gap of 1 m in the middle (x = 3, y from 1 to 2), a lane through it."""
    walls = [[0, 0, 6, 0], [6, 0, 6, 4], [6, 4, 0, 4], [0, 4, 0, 0], [3, 0, 3, 1], [3, 2, 3, 4]]
    return World(
        name="two rooms",
        levels=(Level(name="L1", walls=walls),),
        vertices=(Vertex(name="west", x=1, y=1.5), Vertex(name="east", x=5, y=1.5)),
        lanes=(Lane(start=0, end=1),),
    )
