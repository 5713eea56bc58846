"""The reference page on parameters of Nav2 is what the code says."""

import importlib.util
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).parents[4]


@pytest.fixture(scope="module")
def script():
    file = CHECKOUT / "scripts" / "nav2_page.py"
    if not file.is_file():
        pytest.skip("the plugin stands outside its checkout")
    spec = importlib.util.spec_from_file_location("nav2_page", file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_is_current(script):
    written = CHECKOUT / "docs" / "reference" / "nav2-parameters.md"
    assert script.page() == written.read_text(), "run: python scripts/nav2_page.py > docs/reference/nav2-parameters.md"


@pytest.mark.parametrize(
    ("name", "value", "fate"),
    [
        ("sim_time", 1.5, "read"),
        ("stateful", True, "not used"),
        ("max_vel_y", 0.1, "refused"),
        ("sim_tme", 1, "refused"),
    ],
)
def test_what_becomes_of_a_parameter_is_what_a_file_with_it_shows(script, name, value, fate):
    block = {"component": "mrpbench_controllers_dwb:Dwb", "node": "controller_server", "at": "FollowPath", "base": {}}
    assert script.fate_of(block, name, value) == fate
