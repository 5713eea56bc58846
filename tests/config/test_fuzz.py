"""Any file gives runs, or one line for each mistake."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mrpbench_core.config.study import load_study
from mrpbench_core.files import yaml
from mrpbench_core.files.errors import InputError, InputErrors

FULL = """\
name: warehouse-first
world: {plugin: rmf, file: map.yaml}
roadmap: {plugin: lanes, cell_size: 0.4}
scenario: {plugin: random, robots: 9}
fleet: [{robot: turtlebot3_burger, lidar: {beams: 360, range: 3.5}}, {lidar: none, count: 2}]
assigner: {plugin: hungarian, objective: sum}
planner: {plugin: ecbs, w: 1.2, pair: [3, x], either: auto, level: a}
controller: {plugin: dwb, critics: [path_dist, {plugin: obstacle, scale: 1e-3}], best: obstacle}
simulator: {plugin: kinematic, timestep: 1/240}
noise: {lidar: 0.01, odometry: 0.0, start_jitter: 0.0}
metrics: [planning, {plugin: execution, bins: 3}]
export: [{plugin: rosbag2, storage: mcap}]
limits: {planning: 60 s, memory: 4 GiB, execution: 5 min, wall: 30 min}
seed: 0
matrix:
  planner: [astar, ecbs, {plugin: ecbs, w: 1.2}]
  scenario.robots: [5, 9]
  fleet.0.lidar.beams: [5, 9]
  "seed, repeat": [[1, 2], [3, 4]]
  exclude: [{planner.plugin: astar, scenario.robots: 9}]
  include: [{planner: ecbs, seed: 0..2}]
"""
LINES = FULL.splitlines()
WORDS = [
    "",
    "none",
    "~",
    "3",
    "-1",
    "1e9",
    "x",
    "[]",
    "{}",
    "[1]",
    "{a: 1}",
    "0..3",
    ".inf",
    "'3'",
    "true",
    "1/0",
    "a:b",
]
WORDS += ["plugin", "./x.py:X", "os:getcwd", "@", "ecbs@toy", "&a [*a]", "!!int 3", "?", "- 1", "1 s", "\t", "\x00"]


@pytest.fixture(autouse=True)
def folder(toy, tmp_path, monkeypatch):
    (tmp_path / "map.yaml").write_text("walls")
    monkeypatch.chdir(tmp_path)


def test_the_whole_of_it_is_right():
    assert len(load_study(yaml.loads(FULL).data).runs) == 15  # ecbs with its default written is ecbs


@st.composite
def edited(draw):
    """The configuration with some of its words, values or lines replaced."""
    lines = list(LINES)
    for _ in range(draw(st.integers(1, 3))):
        index = draw(st.integers(0, len(lines) - 1))
        line = lines[index]
        start = draw(st.integers(0, len(line)))
        end = draw(st.integers(start, min(len(line), start + 12)))
        lines[index] = line[:start] + draw(st.sampled_from(WORDS)) + line[end:]
    return "\n".join(lines[: draw(st.integers(len(lines) - 5, len(lines)))])


@settings(deadline=None, max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    edited(),
    st.lists(st.sampled_from(["seed=3", "planner.w=2", "planner=astar", "seed.x=1", "a", "fleet.9=x"]), max_size=2),
)
def test_an_edited_file_is_runs_or_lines(tmp_path, text, overrides):
    path = tmp_path / "edited.yaml"
    path.write_text(text)
    try:
        assert load_study(path, overrides).runs
    except InputError as error:
        assert "\n" not in str(error)  # noqa: PT017 - either outcome is right
    except InputErrors as several:
        assert several.errors  # noqa: PT017
        assert all("\n" not in str(error) for error in several.errors)  # noqa: PT017
