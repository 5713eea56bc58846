import numpy as np
import pytest
from mrpbench_world.formats.raster import write_movingai_map, write_ros_map
from mrpbench_worlds_standard.movingai import MovingAi
from mrpbench_worlds_standard.ros_map import RosMap

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.worlds.occupancy import Occupancy

RASTER = Occupancy(blocked=[[True, False, False], [False, False, False]], resolution=0.5, origin=(1, 2))


def test_the_first_line_of_a_map_is_the_highest(tmp_path):
    write_movingai_map(tmp_path / "a.map", RASTER)
    assert (tmp_path / "a.map").read_text() == "type octile\nheight 2\nwidth 3\nmap\n...\n@..\n"
    read = MovingAi(file=tmp_path / "a.map").load().levels[0].occupancy
    np.testing.assert_array_equal(read.blocked, RASTER.blocked)


def test_a_ros_map_is_an_image_next_to_its_yaml(tmp_path):
    write_ros_map(tmp_path / "a.yaml", RASTER)
    assert (tmp_path / "a.pgm").read_bytes() == b"P5\n3 2\n255\n" + bytes([254, 254, 254, 0, 254, 254])
    assert "resolution: 0.5\norigin: [1, 2, 0]" in (tmp_path / "a.yaml").read_text()


def test_a_ros_map_may_have_any_name(tmp_path):
    write_ros_map(tmp_path / "hall #1.yaml", RASTER)
    read = RosMap(file=tmp_path / "hall #1.yaml").load().levels[0].occupancy
    np.testing.assert_array_equal(read.blocked, RASTER.blocked)


@pytest.mark.parametrize("write", [write_ros_map, write_movingai_map])
def test_a_missing_folder_is_named(tmp_path, write):
    with pytest.raises(InputError, match="cannot be written"):
        write(tmp_path / "no" / "a.yaml", RASTER)
