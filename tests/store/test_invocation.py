"""Values that are written as YAML are read back unchanged."""

from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.files.yaml import loads
from mrpbench_core.store.invocation import dumps, write_document

WORDS = st.sampled_from(["1e-3", "on", "10:30", "0o7", "010", "null", "~", "", "<<", "=", "1_0", "a: b", "# c", ".inf"])
LEAVES = (
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | WORDS | st.text("ab:-# \n'\"é", max_size=8)
)


@settings(deadline=None, max_examples=100)
@given(st.recursive(LEAVES, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(WORDS, inner, max_size=3)))
def test_yaml_is_read_back_as_it_was(data):
    assert loads(dumps({"data": data})).data == {"data": data}


def test_a_document_replaces_the_old_one_and_leaves_nothing_else(tmp_path):
    file = tmp_path / "study.yaml"
    write_document(file, {"a": 1})
    write_document(file, {"a": 2})
    assert loads(file.read_text()).data == {"a": 2}
    assert list(tmp_path.iterdir()) == [file]
