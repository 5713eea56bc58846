import pytest
from mrpbench_exporters_rosbag2 import Rosbag2
from mrpbench_exporters_rosbag2.topics import FLEET, ROBOT, selected


def test_every_written_topic_is_listed(context, recording, tmp_path, read):
    session = Rosbag2().open(context, tmp_path / "bag")
    session.write(recording)
    session.close()
    listed = {*FLEET, *(f"/robot_{index}/{name}" for index in (0, 1) for name in ROBOT)}
    elsewhere = {"/routes", "/door_states", "/facilities", "/lift_states"}  # after a new plan, with doors and lifts
    elsewhere |= {"/movers", "/people", "/people_markers", "/robot_0/map", "/robot_1/map"}  # where there are some
    assert set(read(tmp_path / "bag")) == listed - elsewhere


@pytest.mark.parametrize("pattern", ["*", "/tf*", "/robot_7/scan", "/robot_*/o*m", "/map_1", "/robot_[12]/plan"])
def test_patterns_that_match_something_are_accepted(pattern):
    assert Rosbag2(topics=(pattern,)).topics == (pattern,)


@pytest.mark.parametrize("pattern", ["tf", "/robot_0/odometry", "", "/Tf", "/robot0/odom"])
def test_patterns_that_match_no_topic_are_refused_with_the_list_of_topics(pattern):
    with pytest.raises(ValueError, match=r"no topic matches .*; there are /clock, .*/robot_\*/scan"):
        Rosbag2(topics=("/tf", pattern))


def test_a_topic_is_written_if_any_pattern_matches():
    assert selected("/robot_1/odom", ("/tf", "/robot_?/*"))
    assert not selected("/robot_1/odom", ("/tf", "odom"))
