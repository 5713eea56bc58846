import math
import sys
import tracemalloc

import numpy as np
import pytest
from mrpbench_world.formats.raster import write_ros_map
from mrpbench_worlds_standard.ros_map import RosMap

from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.occupancy import Occupancy

Image = pytest.importorskip("PIL.Image")

YAML = """\
image: map.png
resolution: 0.05
origin: [-1, 2, 0]
occupied_thresh: 0.65
free_thresh: 0.25
negate: 0
"""


@pytest.fixture
def load(tmp_path):
    def read(values, text=YAML, mode="L", **options):
        Image.fromarray(np.array(values, np.uint8), mode).save(tmp_path / "map.png")
        (tmp_path / "map.yaml").write_text(text)
        return RosMap(file=tmp_path / "map.yaml", **options).load()

    return read


def blocked(world):
    """The raster as the image shows it: the first row is at the top."""
    return world.levels[0].occupancy.blocked[::-1].tolist()


pytestmark = pytest.mark.filterwarnings("ignore:'mode' parameter is deprecated")


def test_dark_is_occupied_and_the_top_is_north(load):
    world = load([[0, 254, 254], [254, 254, 128]])
    assert blocked(world) == [[True, False, False], [False, False, True]]
    occupancy = world.levels[0].occupancy
    assert (occupancy.resolution, occupancy.origin, world.name) == (0.05, (-1, 2), "map")
    np.testing.assert_allclose(occupancy.centres(np.array([[1, 0]])), [[-0.975, 2.075]])


def test_unknown_cells_can_be_free(load):
    assert blocked(load([[0, 254, 128]], unknown="free")) == [[True, False, False]]


def test_negated_images_are_light_where_occupied(load):
    for word in ("1", "true", "yes", "On"):
        assert blocked(load([[0, 254, 120]], YAML.replace("negate: 0", f"negate: {word}"))) == [[False, True, True]]
    for word in ("0", "False", "no", "off"):
        assert blocked(load([[0, 254, 120]], YAML.replace("negate: 0", f"negate: {word}"))) == [[True, False, True]]


def test_thresholds_are_the_files(load):
    values = [[255 - round(255 * share) for share in (0.1, 0.3, 0.5, 0.7, 0.9)]]
    assert blocked(load(values)) == [[False, True, True, True, True]]
    assert blocked(load(values, unknown="free")) == [[False, False, False, True, True]]
    other = YAML.replace("0.25", "0.4").replace("0.65", "0.8")
    assert blocked(load(values, other)) == [[False, False, True, True, True]]
    assert blocked(load(values, other, unknown="free")) == [[False, False, False, False, True]]


def test_the_mode_scale_blocks_only_certainly_occupied_cells(load):
    values = [[255 - round(255 * share) for share in (0.1, 0.5, 0.9)]]
    assert blocked(load(values, YAML + "mode: scale\n")) == [[False, False, True]]


def test_a_grey_value_at_a_threshold_reaches_it(load):
    values = [[255 - round(255 * share) for share in (0, 0.2, 0.4, 0.6, 0.8, 1)]]
    for low, high, free, occupied in ((0.2, 0.8, 2, 2), (0.4, 0.6, 3, 3), (0, 1, 1, 1), (0.4, 0.4, 2, 4)):
        text = YAML.replace("0.25", str(low)).replace("0.65", str(high))
        walls = [[False] * (6 - occupied) + [True] * occupied]
        assert blocked(load(values, text)) == [[False] * free + [True] * (6 - free)]
        assert blocked(load(values, text, unknown="free")) == walls
        assert blocked(load(values, text + "mode: scale\n")) == walls


def test_the_mode_is_read_in_any_case(load):
    for mode in ("Trinary", "SCALE", "Raw"):
        assert blocked(load([[0, 100, 255]], f"{YAML}mode: {mode}\n")) == blocked(
            load([[0, 100, 255]], f"{YAML}mode: {mode.lower()}\n")
        )


def test_the_mode_raw_takes_percent(load):
    text = YAML + "mode: raw\n"
    assert blocked(load([[0, 30, 64, 65, 100, 101, 255]], text)) == [[False, False, False, True, True, True, True]]
    assert blocked(load([[0, 65, 101, 255]], text, unknown="free")) == [[False, True, False, False]]


def test_colours_are_averaged_and_transparent_pixels_unknown(load):
    values = [[(0, 0, 0, 255), (255, 255, 255, 255), (255, 255, 255, 0), (255, 240, 225, 255)]]
    assert blocked(load(values, mode="RGBA")) == [[True, False, True, False]]
    assert blocked(load(values, mode="RGBA", unknown="free")) == [[True, False, False, False]]


