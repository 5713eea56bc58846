"""Messages as bytes, compared with those of cyclonedds."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

pytest.importorskip("cyclonedds", reason="mrpbench-live[rmf] is not installed")
from cyclonedds.idl._support import Endianness
from mrpbench_live.rmf.messages import Messages, messages_of

DEFINITIONS = """
MSG: some/Inner
uint8 small
string text
float64[2] pair

MSG: some/Outer
uint8 first
some/Inner inner
uint64 large
some/Inner[] many
some/Inner[2] two
float32[] reals
uint8[] blob
int64[<=2] few
string[] names
uint8[3] bytes
int32 last
"""
WIDTHS = {"uint8": (0, 8), "int32": (31, 31), "uint32": (0, 32), "int64": (63, 63), "uint64": (0, 64)}


def values(messages, field):
    """Values of a field."""
    kind = field["type"]
    if kind in WIDTHS:
        low, high = WIDTHS[kind]
        one = st.integers(-(2**low) if low else 0, 2**high - 1)
    elif kind == "string":
        one = st.text(st.characters(exclude_characters="\0", codec="utf-8"), max_size=9)
    elif kind in ("float32", "float64"):
        one = st.floats(width=int(kind[5:]), allow_nan=False)
    else:
        one = drawn(messages, kind)
    if field["array"] is None:
        return one
    size = int(field["size"] or 3)
    return st.lists(one, min_size=size if field["size"] and not field["bound"] else 0, max_size=size)


def drawn(messages, name):
    """Messages of a type."""
    fields = {field: values(messages, it) for field, it in messages._fields[name].items()}
    return st.builds(messages.type(name), **fields)


def agree(message):
    """What we write is what cyclonedds writes, and both read it."""
    kind = type(message)
    ours, theirs = message.serialize(use_version_2=False), kind.__idl__.serialize(message, use_version_2=False)
    assert ours == theirs
    assert repr(kind.deserialize(ours)) == repr(kind.__idl__.deserialize(ours))
    assert kind.deserialize(ours).serialize(use_version_2=False) == ours
    big = kind.__idl__.serialize(message, use_version_2=False, endianness=Endianness.Big)
    assert repr(kind.deserialize(big)) == repr(kind.deserialize(ours))


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    path = tmp_path_factory.mktemp("own") / "own.txt"
    path.write_text(DEFINITIONS)
    return Messages(path)


@settings(max_examples=40)
@given(st.data())
def test_all_kinds_of_fields_are_written_and_read_as_cyclonedds_does(own, data):
    agree(data.draw(drawn(own, "some/Outer")))


@pytest.mark.parametrize("name", ["nav_msgs/Odometry", "rmf_prototype_msgs/Progress", "rmf_prototype_msgs/Plan"])
def test_messages_of_open_rmf_are_written_and_read_as_cyclonedds_does(name):
    messages = messages_of("")
    agree(messages.new(name))
    waypoint = messages.new(
        "rmf_prototype_msgs/Waypoint",
        position=[1.5, -2.0],
        maps=["L1", "Erdgeschoß"],
        departure_blockers=[messages.new("rmf_prototype_msgs/TrafficDependency", name="r", required_progress=2.0)] * 2,
    )
    agree(messages.new("rmf_prototype_msgs/Plan", waypoints=[waypoint] * 3, workflow="{}"))
