"""Where a parameter file of ROS 2 has the parameters of a node."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2_file import Nav2File


@pytest.fixture
def load(tmp_path):
    def load(text):
        path = tmp_path / "params.yaml"
        path.write_text(text)
        return Nav2File.load(path)

    return load


def values(block):
    return {name: value.value for name, value in block._values.items()}


@pytest.mark.parametrize(
    "path",
    [
        "amcl: {ros__parameters: {a: 1}}",
        "/amcl: {ros__parameters: {a: 1}}",
        "robot1: {amcl: {ros__parameters: {a: 1}}}",
        "/robot1/amcl: {ros__parameters: {a: 1}}",
        "<robot_namespace>: {amcl: {ros__parameters: {a: 1}}}",
        "'**': {amcl: {ros__parameters: {a: 1}}}",
        "/**/amcl: {ros__parameters: {a: 1}}",
        "/**: {amcl: {ros__parameters: {a: 1}}}",
        "/**: {ros__parameters: {a: 1}}",
        "/*: {ros__parameters: {a: 1}}",
        "other: {ros__parameters: {a: 2}}\namcl: {ros__parameters: {a: 1}}",
    ],
)
def test_a_node_is_found_by_its_name_in_its_namespace_or_by_a_pattern(load, path):
    assert values(load(path).node("amcl")) == {"a": 1}


@pytest.mark.parametrize("path", ["local_costmap: {local_costmap: ", "a: {local_costmap/local_costmap: ", "/**: "])
def test_the_node_of_a_costmap_has_a_namespace_of_its_own_name(load, path):
    assert values(load(f"{path}{{ros__parameters: {{a: 1}}}}{'}' * path.count('{')}").node("local_costmap")) == {"a": 1}


@pytest.mark.parametrize(("path", "node"), [("local_costmap: ", ""), ("a: {local_costmap: ", "a/")])
def test_parameters_in_the_namespace_of_a_costmap_are_of_no_node(load, path, node):
    file = load(f"{path}{{ros__parameters: {{a: 1}}}}{'}' * path.count('{')}")
    with pytest.raises(InputError, match=f":1:.*is of no node: the costmap is '{node}local_costmap/local_costmap'"):
        file.node("local_costmap")


def test_all_entries_that_match_hold_and_later_ones_win(load):
    text = "/**: {ros__parameters: {a: 1, b: 1, c: 1}}\namcl: {ros__parameters: {a: 2, b: 2}}\n"
    assert values(load(text).node("amcl")) == {"a": 2, "b": 2, "c": 1}
    assert values(load(text + "/*/amcl: {ros__parameters: {b: 3}}").node("amcl")) == {"a": 2, "b": 2, "c": 1}
    assert values(load(text + "/**/amcl: {ros__parameters: {b: 3}}").node("amcl")) == {"a": 2, "b": 3, "c": 1}


def test_patterns_match_as_many_names_as_they_say(load):
    text = "/*/amcl: {ros__parameters: {one: 1}}\n/**/amcl: {ros__parameters: {any: 1}}"
    file = load(text)
    assert values(file.node("amcl", "")) == {"any": 1}
    assert values(file.node("amcl", "r1")) == {"one": 1, "any": 1}
    assert values(file.node("amcl", "floor/r1")) == {"any": 1}


def test_parameters_of_any_node_are_not_judged_for_one_of_them(load):
    file = load(
        "/**: {ros__parameters: {use_sim_time: true, of_another: 1, Block: {typo: 1}}}\namcl: {ros__parameters: {}}"
    )
    block = file.node("amcl")
    assert block.unused() == ()
    block.within("Block")
    with pytest.raises(InputError, match="unknown parameter 'typo'"):
        block.unused()


def test_a_node_that_is_not_there_is_none_and_its_error_names_those_that_are(load):
    file = load("a: {ros__parameters: {}}\nr1: {b: {ros__parameters: {}}}")
    assert file.node("amcl") is None
    assert str(file.missing("amcl")).endswith("has no parameters of the node 'amcl' (it has those of a, b)")


NAMESPACES = "r1: {amcl: {ros__parameters: {a: 1, t: x}}}\nr2: {amcl: {ros__parameters: {a: %d, t: y}}}"


def read(file, namespace=None):
    return file.read("amcl", namespace, lambda space: (file.node("amcl", space).take("a", int), (space,)))


def test_namespaces_with_equal_values_are_read_as_one(load):
    assert read(load(NAMESPACES % 1)) == (1, ("r1", "r2"))


def test_namespaces_with_different_values_need_a_choice(load):
    file = load(NAMESPACES % 2)
    with pytest.raises(
        InputError, match=r"different values of amcl in the namespaces r1, r2 \(choose one by the option"
    ):
        read(file)
    assert read(file, "/r2") == (2, ("r2",))
    with pytest.raises(InputError, match=r"has no amcl in the namespace 'r3' \(there are r1, r2\)"):
        read(file, "r3")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("name: x\n", "not a ROS 2 parameter file"),
        ("[1, 2]\n", "not a ROS 2 parameter file"),
        ("ros__parameters: {a: 1}\n", "below the name of a node"),
        ("amcl: {ros__parameters: [1]}\n", "1:25: must be a mapping of parameters"),
        ("amcl: {ros__parameters: {a: 1, a: 2}}\n", "duplicate key 'a'"),
    ],
)
def test_what_is_no_parameter_file_is_refused_in_one_line(load, text, message):
    with pytest.raises(InputError, match=message) as caught:
        load(text)
    assert "\n" not in str(caught.value)


def test_merge_keys_and_keys_that_repeat_a_value_are_read(load):
    text = "base: &base {ros__parameters: {a: 1, b: {c: 2}}}\namcl:\n  <<: *base\n"
    assert values(load(text).node("amcl")) == {"a": 1, "b.c": 2}
    assert values(load("amcl: {ros__parameters: {a: 1, a: 1, b: , b: {c: 2}}}").node("amcl")) == {"a": 1, "b.c": 2}


TREES = st.recursive(
    st.integers(0, 9),
    lambda inner: st.dictionaries(st.sampled_from("abc"), inner, min_size=1, max_size=3),
    max_leaves=8,
)


def dotted(tree, draw):
    """The same tree with some levels joined by dots."""
    if not isinstance(tree, dict):
        return tree
    found = {}
    for key, inner in tree.items():
        inner = dotted(inner, draw)
        joins = isinstance(inner, dict) and draw(st.booleans())
        found |= {f"{key}.{name}": value for name, value in inner.items()} if joins else {key: inner}
    return found


@given(st.dictionaries(st.sampled_from("abc"), TREES, min_size=1), st.data())
def test_dotted_and_nested_keys_are_equal_at_every_depth(tree, data):
    from mrpbench_core.files.nav2 import Nav2Block

    assert values(Nav2Block("x", dotted(tree, data.draw))) == values(Nav2Block("x", tree))
