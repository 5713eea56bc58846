import gzip
import io

import numpy as np
import pytest
from mrpbench_worlds_standard.barn import PATH_LENGTH, Barn
from mrpbench_worlds_standard.barn_task import BarnTask

from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet, RobotModel

WORLD = """<sdf version='1.6'><world name='default'>
<model name='ground_plane'><static>1</static></model>
<model name='unit_cylinder_0'><pose frame=''>-1 4 0 0 0 0</pose><link name='link'><collision name='c'><geometry>
<cylinder><radius>0.1</radius><length>1</length></cylinder></geometry></collision></link></model>
<state world_name='default'><model name='unit_cylinder_0'><pose>9 9 0 0 0 0</pose></model></state>
</world></sdf>"""
DISC = RobotModel(
    name="disc",
    footprint=[(0.3 * np.cos(a), 0.3 * np.sin(a)) for a in np.arange(8) * np.pi / 4],
    max_speed=2.0,
    max_turn_rate=2.0,
)


def written(folder, content, name="world_7.world"):
    file = folder / name
    file.write_bytes(content.encode() if isinstance(content, str) else content)
    return file


def npy(cells):
    stream = io.BytesIO()
    np.save(stream, cells)
    return stream.getvalue()


@pytest.mark.parametrize("pack", [str.encode, lambda text: gzip.compress(text.encode())])
def test_cylinders_become_polygons_around_them_and_states_do_not_count(tmp_path, pack):
    name = "world_7.world" if pack is str.encode else "world_7.world.gz"
    world = Barn(file=written(tmp_path, pack(WORLD), name)).load()
    assert world.name == "world_7"
    (obstacle,) = world.levels[0].obstacles
    away = np.hypot(*(obstacle.polygon - (-1, 4)).T)
    middles = (obstacle.polygon + np.roll(obstacle.polygon, -1, axis=0)) / 2 - (-1, 4)
    assert away.max() < 0.1 * 1.04
    assert np.hypot(*middles.T) == pytest.approx(0.1)


def test_the_reference_path_has_the_length_by_which_the_challenge_scores(tmp_path):
    path = written(tmp_path, npy(np.array([[15, 0], [15, 20]])), "path_7.npy")
    world = Barn(file=written(tmp_path, WORLD), path=path).load()
    leg = np.hypot(15 * 0.15 - 4.575 + 2.25, 5.075 - 3)
    last = np.hypot(15 * 0.15 - 4.575 + 2.25, 13 - 5.075 - 3)
    assert world.vertices[1].parameters[PATH_LENGTH] == pytest.approx(leg + 3 + last)


def test_a_table_gives_the_same_world(tmp_path):
    table = written(tmp_path, "world,x,y\n3,-1,4\n4,-2,5\n", "cylinders.csv")
    paths = written(tmp_path, "world,row,col\n4,15,0\n4,15,20\n", "paths.csv")
    world = Barn(file=table, index=4, path=paths).load()
    assert world.name == "barn_4"
    assert world.levels[0].obstacles[0].polygon.mean(axis=0) == pytest.approx((-2, 5))
    assert world.vertices[1].parameters[PATH_LENGTH] > 10


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("<sdf", "is not XML"),
        ("<sdf><world/></sdf>", "has no model unit_cylinder_N"),
        ("<!DOCTYPE sdf><sdf/>", "DOCTYPE"),
        (WORLD.replace("<radius>0.1</radius>", ""), "no radius"),
        (WORLD.replace("0.1", "-1"), "has the radius -1"),
        (WORLD.replace("-1 4 0 0 0 0", "-1 nan"), "has no pose"),
    ],
)
def test_a_broken_world_gives_one_line(tmp_path, content, message):
    with pytest.raises(InputError, match=message):
        Barn(file=written(tmp_path, content)).load()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"file": "table.csv"}, "name one by `index`"),
        ({"file": "world_7.world", "index": 3}, "leave out `index`"),
        ({"file": "table.csv", "index": 5}, "has no world 5"),
        ({"file": "words.csv", "index": 3}, "should hold numbers"),
        ({"file": "table.csv", "index": 3, "path": "table.csv"}, "has no column col, row"),
        ({"file": "world_7.world", "path": "table.csv"}, "is a table of paths"),
        ({"file": "world_7.world", "path": "world_7.world"}, "is not an array of NumPy"),
        ({"file": "world_7.world", "path": "flat.npy"}, r"instead of numbers\[k, 2\]"),
        ({"file": "plain.world.gz"}, "is not compressed by gzip"),
    ],
)
def test_options_and_files_that_do_not_fit_give_one_line(tmp_path, options, message):
    written(tmp_path, WORLD)
    written(tmp_path, WORLD, "plain.world.gz")
    written(tmp_path, "world,x,y\n3,-1,4\n", "table.csv")
    written(tmp_path, "world,x,y\n3,-1,four\n", "words.csv")
    written(tmp_path, npy(np.arange(4)), "flat.npy")
    files = {name: tmp_path / value if name != "index" else value for name, value in options.items()}
    with pytest.raises(InputError, match=message):
        Barn(**files).load()


@pytest.mark.parametrize("index", [0, 150, 297])
def test_the_challenges_files_and_the_tables_agree(shared_data, index):
    folder = shared_data / "barn"
    single = Barn(file=folder / f"world_{index}.world.gz", path=folder / f"path_{index}.npy").load()
    table = Barn(file=folder / "cylinders.csv.gz", path=folder / "paths.csv.gz", index=index).load()
    first, second = (
        np.array(sorted(obstacle.polygon.mean(axis=0).round(4).tolist() for obstacle in world.levels[0].obstacles))
        for world in (single, table)
    )
    assert first == pytest.approx(second)
    assert single.vertices[1].parameters == pytest.approx(table.vertices[1].parameters)
    if index == 0:
        assert single.vertices[1].parameters[PATH_LENGTH] == pytest.approx(13.592, abs=1e-3)


def test_the_task_can_be_planned_on_a_grid_of_cells_as_in_the_challenge(shared_data):
    world = Barn(file=shared_data / "barn/cylinders.csv.gz", index=150).load()
    roadmap = GridRoadmap(cell_size=0.15).build(world, Fleet(robots=(DISC,)))
    assert (roadmap.place >= 0).all()  # both places, in one component
    scenario = BarnTask().draw(world, roadmap, Fleet(robots=(DISC,)), 0)
    assert scenario.start.tolist() == [[-2.25, 3.0, np.pi / 2]]
    assert scenario.tasks[0].goals[0, :2].tolist() == [-2.25, 13.0]
