"""MovingAI scenarios land on the right cells."""

import numpy as np
import pytest
from mrpbench_worlds_standard.movingai_scenario import MovingAiScenario

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Level, World
from mrpbench_core.testing.drawing import grid

BLOCKED = np.zeros((2, 3), bool)
BLOCKED[0, 0] = True  # lowest row, first column
WORLD = World(
    name="tiny",
    levels=(Level(name="L1", occupancy=Occupancy(blocked=BLOCKED, resolution=0.5, origin=(10.0, 20.0))),),
)
ROW = "0\ttiny.map\t3\t2\t{}\t{}\t{}\t{}\t1.5\n"


def draw(tmp_path, text, robots=1, world=WORLD):
    path = tmp_path / "tiny.scen"
    path.write_text(text)
    return MovingAiScenario(file=path, robots=robots).draw(world, grid(2, 3), Fleet(robots=()), 0)


def test_columns_count_from_the_left_and_rows_from_the_top(tmp_path):
    text = "version 1\n" + ROW.format(0, 0, 2, 1) + ROW.format(1, 1, 2, 0) + ROW.format(9, 9, 9, 9)
    scenario = draw(tmp_path, text, robots=2)
    assert scenario.start[:, :2].tolist() == [[10.25, 20.75], [10.75, 20.25]]
    assert [task.goals[0, :2].tolist() for task in scenario.tasks] == [[11.25, 20.25], [11.25, 20.75]]
    assert np.isnan(scenario.start[:, 2]).all()


def test_blanks_separate_fields_too(tmp_path):
    scenario = draw(tmp_path, "version 1.0\n\n0 tiny.map 3 2 1 0 2 0 1\n")
    assert scenario.start[0, :2].tolist() == [10.75, 20.75]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", ":1: is not a MovingAI scenario: the first line is not 'version 1'"),
        ("type octile\n", ":1: is not a MovingAI scenario: the first line is not 'version 1'"),
        ("version 1\n", ": has 0 rows, too few for 1 robots"),
        ("version 1\n0\ttiny.map\t3\t2\t0\n", ":2: a row has 9 fields, this one 5"),
        ("version 1\n" + ROW.format("x", 0, 1, 1), ":2: map size, start and goal must be whole numbers"),
        ("version 1\n\n" + ROW.format(0, 1, 1, 1), ":3: start (0, 1) is blocked"),
        ("version 1\n" + ROW.format(1, 1, 0, 1), ":2: goal (0, 1) is blocked"),
        ("version 1\n" + ROW.format(1, 1, 3, 1), ":2: goal (3, 1) lies outside the map of 3 x 2 cells"),
        ("version 1\n" + ROW.format(1, 1, -1, 1), ":2: goal (-1, 1) lies outside the map of 3 x 2 cells"),
        ("version 1\n0 m 4 4 0 0 1 1 1\n", ":2: is for a map of 4 x 4 cells, the world has 3 x 2"),
    ],
)
def test_a_mistake_is_located(tmp_path, text, message):
    with pytest.raises(InputError) as error:
        draw(tmp_path, text)
    assert str(error.value) == f"{tmp_path / 'tiny.scen'}{message}"


def test_a_world_without_a_raster_is_refused(tmp_path):
    with pytest.raises(InputError, match="world walls is not a raster"):
        draw(tmp_path, "version 1\n", world=World(name="walls", levels=(Level(name="L1"),)))


@pytest.mark.parametrize("name", ["random-32-32-20", "den312d", "Berlin_1_256"])
def test_the_published_instances_stand_on_free_cells(shared_data, name):
    folder = shared_data / "movingai"
    lines = (folder / "maps" / f"{name}.map").read_text().splitlines()[4:]
    free = np.array([[cell in ".G" for cell in line] for line in lines])
    world = World(name=name, levels=(Level(name="L1", occupancy=Occupancy(blocked=~free[::-1], resolution=1.0)),))
    source = MovingAiScenario(file=folder / "scens" / f"{name}-random-1.scen", robots=50)
    scenario = source.draw(world, grid(2, 3), Fleet(robots=()), 0)
    first = (folder / "scens" / f"{name}-random-1.scen").read_text().splitlines()[1].split("\t")
    assert scenario.start[0, :2].tolist() == [int(first[4]) + 0.5, len(lines) - int(first[5]) - 0.5]
    assert len(np.unique(scenario.start[:, :2], axis=0)) == 50
