"""Places are found by name, and mistakes in names are explained."""

import pytest

from mrpbench_core.builtin.scenarios.named import Named
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import Vertex, World

WORLD = World(
    name="office",
    levels=(),
    vertices=(
        Vertex(name="pantry", x=1.0, y=2.0),
        Vertex(name="lounge", x=3.0, y=4.0),
        Vertex(name="pantry", x=1.0, y=2.0),
        Vertex(name="coe", x=5.0, y=6.0),
        Vertex(name="coe", x=5.0, y=7.0),
        Vertex(name="", x=8.0, y=8.0),
    ),
)


def draw(starts, goals, corridor, world=WORLD):
    return Named(starts=starts, goals=goals).draw(world, corridor, Fleet(robots=()), 0)


def test_robots_start_and_end_where_the_names_say(corridor):
    scenario = draw(("lounge", "pantry"), ("pantry", "lounge"), corridor)
    assert scenario.start[:, :2].tolist() == [[3, 4], [1, 2]]
    assert [task.goals[0, :2].tolist() for task in scenario.tasks] == [[1, 2], [3, 4]]
    assert scenario.start_names == ("lounge", "pantry")
    assert Named(starts=("lounge", "pantry"), goals=("pantry",)).size() == 2


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("loung", "scenario.goals: world office has no vertex 'loung' (did you mean 'lounge'?)"),
        ("xyz", "scenario.goals: world office has no vertex 'xyz' (names are pantry, lounge, coe)"),
        ("", "scenario.goals: world office has no vertex '' (names are pantry, lounge, coe)"),
        ("coe", "scenario.goals: 'coe' names 2 places: (5.00, 6.00) on level 0, (5.00, 7.00) on level 0"),
    ],
)
def test_a_wrong_name_is_explained(corridor, name, message):
    with pytest.raises(InputError) as error:
        draw(("lounge",), (name,), corridor)
    assert str(error.value) == message


def test_a_world_without_names_is_refused(corridor):
    with pytest.raises(InputError, match=r"scenario\.starts: world bare has no vertex .a. .no vertex of it has a name"):
        draw(("a",), ("b",), corridor, World(name="bare", levels=()))


def test_empty_starts_or_goals_are_refused():
    with pytest.raises(ValueError, match="starts"):
        Named(starts=(), goals=("a",))
