import pytest

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import Nav2Block
from mrpbench_core.files.nav2_file import Nav2File

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
"""


@pytest.fixture
def block(tmp_path):
    path = tmp_path / "params.yaml"
    path.write_text(FILE)
    return Nav2File.load(path).node("controller_server").within("FollowPath")


def test_a_block_has_dotted_and_nested_parameters_alike(block):
    assert block.take("PathAlign.scale", float) == 32.0
    assert block.take("PathAlign.forward_point_distance", float) == 0.1
    assert block.take("critics", tuple) == ("RotateToGoal", "PathAlign")
    assert block.take("max_vel_x", float) == 1.0
    assert block.take("sim_time", float, 1.7) == 1.7


def test_unknown_parameters_are_named_with_their_place(block):
    for name in ("plugin", "max_vel_x", "critics"):
        block.take(name, {"max_vel_x": float, "critics": tuple}.get(name, str))
    block.take("sim_time", float)
    with pytest.raises(InputError, match=r"params.yaml:11:7: .*unknown parameter 'sim_tme' \(did you mean 'sim_time'"):
        block.unused()


def test_a_value_of_the_wrong_kind_is_refused_with_its_place(block):
    with pytest.raises(InputError, match=r"params.yaml:6:7: .*max_vel_x: expected true or false, got 1"):
        block.take("max_vel_x", bool)


def test_words_that_ros_reads_as_a_bool_are_bools():
    block = Nav2Block("amcl", {"a": "yes", "b": "Off", "c": "maybe"})
    assert (block.take("a", bool), block.take("b", bool)) == (True, False)
    with pytest.raises(InputError, match="c: expected true or false, got 'maybe'"):
        block.take("c", bool)


def test_a_pasted_block_needs_no_file():
    block = Nav2Block("FollowPath", {"a": 1, "b": 2})
    block.take("a", int)
    with pytest.raises(InputError, match=r"FollowPath: unknown parameter 'b'"):
        block.unused()


def test_what_is_not_read_is_told_by_name_and_a_block_that_nothing_names_by_its_own():
    data = {
        "read": 1,
        "topic": "/scan",
        "layer": {"topic": "/scan", "radius": 1},
        "other": {"topc": 1, "deep": {"x": 1}},
    }
    block = Nav2Block("costmap", data)
    block.take("read", int)
    block.not_used("topic")
    layer = block.within("layer")
    layer.take("radius", int)
    layer.not_used("topic")
    assert block.unused() == ("topic", "other", "layer.topic")
    layer.ignore()
    block.ignore("other")
    assert block.unused() == ("topic",)
