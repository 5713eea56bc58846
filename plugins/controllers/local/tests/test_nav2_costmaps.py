"""Costmaps in Nav2 parameter files."""

import pytest
from mrpbench_controllers_dwb import Dwb

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot

BURGER = load_robot("turtlebot3_burger")


def values(controller):
    return controller.settings(BURGER, 0.05).values


COSTMAP = """\
controller_server: {ros__parameters: {FollowPath: {plugin: "dwb_core::DWBLocalPlanner"}}}
local_costmap: {local_costmap: {ros__parameters: {%s}}}
"""


@pytest.mark.parametrize(
    ("text", "name", "value"),
    [
        ("width: 2, plugins: [x], x: {plugin: 'nav2_costmap_2d::InflationLayer', inflation_radius: 0.2}", "width", 2.0),
        (
            "plugins: [x], x: {plugin: 'nav2_costmap_2d::InflationLayer', inflation_radius: 0.2}",
            "inflation_radius",
            0.2,
        ),
        ("plugins: [x], x.plugin: 'nav2_costmap_2d::InflationLayer', x.inflation_radius: 0.2", "inflation_radius", 0.2),
        ("inflation_layer: {inflation_radius: 0.2}", "inflation_radius", 0.2),
        (
            "plugin_names: [inflation_layer], plugin_types: [a], inflation_layer.inflation_radius: 0.2",
            "inflation_radius",
            0.2,
        ),
        ("plugins: [inflation_layer], inflation_layer: {enabled: false, typo: 1}", "inflation_layer", False),
        ("plugins: [a], a: {plugin: 'spatio_temporal_voxel_layer/Stvl', enabled: false}", "obstacle_layer", False),
        ("plugins: [inflation_layer], stvl_layer: {plugin: 'x/Stvl', typo: 1}", "inflation_layer", True),
        (
            "plugins: [voxel_layer], voxel_layer: {observation_sources: s, s: {obstacle_range: 1.5}}",
            "obstacle_max_range",
            1.5,
        ),
        (
            "plugins: [v], v: {plugin: VoxelLayer, observation_sources: a b, a.data_type: Other, b.marking: false}",
            *("marking", False),
        ),
        ("filters: [''], plugins: [inflation_layer]", "inflation_layer", True),
        ("footprint: '[]', robot_radius: 0.2", "robot_radius", 0.2),
        ("footprint: '[[.2, .1], [.2, -.1], [-.2, 0.]]'", "by_radius", False),
        ("width: 4, plugins: [inflation_layer], always_send_full_costmap: yes", "width", 4.0),
    ],
)
def test_layers_of_a_costmap_are_found_by_the_ids_that_a_file_lists(write, text, name, value):
    assert values(Dwb(nav2=write(COSTMAP % text)))[name] == value


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "plugins: [a], a: {plugin: 'spatio_temporal_voxel_layer/Stvl'}",
            r"a: plugin: 'Stvl' is not an .*layer \(layers",
        ),
        ("plugins: [inflation_layer], inflation_layer: {inflaton_radius: 1}", r"'inflaton_radius' \(did you mean"),
        ("plugins: {a: 1}", "plugins.a: expected a list, got a block"),
        ("plugins: [{name: a}]", "expected a list of names"),
        ("footprint: [[0.1, 0.1], [0.1, -0.1], [-0.1, 0.1]]", "footprint: expected text"),
        ("widht: 3", r"'widht' \(did you mean 'width'"),
    ],
)
def test_a_mistake_in_a_costmap_is_one_line_with_its_place(write, text, message):
    with pytest.raises(InputError, match=message):
        Dwb(nav2=write(COSTMAP % text))


def test_filters_of_costmaps_are_told_to_be_ignored(write):
    keepout = "filters: [keepout], keepout: {plugin: 'nav2_costmap_2d::KeepoutFilter', enabled: KEEPOUT_ENABLED}"
    other = "\nglobal_costmap: {global_costmap: {ros__parameters: {filters: [speed], speed: {}}}}"
    (note,) = Dwb(nav2=write(COSTMAP % keepout + other)).notes()
    assert note.endswith("filters of costmaps are ignored, their masks are not read: keepout, speed")
