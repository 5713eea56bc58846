"""Strict YAML 1.2 with marks."""

import json
import math

import pytest
import yaml as pyyaml
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.files import yaml
from mrpbench_core.files.errors import InputError


@pytest.fixture(params=["with libyaml", "without libyaml"], autouse=True)
def parser(request, monkeypatch):
    """Run everything with both of PyYAML's parsers."""
    if request.param == "without libyaml":
        monkeypatch.setattr(yaml, "_LOADER", pyyaml.SafeLoader)
    elif not hasattr(pyyaml, "CSafeLoader"):
        pytest.skip("PyYAML was built without libyaml")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e-3", 0.001),
        ("1e3", 1000.0),
        ("1.", 1.0),
        (".5", 0.5),
        ("-.5e+1", -5.0),
        ("010", 10),
        ("0o10", 8),
        ("0xff", 255),
        ("-7", -7),
        ("+7", 7),
        ("1_000", "1_000"),
        ("0b1", "0b1"),
        ("10:30", "10:30"),
        ("2020-01-01", "2020-01-01"),
        ("on", "on"),
        ("yes", "yes"),
        ("y", "y"),
        ("true", True),
        ("FALSE", False),
        ("tRue", "tRue"),
        ("~", None),
        ("null", None),
        ("nUll", "nUll"),
        (".inf", math.inf),
        ("-.INF", -math.inf),
        ("inf", "inf"),
        ("0..53", "0..53"),
        ("1/240", "1/240"),
        ("=", "="),
        ("'1'", "1"),
        ('"true"', "true"),
        ("|\n 1\n", "1\n"),
    ],
)
def test_scalars_follow_the_core_schema(text, value):
    result = yaml.loads(text).data
    assert result == value
    assert type(result) is type(value)


def test_not_a_number_is_read():
    assert math.isnan(yaml.loads(".nan").data)


def test_keys_are_text_as_written():
    assert yaml.loads("1: a\n1.0: b\ntrue: c\n'on': d").data == {"1": "a", "1.0": "b", "true": "c", "on": "d"}


@pytest.mark.parametrize(
    ("text", "where", "what"),
    [
        ("a: [1, 2\nb: 3", (2, 2), "expected ',' or ']'"),
        ("a: 'b\nc: d", (2, 5), "unexpected end of stream"),
        ("a: !!python/object/apply:os.system [x]", (1, 4), "tags"),
        ("a: !!str 1", (1, 4), "tags"),
        ("- !mine {}", (1, 3), "tags"),
        ("a: 1\nb: 2\na: 3", (3, 1), "duplicate key 'a' .first in line 1; keep one of them"),
        ("b: {a: 1, 'a': 2}", (1, 11), "duplicate key"),
        ("a: &a {b: 1}\nc: {<<: *a}", (2, 5), "merge keys"),
        ("&a [*a]", (1, 5), "contains itself"),
        ("&a {b: {c: *a}}", (1, 12), "contains itself"),
        ("- *nobody", (1, 3), "nobody"),
        ("[a]: 1", (1, 1), "key must be plain text"),
        ("{{a: 1}: 1}", (1, 2), "key must be plain text"),
        ("a: 1\n---\nb: 2", (2, 1), "second document"),
        ("%YAML 1.1\n---\na: 1", (1, 1), "YAML 1.2"),
        ("a: 1e999", (1, 4), "too large"),
        ("a: " + 5000 * "9", (1, 4), "too large"),
        ("a: -" + 400 * "9", (1, 4), "too large"),
        ("a: b\x00c", (1, 5), r"U\+0000"),
        ("a: b\ud800c", (1, 5), r"U\+D800"),
        ("a:\n\t- b", (2, 1), "cannot start any token"),
        ("a: b: c", (1, 5), "mapping values are not allowed"),
        (100 * "[" + "[", (1, 101), "nested deeper"),
        (99 * "[" + "{a: {", (1, 104), "nested deeper"),
    ],
)
def test_a_mistake_is_one_line_with_its_place(text, where, what):
    with pytest.raises(InputError, match=what) as caught:
        yaml.loads(text, file="some.yaml")
    assert (caught.value.line, caught.value.column) == where
    assert str(caught.value).startswith(f"some.yaml:{where[0]}:{where[1]}: ")
    assert "\n" not in str(caught.value)


CONFLICT = "a:\n  b: 1\n<<<<<<< HEAD\n  c: 1\n=======\n  c: 2\n>>>>>>> 7189ad5 (Use 2)\n"


@pytest.mark.parametrize("text", [CONFLICT, CONFLICT.replace("  ", ""), CONFLICT.replace("  c: ", "  - ")])
def test_a_merge_conflict_is_named_with_its_line(text):
    with pytest.raises(InputError, match=r"has a merge conflict of Git \(keep one of its two sides\)$") as caught:
        yaml.loads(text)
    assert caught.value.line == 3


@pytest.mark.parametrize("text", ["", "# nothing\n", "\n\n"])
def test_an_empty_file_says_so(text):
    with pytest.raises(InputError, match="is empty"):
        yaml.loads(text)


def test_a_bomb_of_aliases_ends_with_one_line():
    lines = ["l0: &l0 [x, x, x, x, x, x, x, x, x]"]
    lines += [f"l{i}: &l{i} [{', '.join([f'*l{i - 1}'] * 9)}]" for i in range(1, 30)]
    with pytest.raises(InputError, match="aliases add more than"):
        yaml.loads("\n".join(lines))