@pytest.mark.parametrize("mode", ["trinary", "scale", "raw"])
def test_pixels_that_are_not_opaque_are_unknown_in_every_mode(load, mode):
    grey = 0 if mode == "raw" else 255
    dark = 100 if mode == "raw" else 0
    values = [[(value, value, value, alpha) for value in (grey, dark) for alpha in (255, 254, 0)]]
    text = f"{YAML}mode: {mode}\n"
    assert blocked(load(values, text, mode="RGBA")) == [[False, True, True, True, True, True]]
    assert blocked(load(values, text, mode="RGBA", unknown="free")) == [[False, False, False, True, False, False]]


@pytest.mark.parametrize(("threshold", "free"), [("0.25", True), ("0.196", False)])
def test_unknown_cells_of_map_saver_that_are_free_are_noted(load, threshold, free):
    """50 / 255 = 0.19608 lies between the thresholds that ROS 1 and ROS 2 write beside the same grey value."""
    world = load([[0, 205, 254]], YAML.replace("free_thresh: 0.25", f"free_thresh: {threshold}"))
    assert blocked(world) == [[True, not free, False]]
    assert [note.split(",")[0] for note in world.notes] == ["cells of the grey 205"] * free


def test_a_map_without_walls_or_without_free_cells_is_noted(load):
    assert load([[0, 254]]).notes == ()
    walls, free = "no cell is occupied, so the map has no walls", "no cell is free"
    assert [note.split(" (")[0] for note in load([[254, 254]]).notes] == [walls]
    assert [note.split(" (")[0] for note in load([[254, 128]]).notes] == [walls]
    assert [note.split(" (")[0] for note in load([[0, 128]]).notes] == [free]
    assert [note.split(" (")[0] for note in load([[128, 128]]).notes] == [walls, free]
    assert [note.split(" (")[0] for note in load([[128, 128]], unknown="free").notes] == [walls]
    dark = YAML.replace("0.65", "0.99") + "mode: scale\n"
    assert [note.split(" (")[0] for note in load([[20, 254]], dark).notes] == [walls]


@pytest.mark.parametrize(("name", "lightest"), [("m01", 0), ("m01t", 254)])
def test_thresholds_at_both_ends_keep_walls_and_free_cells(shared_data, name, lightest):
    file = shared_data / f"cases/01-scale-thresholds-at-the-ends/{name}.yaml"
    world = RosMap(file=file).load()
    with Image.open(file.with_name("b255.pgm")) as image:
        assert blocked(world) == (np.asarray(image) <= lightest).tolist()


CORNER = [[254, 254, 0], [254, 254, 254]]
"""The black pixel's centre lies at 0.125, 0.075 from the lower left corner."""


@pytest.mark.parametrize("quarters", [0, 1, 2, 3, -1, 5])
def test_quarter_turns_of_the_origin_are_exact(load, quarters):
    angle = quarters * math.pi / 2
    occupancy = load(CORNER, YAML.replace("2, 0]", f"2, {angle!r}]")).levels[0].occupancy
    assert sorted(occupancy.shape) == [2, 3]
    (cell,) = np.argwhere(occupancy.blocked)
    where = np.array([-1 + 0.125 * math.cos(angle) - 0.075 * math.sin(angle),
                      2 + 0.125 * math.sin(angle) + 0.075 * math.cos(angle)])  # fmt: skip
    np.testing.assert_allclose(occupancy.centres(cell)[0], where, atol=1e-9)


def test_other_turns_are_sampled_anew_and_said_so(load):
    values = np.full((60, 80), 254)
    values[20:24, 40:44] = 0
    angle = math.radians(30)
    world = load(values, YAML.replace("2, 0]", f"2, {angle!r}]"))
    occupancy = world.levels[0].occupancy
    assert world.notes == ("the map is rotated by 30.00° and resampled.",)
    x, y = 42 * 0.05, 38 * 0.05
    middle = np.array([-1 + x * math.cos(angle) - y * math.sin(angle), 2 + x * math.sin(angle) + y * math.cos(angle)])
    row, column = occupancy.cells(middle)[0]
    patch = occupancy.blocked[row - 8 : row + 9, column - 8 : column + 9]
    assert patch.sum() == pytest.approx(16, abs=4)
    assert np.hypot(*(occupancy.centres(np.argwhere(patch) + (row - 8, column - 8)).mean(axis=0) - middle)) < 0.03
    assert (~occupancy.blocked).sum() == pytest.approx(60 * 80 - 16, rel=0.02)


def test_a_map_is_read_as_it_was_written(tmp_path):
    generator = np.random.default_rng(1)
    occupancy = Occupancy(blocked=generator.random((17, 23)) < 0.3, resolution=0.1, origin=(-3.7, 1 / 3))
    write_ros_map(tmp_path / "out.yaml", occupancy)
    assert RosMap(file=tmp_path / "out.yaml").load().levels[0].occupancy == occupancy


