"""The schema agrees with what is read."""

from functools import cache

import jsonschema
import pytest

from mrpbench_core.config.schema import schema
from mrpbench_core.config.study import load_study
from mrpbench_core.files.errors import InputErrors
from mrpbench_core.files.yaml import loads
from mrpbench_core.plugins import installed

SMALL = "world: office\nscenario: {robots: 5}\nplanner: ecbs\n"


@cache
def checked():
    """The validator of the toy plugins, which are the same for every test."""
    found = schema()
    jsonschema.Draft202012Validator.check_schema(found)
    return jsonschema.Draft202012Validator(found)


@pytest.fixture
def validator(toy):
    return checked()


@pytest.mark.parametrize(
    "text",
    [
        "",
        "name: a\nseed: 3\nrepeat: 1\n",
        "roadmap: {cell_size: 0.5}\n",
        "roadmap: {plugin: lanes, cell_size: 50 cm}\n",
        "fleet: [{robot: turtlebot3_burger, lidar: {beams: 90, range: 3.5 m}, count: 2}, {lidar: none}]\n",
        "fleet: turtlebot3_waffle\n",
        "assigner: {objective: bottleneck}\n",
        "simulator: none\n",
        "simulator: {plugin: kinematic, timestep: 1/240}\n",
        "controller: {plugin: dwb, critics: [path_dist, {plugin: obstacle, scale: 2}], best: obstacle}\n",
        "controller: {plugin: dwb, critics: obstacle, best: none}\n",
        "noise: {lidar: 1 cm}\nlimits: {planning: 1 min, memory: 4 GiB, execution: 5, wall: 1.5 h}\n",
        "metrics: [planning, {plugin: execution, bins: 3}]\nexport: rosbag2\n",
        "recording: {keep: failed, rate: 5 Hz, scans: true}\n",
        "matrix: {seed: 0..9, planner: [astar, {plugin: ecbs, w: 1.5}], exclude: [{planner: astar, seed: 3}]}\n",
        "matrix: {seed: [1], include: {seed: 2}}\n",
        "matrix: {'noise.lidar, scenario.robots': [[0, 5], [0.1, 6]], goal_tolerance: [1, 2]}\n",
    ],
)
def test_accepted_configurations_are_valid(validator, text):
    validator.validate(loads(SMALL + text).data)
    assert load_study(loads(SMALL + text).data).runs


@pytest.mark.parametrize(
    "text",
    [
        "planer: ecbs\n",
        "seed: x\n",
        "seed: 1.5\n",
        "simulator: {plugin: kinematic, timestp: 1}\n",
        "simulator: {plugin: kinematic, timestep: 3 m}\n",
        "controller: {plugin: pure_pursuit, max_speed: 1}\n",
        "controller: pure\n",
        "controller: {plugin: dwb, critics: [path]}\n",
        "controller: {plugin: dwb, critics: [{scale: 1}]}\n",
        "fleet: [{robot: turtlebot9}]\n",
        "fleet: {lidar: {beam: 90}}\n",
        "limits: {planning: 60 m}\n",
        "limits: {memory: 1.5}\n",
        "recording: {keep: some}\n",
        "recording: {scans: on}\n",
        "metrics: [plan]\n",
        "simulator:\n",
        "matrix: {seed: 3}\n",
        "matrix: {exclude: [3]}\n",
        "matrix: {planer: [astar]}\n",
        "matrix: {noise.lida: [1, 2]}\n",
        "matrix: {limits.wall: [1, 2]}\n",
        "matrix: {seed: 0..3, 'noise.lidar, plan': [[0, 1]]}\n",
        "matrix: {seed: 0..3, exclude: [{sead: 1}]}\n",
        "matrix: {seed: 0..3, include: {names: x}}\n",
    ],
)
def test_refused_configurations_are_invalid(validator, text):
    data = loads(SMALL + text).data
    with pytest.raises(InputErrors):
        load_study(data)
    with pytest.raises(jsonschema.ValidationError):
        validator.validate(data)


def test_options_carry_help_and_default(toy):
    blocks = schema()["$defs"]["mrpbench.planners"]["oneOf"]
    (ecbs,) = [block for block in blocks if block.get("title") == "ecbs"]
    assert ecbs["properties"]["w"] == {"type": "number", "description": "bound", "default": 1.2}
    assert ecbs["properties"]["heuristic"]["enum"] == ["zero", "cg"]


MUTE = """
import attrs
from mrpbench_core.api import Planner, option

class Words:
    def __bool__(self):
        raise SystemExit

@attrs.frozen(kw_only=True)
class Mute(Planner):
    w: float = option(1.2, help=Words())
    def plan(self, problem, budget): ...
"""


def test_a_broken_plugin_is_left_out(toy, install):
    install("acme-broken", {"mrpbench.planners": {"broken": "{module}:X"}}, "import no_such_module")
    install("acme-mute", {"mrpbench.planners": {"mute": "{module}:Mute"}}, MUTE)
    installed.refresh()
    names = schema()["$defs"]["mrpbench.planners"]["oneOf"][0]["enum"]
    assert names == ["astar", "ecbs", "task_assigning"]


def test_the_installed_plugins_have_a_schema():
    jsonschema.Draft202012Validator.check_schema(schema())


def test_required_options_have_no_default():
    assert "default" not in schema()["properties"]["world"]