def test_aliases_cannot_nest_deeper_than_plain_text():
    lines = ["l0: &l0 " + 60 * "[" + 60 * "]", "l1: " + 60 * "[" + "*l0" + 60 * "]"]
    with pytest.raises(InputError, match="nested deeper") as caught:
        yaml.loads("\n".join(lines))
    assert caught.value.line == 2


def test_a_million_brackets_do_not_exhaust_the_stack():
    for opening in ("[", "{a: ", "- "):
        with pytest.raises(InputError, match="nested deeper"):
            yaml.loads(opening * 100_000)


def test_aliases_stand_for_their_anchor():
    document = yaml.loads("a: &x {k: [1, 2]}\nb: *x\nc: &y 3\nd: [*y, *y]\n&z e: *z")
    assert document.data == {"a": {"k": [1, 2]}, "b": {"k": [1, 2]}, "c": 3, "d": [3, 3], "e": "e"}
    assert document.mark(("b",)) == (2, 4)
    assert document.mark(("b", "k", 1)) == (1, 15)


def test_an_alias_means_the_latest_anchor_above_it():
    assert yaml.loads("[&a 1, &a 2, *a, &a [&a 3, *a], *a]").data == [1, 2, 2, [3, 3], 3]


def test_scalars_keep_their_spelling():
    document = yaml.loads("a: [1.10, 007, 1E3, on, 2024-10-05, 0x1F, True, '', ~, x]\nb: &b 2.50\nc: *b")
    names = [document.text(("a", index)) for index in range(10)]
    assert names == ["1.10", "007", "1E3", "on", "2024-10-05", "0x1F", "True", "", None, "x"]
    assert document.text(("b",)) == document.text(("c",)) == "2.50"
    assert document.text(()) is document.text(("a",)) is None


def test_marks_lead_to_keys_and_values():
    document = yaml.loads("a:\n  - x: 1\n    y: [2, 3]\nb: {c: d}\n", file="f.yaml")
    assert document.mark() == (1, 1)
    assert document.mark(("a", 0, "y", 1)) == (3, 12)
    assert document.mark(("a", 0, "y"), key=True) == (3, 5)
    assert document.mark(("b", "c"), key=True) == (4, 5)
    assert document.mark(("b", "c")) == (4, 8)
    assert document.mark(("b", "missing", 3), key=True) == (4, 4)
    assert str(document.error("is odd", ("b", "c"), hint="try e")) == "f.yaml:4:8: is odd (try e)"


def test_a_file_cut_off_in_a_flow_collection_is_refused():
    with pytest.raises(InputError, match="while parsing a flow sequence"):
        yaml.loads("a: 1\nb: {c: [1, 2")


def test_files_that_cannot_be_read_are_named(tmp_path):
    for name, content, what in (("absent.yaml", None, "no such file"), ("latin.yaml", b"a: 1\nb: f\xfcr", "UTF-8")):
        path = tmp_path / name
        if content is not None:
            path.write_bytes(content)
        with pytest.raises(InputError, match=what) as caught:
            yaml.load(path)
        assert str(caught.value).startswith(str(path))
    assert (caught.value.line, caught.value.column) == (2, 5)
    with pytest.raises(InputError, match="is a folder"):
        yaml.load(tmp_path)
    with pytest.raises(InputError, match="cannot be read"):
        yaml.load("a\x00b")


def test_a_byte_order_mark_is_skipped(tmp_path):
    path = tmp_path / "bom.yaml"
    path.write_bytes(b"\xef\xbb\xbfa: 1\r\nb: 2\r\n")
    assert yaml.load(path).data == {"a": 1, "b": 2}


# Without control characters and the line breaks of Unicode, which PyYAML still reads by the rules of YAML 1.1.
texts = st.text(st.characters(exclude_categories=["Cc", "Cs", "Zl", "Zp"], exclude_characters="\ufffe\uffff\ufeff"))
numbers = st.integers() | st.floats(allow_nan=False, allow_infinity=False)


def trees(text):
    return st.recursive(
        st.none() | st.booleans() | numbers | text,
        lambda inner: st.lists(inner, max_size=4) | st.dictionaries(text, inner, max_size=4),
        max_leaves=20,
    )


@settings(deadline=None, max_examples=80)
@given(trees(texts), st.sampled_from([None, 2]))
def test_json_means_the_same_as_yaml(value, indent):
    assert yaml.loads(json.dumps(value, indent=indent, ensure_ascii=False)).data == value


@settings(deadline=None, max_examples=80)
@given(trees(st.text("abc :-#'\"\n", max_size=12)))
def test_output_of_pyyaml_is_read_back(value):
    assert yaml.loads(pyyaml.safe_dump(value)).data == value


@settings(deadline=None, max_examples=200)
@given(st.text(st.sampled_from("ab:-[]{}&*!#,?|>'\"%@\n \t1~<."), max_size=30))
def test_any_text_is_read_or_refused(text):
    try:
        yaml.loads(text)
    except InputError as error:
        assert "\n" not in str(error)  # noqa: PT017 - what is asserted is the rare case


def test_large_maps_load(shared_data):
    document = yaml.load(shared_data / "rmf" / "mrp_bench" / "airport_terminal.building.yaml")
    assert len(document.data["levels"]["L1"]["vertices"]) > 0