def test_pgm_of_text_and_of_16_bits_is_read(tmp_path):
    (tmp_path / "map.yaml").write_text(YAML.replace("png", "pgm"))
    (tmp_path / "map.pgm").write_text("P2\n# by hand\n3 1\n15\n0 15 7\n")
    assert blocked(RosMap(file=tmp_path / "map.yaml").load()) == [[True, False, True]]
    (tmp_path / "map.pgm").write_bytes(b"P5 3 1 65535\n" + bytes([0, 0, 255, 255, 128, 0]))
    assert blocked(RosMap(file=tmp_path / "map.yaml").load()) == [[True, False, True]]


def test_an_image_with_too_many_pixels_is_refused_before_they_are_decoded(load, monkeypatch):
    monkeypatch.setattr("mrpbench_worlds_standard.image.PIXELS", 11)
    monkeypatch.setattr("PIL.Image.Image.convert", None)
    with pytest.raises(InputError, match=r"is too large \(crop it"):
        load([[0, 0, 0, 0]] * 3)


def test_an_image_takes_little_memory_for_each_pixel(tmp_path):
    (tmp_path / "map.yaml").write_text(YAML.replace("origin: [-1, 2, 0]", "origin: [-1, 2, 0.3]"))
    Image.new("L", (1000, 1000), 254).save(tmp_path / "map.png")
    tracemalloc.start()
    RosMap(file=tmp_path / "map.yaml").load()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 16 * 1000 * 1000


def test_another_image_can_be_named(load, tmp_path):
    Image.fromarray(np.array([[0, 0]], np.uint8)).save(tmp_path / "other.png")
    assert blocked(load([[254]], image=tmp_path / "other.png")) == [[True, True]]


def test_a_roadmap_on_a_fine_map_has_cells_for_robots(load):
    values = np.full((100, 200), 254)
    values[:, [0, -1]] = values[[0, -1]] = 0
    fleet = Fleet(robots=(load_robot("turtlebot3_burger"),))
    roadmap = GridRoadmap().build(load(values), fleet)
    assert roadmap.grid.cell_size == 0.4
    assert 200 < len(roadmap.position) < 25 * 13


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("image: map.png", "image: no.png", "map.yaml:1:8: there is no image"),
        ("image: map.png", "image: map.yaml", "map.yaml: is not an image that Pillow reads"),
        ("image: map.png\n", "", "map.yaml:1:1: has no 'image' (a ROS map_server file?)"),
        ("0.05", "0", "map.yaml:2:13: resolution should be positive"),
        ("[-1, 2, 0]", "[1]", "map.yaml:3:9: should have at least 2 values"),
        ("0.65", "65", "map.yaml:4:18: occupied_thresh should lie between 0 and 1, not 65"),
        ("0.25", "0.9", "map.yaml:5:14: free_thresh 0.9 should not exceed occupied_thresh 0.65"),
        ("negate: 0", "negate: 2", "map.yaml:6:9: negate should be 0 or 1, not 2"),
        ("negate: 0", "mode: binary", "map.yaml:6:7: mode 'binary' is not known (modes: trinary, scale, raw)"),
    ],
)
def test_a_mistake_is_named_with_its_line(load, old, new, message):
    assert old in YAML
    with pytest.raises(InputError) as caught:
        load([[0]], YAML.replace(old, new))
    assert message in str(caught.value)


@pytest.mark.parametrize("name", ["/home/robot/maps/Floor.PNG", r"C:\maps\floor.png", "maps/floor.png"])
def test_an_image_that_was_moved_beside_its_file_is_suggested(load, tmp_path, name):
    (tmp_path / "floor.png").touch()
    with pytest.raises(InputError, match=r"there is no image .* \(beside this file is floor\.png\)"):
        load([[0]], YAML.replace("map.png", name))


def test_a_pointer_of_git_lfs_is_named(load, tmp_path):
    (tmp_path / "pointer.pgm").write_text("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 12\n")
    with pytest.raises(InputError, match=r"pointer\.pgm: is a pointer of Git LFS, not the image \(git lfs pull\)"):
        load([[0]], YAML.replace("map.png", "pointer.pgm"))


def test_a_roadmap_of_a_map_without_a_free_cell_says_why(load):
    world = load([[0, 0], [0, 0]])
    with pytest.raises(InputError, match=r"has no free cell \(no cell is free \(image, mode, negate, free_thresh"):
        GridRoadmap().build(world, Fleet(robots=(load_robot("turtlebot3_burger"),)))


def test_an_unknown_key_is_noted(load):
    assert load([[0, 254]], YAML + "colour: 1\n").notes == ("key 'colour' is not known and has no effect.",)


def test_without_pillow_the_error_names_the_package_to_install(load, monkeypatch, tmp_path):
    load([[0]])
    monkeypatch.setitem(sys.modules, "PIL", None)
    with pytest.raises(InputError, match=r"map.yaml:1:8: images need Pillow .*mrpbench\[images\]"):
        RosMap(file=tmp_path / "map.yaml").load()
