import numpy as np
import pytest

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot, robot_names

ROBOT = """\
name: cart
footprint: [[0.3, -0.2], [0.3, 0.2], [-0.3, 0.2], [-0.3, -0.2]]
max_speed: 1
max_turn_rate: 1.5
"""


def test_the_burger_is_as_published():
    burger = load_robot("turtlebot3_burger")
    assert (burger.max_speed, burger.max_turn_rate, burger.wheel_separation) == (0.22, 2.84, 0.16)
    assert np.isclose(burger.radius, np.hypot(0.102, 0.07))
    assert burger.lidar is not None
    assert (burger.lidar.beams, burger.lidar.range, burger.lidar.rate) == (360, 3.5, 5)
    assert burger.lidar.mount == (-0.032, 0, 0.182)


@pytest.mark.parametrize("name", robot_names())
def test_every_shipped_robot_loads_and_is_named_after_its_file(name):
    robot = load_robot(name)
    assert robot.name == name
    x, y = robot.footprint.T
    assert (x * np.roll(y, -1) - np.roll(x, -1) * y).sum() > 0
    assert hash(robot.lidar) == hash(load_robot(name).lidar)


def test_a_file_is_found_from_the_folder_of_the_configuration(tmp_path):
    (tmp_path / "cart.yaml").write_text(ROBOT)
    robot = load_robot("cart.yaml", tmp_path)
    assert (robot.name, robot.max_speed, robot.lidar) == ("cart", 1, None)


def test_a_name_like_a_number_keeps_its_spelling(tmp_path):
    assert load_robot_text(tmp_path, ROBOT.replace("cart", "007")).name == "007"


def test_a_footprint_drawn_clockwise_is_turned_round(tmp_path):
    clockwise = "[[-0.3, -0.2], [-0.3, 0.2], [0.3, 0.2], [0.3, -0.2]]"
    (tmp_path / "cart.yaml").write_text(ROBOT.replace(ROBOT.splitlines()[1][11:], clockwise))
    assert np.allclose(load_robot("cart.yaml", tmp_path).footprint, load_robot_text(tmp_path, ROBOT).footprint)


def load_robot_text(folder, text):
    (folder / "text.yaml").write_text(text)
    return load_robot("text.yaml", folder)


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("[]", 1, "must be a mapping"),
        (ROBOT.replace("max_speed", "max_sped"), 3, r"unknown key 'max_sped' \(did you mean 'max_speed'\?\)"),
        (ROBOT.replace("max_turn_rate: 1.5", ""), 1, "max_turn_rate is missing"),
        (ROBOT.replace("max_speed: 1", "max_speed: fast"), 3, "max_speed must be a number"),
        (ROBOT.replace("max_speed: 1", "max_speed: true"), 3, "max_speed must be a number"),
        (ROBOT.replace("max_speed: 1", "max_speed: .inf"), 3, "max_speed must be a number"),
        (ROBOT.replace("max_speed: 1", "max_speed: 0"), 3, "max_speed must be positive"),
        (ROBOT.replace("max_speed: 1", "max_speed: 1e300"), 3, "max_speed must be at most 1000"),
        (ROBOT.replace("name: cart", "name: []"), 1, "must be text"),
        (ROBOT.replace("name: cart", "name:"), 1, "must be text"),
        (ROBOT.replace("[0.3, 0.2], [-0.3, 0.2], ", ""), 2, "at least three points"),
        (ROBOT.replace("[0.3, 0.2]", "[0.3]"), 2, "must be two numbers"),
        (ROBOT.replace("0.2", "0"), 2, "encloses no area"),
        (ROBOT + "lidar: yes\n", 5, "must be a mapping of the lidar"),
        (ROBOT + "lidar:\n  beams: 1.5\n", 6, "must be a whole number"),
        (ROBOT + "lidar:\n  mount: [1, 2]\n", 6, "must be three numbers"),
        (ROBOT + "lidar:\n  rnge: 2\n", 6, "did you mean 'range'"),
        (ROBOT + "lidar:\n  min_range: 9\n", 6, "must be less than the range"),
    ],
)
def test_a_mistake_is_one_line_that_says_where(tmp_path, text, line, message):
    with pytest.raises(InputError, match=message) as caught:
        load_robot_text(tmp_path, text)
    assert caught.value.line == line
    assert "\n" not in str(caught.value)


def test_an_unknown_robot_is_met_with_a_suggestion():
    with pytest.raises(InputError, match="did you mean 'turtlebot3_burger'"):
        load_robot("turtlebot_burger")
    with pytest.raises(InputError, match="turtlebot3_waffle"):
        load_robot("x")


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(InputError, match=r"none\.yaml: no such file"):
        load_robot("none.yaml", tmp_path)
