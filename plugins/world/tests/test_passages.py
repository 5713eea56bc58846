import numpy as np
import pytest
from mrpbench_world.passages import narrow_passages
from mrpbench_worlds_standard.shipped import Household, Office, Warehouse

from mrpbench_core.model.worlds.world import Level, Obstacle


def walls_with_gap(width, angle=0.0, middle=(4.0, 1.0)):
    """A wall of 8 m with a gap of `width` between the ends of its boxes."""
    along = np.array([np.cos(angle), np.sin(angle)])
    ends = [np.array(middle) + along * at for at in (-4, -width / 2 - 0.05, width / 2 + 0.05, 4)]
    return Level(name="", walls=[[*ends[0], *ends[1]], [*ends[2], *ends[3]]])


@pytest.mark.parametrize("angle", [0.0, 0.4, 1.5])
@pytest.mark.parametrize("width", [0.1, 0.2, 0.24])
def test_a_gap_in_a_wall_is_a_passage_of_its_width(width, angle):
    (passage,) = narrow_passages(walls_with_gap(width, angle), 0.25)
    assert passage.width == pytest.approx(width)
    assert np.hypot(passage.x - 4, passage.y - 1) < 0.06


@pytest.mark.parametrize("width", [0.0, 0.08, 0.26, 0.7])
def test_a_wide_gap_and_a_crack_are_not_passages(width):
    assert narrow_passages(walls_with_gap(width), 0.25) == []


def test_a_gap_that_leads_nowhere_is_not_a_passage():
    wall = [[0, 0, 8, 0]]
    shelf = np.array([[3, 0.15], [5, 0.15], [5, 0.6], [3, 0.6]])
    dead_end = Level(name="", walls=[*wall, [2.9, 0, 2.9, 3]], obstacles=(Obstacle(name="", polygon=shelf),))
    assert narrow_passages(dead_end, 0.25) == []


def test_something_in_the_gap_makes_it_two():
    level = walls_with_gap(0.24)
    post = Obstacle(name="", polygon=np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * 0.03 + (4, 1))
    level = Level(name="", walls=level.walls, obstacles=(post,))
    assert [passage.width for passage in narrow_passages(level, 0.25)] == pytest.approx([0.09, 0.09])


def test_a_wider_robot_finds_the_doors_of_a_flat_too_narrow():
    level = Household().load().levels[0]
    assert len([p for p in narrow_passages(level, 0.8) if p.width == pytest.approx(0.7)]) >= 6
    for x, y in ((2, 3.3), (5.2, 3.3), (9.2, 3.3), (4, 4.7), (9.2, 4.7)):
        assert [p for p in narrow_passages(level, 0.8) if abs(p.x - x) < 0.06 and abs(p.y - y) < 0.06], (x, y)


def test_wide_worlds_have_no_narrow_passages():
    for source in (Office(), Warehouse()):
        assert narrow_passages(source.load().levels[0], 0.25) == []
    assert narrow_passages(Level(name=""), 0.25) == []
