"""Options on the command line are YAML, in which patterns of topics need no quotes."""

import pytest

from mrpbench_core.cli.input.arguments import read_options
from mrpbench_core.files.errors import InputError


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("[/{robot}/odometry/filtered]", ["/{robot}/odometry/filtered"]),
        ("['/{robot}/odom']", ["/{robot}/odom"]),
        ('["/{robot}/odom, {robot}/x"]', ["/{robot}/odom, {robot}/x"]),
        ("[/{robot}/odom, {robot}/base_link,/fixed]", ["/{robot}/odom", "{robot}/base_link", "/fixed"]),
        ("{robot}/odom", "{robot}/odom"),
        ("/{robot}/odom", "/{robot}/odom"),
        ("[/tf*, /map]", ["/tf*", "/map"]),
        ("{a: 1, b: [x]}", {"a": 1, "b": ["x"]}),
        ("1e-3", 1e-3),
        ("", ""),
    ],
)
def test_a_value_is_yaml_and_a_placeholder_is_text(text, value):
    assert read_options([f"key={text}"], "--option") == {"key": value}


@pytest.mark.parametrize("word", ["key", "a-b=1", "key=[/{robot}/odom"])
def test_the_error_for_an_unknown_option_is_one_line(word):
    with pytest.raises(InputError) as caught:
        read_options([word], "--option")
    assert "\n" not in str(caught.value)
