import numpy as np
import pytest
from mrpbench_worlds_standard.movingai import MovingAi

from mrpbench_core.files.errors import InputError

MAP = "type octile\nheight 2\nwidth 7\nmap\n.GS@OTW\n.......\n"


def load(tmp_path, text=MAP, **options):
    file = tmp_path / "tiny.map"
    file.write_text(text)
    return MovingAi(file=file, **options).load()


def test_every_terrain_letter_has_a_meaning_and_the_first_line_is_the_top(tmp_path):
    world = load(tmp_path)
    occupancy = world.levels[0].occupancy
    assert world.name == "tiny"
    assert occupancy.blocked.tolist() == [[False] * 7, [False, False, False, True, True, True, True]]
    assert occupancy.resolution == 1.0


def test_the_resolution_can_be_chosen(tmp_path):
    assert load(tmp_path, resolution=0.5).levels[0].occupancy.resolution == 0.5


def test_windows_line_ends_are_read(tmp_path):
    assert load(tmp_path, MAP.replace("\n", "\r\n")).levels[0].occupancy.shape == (2, 7)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("type octile", "tipe octile", "tiny.map:1: should be 'type …'"),
        ("height 2", "hight 2", "tiny.map:2: should be 'height …'"),
        ("height 2", "height two", "tiny.map:2: height should be a positive number"),
        ("height 2", "height 0", "tiny.map:2: height should be a positive number"),
        ("width 7", "width 6", "tiny.map:5: this row has 7 letters, not 6"),
        ("map\n", "mop\n", "tiny.map:4: should be 'map'"),
        (".......\n", "...?...\n", "tiny.map:6:4: unknown terrain '?'"),
        (".......\n", "....\n", "tiny.map:6: this row has 4 letters, not 7"),
        (".......\n", "", "tiny.map:5: the map ends after 1 of 2 rows"),
        (".......\n", ".......\n.......\n", "tiny.map:7: more than 2 rows"),
        (MAP, "", "tiny.map:1: should be 'type …'"),
    ],
)
def test_a_mistake_is_named_with_its_line(tmp_path, old, new, message):
    with pytest.raises(InputError) as caught:
        load(tmp_path, MAP.replace(old, new))
    assert message in str(caught.value)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(InputError, match=r"none\.map: no such file"):
        MovingAi(file=tmp_path / "none.map").load()


def test_public_maps_have_the_letters_of_their_files(shared_data):
    for file in sorted((shared_data / "movingai/maps").glob("*.map")):
        rows = file.read_text().splitlines()[4:]
        occupancy = MovingAi(file=file).load().levels[0].occupancy
        assert (~occupancy.blocked).sum() == sum(row.count(".") + row.count("G") + row.count("S") for row in rows)
        assert np.array_equal(~occupancy.blocked[0], [letter in ".GS" for letter in rows[-1]])
