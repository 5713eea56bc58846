import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_exporters_rosbag2.block_yaml import block_yaml

PLAIN = st.characters(exclude_categories=("Cs", "Cc"), exclude_characters="\u2028\u2029\x85\ufeff\ufffe\uffff")
SCALARS = (
    st.none() | st.booleans() | st.integers() | st.text(PLAIN) | st.sampled_from(["", "no", "1e3", "a: b", "- c", '"'])
)
NAMES = st.from_regex("[a-z][a-z_0-9]{3,10}", fullmatch=True).filter(lambda name: name not in ("true", "false", "null"))


@settings(max_examples=40)
@given(
    st.recursive(SCALARS, lambda inner: st.lists(inner, max_size=4) | st.dictionaries(NAMES, inner, max_size=4)).filter(
        lambda value: isinstance(value, dict | list)
    )
)
def test_a_library_reads_the_written_yaml(value):
    assert yaml.safe_load(block_yaml(value)) == value
