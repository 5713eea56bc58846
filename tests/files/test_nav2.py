import pytest

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import Nav2Block, nav2_block

FILE = """\
controller_server:
  ros__parameters:
    use_sim_time: True
    FollowPath:
      plugin: "dwb_core::DWBLocalPlanner"
      max_vel_x: 1
      critics: ["RotateToGoal", "PathAlign"]
      PathAlign.scale: 32.0
      PathAlign:
        forward_point_distance: 0.1
      sim_tme: 1.7
local_costmap:
  local_costmap:
    ros__parameters:
      width: 3
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "params.yaml"
    path.write_text(FILE)
    return path


def test_a_block_has_dotted_and_nested_parameters_alike(file):
    block = nav2_block(file, "controller_server", "FollowPath")
    assert block.take("PathAlign.scale", float) == 32.0
    assert block.take("PathAlign.forward_point_distance", float) == 0.1
    assert block.take("critics", tuple) == ("RotateToGoal", "PathAlign")
    assert block.take("max_vel_x", float) == 1.0
    assert block.take("sim_time", float, 1.7) == 1.7


def test_a_node_is_found_in_its_namespace(file):
    assert nav2_block(file, "local_costmap").take("width", int) == 3


def test_missing_parameters_are_none(file):
    assert nav2_block(file, "amcl") is None
    assert nav2_block(file, "controller_server", "GoalChecker") is None


def test_unknown_parameters_are_named_with_their_place(file):
    block = nav2_block(file, "controller_server", "FollowPath")
    for name in ("plugin", "max_vel_x", "critics"):
        block.take(name, {"max_vel_x": float, "critics": tuple}.get(name, str))
    block.ignore("PathAlign")
    block.take("sim_time", float)
    with pytest.raises(InputError, match=r"params.yaml:11:7: .*unknown parameter 'sim_tme' \(did you mean 'sim_time'"):
        block.refuse_unknown()


def test_a_value_of_the_wrong_kind_is_refused_with_its_place(file):
    block = nav2_block(file, "controller_server", "FollowPath")
    with pytest.raises(InputError, match=r"params.yaml:6:7: .*max_vel_x: expected true or false, got 1"):
        block.take("max_vel_x", bool)


def test_a_pasted_block_needs_no_file():
    block = Nav2Block("FollowPath", {"a": 1, "b": {"c": 2}})
    block.take("a", int)
    with pytest.raises(InputError, match=r"FollowPath: unknown parameter 'b.c'"):
        block.refuse_unknown()


def test_another_yaml_file_is_refused(tmp_path):
    path = tmp_path / "other.yaml"
    path.write_text("name: x\n")
    with pytest.raises(InputError, match="not a ROS 2 parameter file"):
        nav2_block(path, "amcl")
