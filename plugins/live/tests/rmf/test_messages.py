"""Message types made from definitions."""

import pytest

pytest.importorskip("cyclonedds", reason="mrpbench-live[rmf] is not installed")
from mrpbench_live.rmf.messages import Messages, messages_of, plan_key

from mrpbench_core.api import InputError


def test_messages_are_written_as_ros_2_writes_them():
    # little-endian plain CDR: the encapsulation header, then float32[2] as it is and the length before a sequence
    messages = messages_of("")
    point = messages.new("rmf_prototype_msgs/ControlPoint", position=[1.0, -2.0], weight=0.5)
    assert point.serialize(use_version_2=False).hex() == "00010000" + "0000803f" + "000000c0" + "0000003f"
    release = messages.new("rmf_prototype_msgs/PlanRelease", waypoint_id=3)
    uuid, version = "00" * 16, "00" * 8
    assert release.serialize(use_version_2=False).hex() == "00010000" + "0300000000000000" + uuid + version
    assert messages.type("rmf_prototype_msgs/Plan").__idl_typename__ == "rmf_prototype_msgs::msg::dds_::Plan_"


def test_a_file_of_definitions_replaces_those_of_a_commit(tmp_path):
    path = tmp_path / "own.txt"
    path.write_text(
        "MSG: unique_identifier_msgs/UUID\nuint8[16] uuid\n\n# of a branch\nMSG: rmf_prototype_msgs/PlanId\n"
        "unique_identifier_msgs/UUID destination_session\nuint64 mapf_session\nuint64 plan_version\n"
    )
    found = Messages(path).new("rmf_prototype_msgs/PlanId", mapf_session=7, plan_version=2)
    assert plan_key(found) == (bytes(16), 7, 2)
    assert plan_key(messages_of("").new("rmf_prototype_msgs/PlanId", mapf_session=7, plan_version=2))[1] == 0


@pytest.mark.parametrize("line", ["uint128 x", "Missing/Type x", "uint8 x y", "uint8[<2] x"])
def test_what_is_no_definition_is_refused_with_its_line(tmp_path, line):
    path = tmp_path / "own.txt"
    path.write_text(f"MSG: some/Thing\nuint8 first\n{line}\n")
    with pytest.raises(InputError, match=r"own\.txt:3: expected"):
        Messages(path)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(InputError, match=r"none\.txt: there is no such file"):
        Messages(tmp_path / "none.txt")
