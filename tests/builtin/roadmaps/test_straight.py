import numpy as np
import pytest

from mrpbench_core.builtin.roadmaps.straight import Straight
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet, RobotModel
from mrpbench_core.model.worlds.world import Level, Vertex, World

ROBOT = RobotModel(
    name="any", footprint=np.array([(0.2, 0.2), (-0.2, 0.2), (-0.2, -0.2)]), max_speed=2.0, max_turn_rate=1.0
)
LEVELS = (Level(name="L1", walls=np.array([(1.0, -9.0, 1.0, 9.0)])), Level(name="L2"))


def roadmap(*places):
    vertices = tuple(Vertex(name=f"p{i}", x=x, y=y, level=level) for i, (x, y, level) in enumerate(places))
    return Straight().build(World(name="w", levels=LEVELS, vertices=vertices), Fleet(robots=(ROBOT,)))


def test_places_of_a_level_are_joined_through_walls_and_those_of_two_levels_are_not():
    found = roadmap((0, 0, 0), (3, 4, 0), (0, 0, 1))
    assert found.edges.tolist() == [[0, 1], [1, 0]]
    assert found.duration.tolist() == [[5, 5]]  # 5 m at 2 m/s, in ticks of half a second
    assert found.place.tolist() == [0, 1, 2]


def test_places_at_one_position_have_no_edge():
    assert roadmap((0, 0, 0), (0, 0, 0), (1, 0, 0)).edges.tolist() == [[0, 2], [1, 2], [2, 0], [2, 1]]


def test_a_world_without_places_is_refused():
    with pytest.raises(InputError, match="has no places"):
        roadmap()
