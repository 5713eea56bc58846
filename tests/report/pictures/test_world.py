import builtins
import struct

import numpy as np
import pytest
from mrpbench_worlds_standard.shipped import Office

from mrpbench_core.builtin.roadmaps.lanes import Lanes
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Area, Door, Lane, Level, Obstacle, Vertex, World
from mrpbench_core.report.pictures.paths import plot_paths
from mrpbench_core.report.pictures.style import PIXELS, own_style
from mrpbench_core.report.pictures.world import plot_world, world_figure

pytest.importorskip("matplotlib")
from matplotlib.text import Text


def pixels(file):
    import matplotlib.image as images

    return np.round(images.imread(file)[..., :3] * 255).astype(int)


def size(file):
    return struct.unpack(">II", file.read_bytes()[16:24])


def has(image, colour) -> bool:
    wanted = [int(colour[index : index + 2], 16) for index in (1, 3, 5)]
    return bool((np.abs(image - wanted).max(axis=2) <= 2).any())


def test_a_world_is_1280_pixels_wide_or_high(tmp_path):
    file = tmp_path / "a.png"
    for walls, expected in (([[0, 0, 20, 0], [0, 0, 0, 8]], 0), ([[0, 0, 8, 0], [0, 0, 0, 20]], 1)):
        plot_world(World(name="w", levels=(Level(name="", walls=walls),)), file=file)
        assert abs(size(file)[expected] - PIXELS) <= 1
        assert size(file)[1 - expected] < PIXELS


def test_a_run_shows_robots_in_their_colours(tmp_path, robot_model):
    world = Office().load()
    fleet = Fleet(robots=(robot_model, robot_model))
    waypoint = [[1.2, 6, 0], [6, 6, 0]], [[18, 6, 0], [13, 6, 0]]
    routes = [Route(waypoint=points, level=[0, 0], speed=[np.inf]) for points in waypoint]
    truth = np.linspace(*np.array(waypoint).transpose(1, 0, 2), 30)
    file = tmp_path / "run.png"
    plot_world(world, roadmap=Lanes().build(world, fleet), fleet=fleet, routes=routes, truth=truth, file=file)
    image = pixels(file)
    assert has(image, "#332288")
    assert has(image, "#44aa99")
    assert not has(image, "#009e73"), "there is no third robot"
    assert has(image, "#e8f0f6"), "the roadmap is shaded"


def test_title_and_legend_of_a_narrow_world_are_on_the_sheet_and_do_not_overlap():
    world = World(name="narrow", levels=(Level(name="a level", walls=[[0, 0, 0, 20], [2, 0, 2, 20]]),))
    truth = np.array([[[1, 1, 0]], [[1, 19, 0]]], float)
    with own_style():
        figure, axes = world_figure(world, truth=truth)
        plot_paths(axes, None, [truth[:, 0, :2]], truth, people=True)
    figure.draw_without_rendering()
    title = next(text for text in axes.findobj(Text) if text.get_text().startswith("narrow")).get_window_extent()
    legend = axes.get_legend().get_window_extent()
    assert not title.overlaps(legend)
    for box in (title, legend):
        assert figure.bbox.contains(box.x0, box.y0)
        assert figure.bbox.contains(box.x1, box.y1)


def test_holes_are_hatched():
    level = Level(name="", walls=[[0, 0, 9, 0]], holes=(Area(polygon=[[1, 1], [3, 1], [3, 3]]),))
    with own_style():
        _, axes = world_figure(World(name="holed", levels=(level,)))
    hatched = [path.vertices for shape in axes.collections if shape.get_hatch() for path in shape.get_paths()]
    np.testing.assert_array_equal(np.unique(np.concatenate(hatched), axis=0), [[1, 1], [3, 1], [3, 3]])


@pytest.mark.parametrize("part", ["routes", "truth"])
def test_planned_or_driven_paths_can_be_drawn_alone(tmp_path, part):
    world = Office().load()
    if part == "routes":
        extra = {"routes": [Route(waypoint=[[1.2, 6, np.nan], [6, 6, np.nan]], level=[0, 0], speed=[1.0])]}
    else:
        extra = {"truth": np.array([[[1.2, 6, 0]], [[6, 6, 0]]])}
    plot_world(world, file=tmp_path / "a.png", **extra)
    assert has(pixels(tmp_path / "a.png"), "#332288")


def test_every_part_of_a_world_can_be_drawn(tmp_path):
    level = Level(
        name="",
        occupancy=Occupancy(blocked=[[True, False], [False, False]], resolution=2.0),
        obstacles=(Obstacle(name="", polygon=[[2, 2], [3, 2], [3, 3]]),),
        doors=(Door(name="", start=(0, 3), end=(1, 3)),),
    )
    places = (Vertex(name="a", x=1, y=3), Vertex(name="b", x=3, y=1))
    world = World(name="w", levels=(level,), vertices=places, lanes=(Lane(start=0, end=1, bidirectional=False),))
    plot_world(world, file=tmp_path / "a.png")
    image = pixels(tmp_path / "a.png")
    assert has(image, "#3b4252")
    assert has(image, "#b9a68c")


def test_an_empty_world_and_a_strip_can_be_drawn(tmp_path):
    plot_world(World(name="nothing", levels=(Level(name=""),)), file=tmp_path / "a.png")
    strip = World(name="strip", levels=(Level(name="", walls=[[0, 0, 900, 0]]),))
    plot_world(strip, file=tmp_path / "b.png")
    assert abs(size(tmp_path / "b.png")[0] - PIXELS) <= 1


def test_without_matplotlib_the_error_names_the_package_to_install(tmp_path, monkeypatch):
    real = builtins.__import__

    def without(name, *rest):
        if name.startswith("matplotlib"):
            raise ImportError(name)
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(InputError, match=r"mrpbench\[figures\]"):
        plot_world(World(name="w", levels=(Level(name=""),)), file=tmp_path / "a.png")


def test_a_missing_folder_is_named(tmp_path):
    with pytest.raises(InputError, match="cannot be written"):
        plot_world(World(name="w", levels=(Level(name=""),)), file=tmp_path / "no" / "a.png")
